// What the user sees while the program works: one line with the time left, rewritten in place on a terminal; a plain line now
// and then where output goes to a file.
#pragma once
#include <chrono>
#include <string>

namespace lamella {

enum class Verbosity { normal, quiet };

class Progress {
 public:
  explicit Progress(Verbosity verbosity);
  ~Progress();
  /// Starts a piece of work, such as "simulate".
  void start(const std::string& work);
  /// done in [0, 1]
  void show(double done, const std::string& what);
  /// A line that stays.
  void say(const std::string& line);
  /// Ends the piece of work and says how long it took.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void wipe();

  bool quiet_, terminal_;
  std::string work_;
  Clock::time_point start_, shown_;
  double next_ = 0;  // where the next plain line is due
  bool line_open_ = false;
};

/// "42 s", "3 min 05 s", "2 h 10 min".
std::string spoken_time(double seconds);

}  // namespace lamella
