#include "pipelines/program/interrupt.h"

#include <csignal>

#include "generator/sample/errors.h"

namespace lamella {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void on_signal(int) { asked = true; }

}  // namespace

void listen_for_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second signal meets the default: the end
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupted() { return asked; }

void stop_if_interrupted() {
  if (asked) throw Interrupted("interrupted");
}

}  // namespace lamella
