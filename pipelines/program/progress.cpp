#include "pipelines/program/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lamella {
namespace {

constexpr double kRedraw = 0.2;     // [s] between two states of the line on a terminal
constexpr double kPlainStep = 0.1;  // of the work between two plain lines,
constexpr double kPlainPause = 5;   // and [s] at least

}  // namespace

std::string spoken_time(double seconds) {
  const auto s = static_cast<long long>(std::llround(std::min(seconds, 1e9)));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

Progress::Progress(Verbosity verbosity)
    : quiet_(verbosity == Verbosity::quiet), terminal_(isatty(STDOUT_FILENO) == 1) {}

Progress::~Progress() { wipe(); }

void Progress::wipe() {
  if (line_open_) std::fputs("\r\033[K", stdout);
  line_open_ = false;
}

void Progress::start(const std::string& work) {
  work_ = work;
  start_ = shown_ = Clock::now();
  next_ = kPlainStep;
}

void Progress::show(double done, const std::string& what) {
  if (quiet_) return;
  done = std::clamp(done, 0.0, 1.0);
  const auto now = Clock::now();
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      done > 0.01 && elapsed > 1 ? ", about " + spoken_time(elapsed * (1 - done) / done) + " left" : "";
  const std::string line = fmt::format("{} {:3.0f} %{}  {}", work_, 100 * done, left, what);
  if (terminal_) {
    if (std::chrono::duration<double>(now - shown_).count() < kRedraw) return;
    shown_ = now;
    fmt::print("\r\033[K{}", line.substr(0, 110));
    line_open_ = true;
  } else {
    if (done < next_ || done >= 1 || std::chrono::duration<double>(now - shown_).count() < kPlainPause) return;
    shown_ = now;
    next_ = (std::floor(done / kPlainStep) + 1) * kPlainStep;
    fmt::print("{}\n", line);
  }
  std::fflush(stdout);
}

void Progress::say(const std::string& line) {
  if (quiet_) return;
  wipe();
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void Progress::finish() {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (elapsed >= 0.5)
    say(fmt::format("{} done in {}", work_, elapsed < 10 ? fmt::format("{:.1f} s", elapsed) : spoken_time(elapsed)));
  else
    wipe();
}

}  // namespace lamella
