#include "pipelines/program/workers.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

#include "generator/sample/errors.h"
#include "pipelines/program/interrupt.h"

namespace lamella {

void Workers::start(std::size_t task, const std::function<int()>& command) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw DataError("cannot start another process: the system has no room for it; use fewer --jobs");
  if (child == 0) {
    const int status = command();
    std::fflush(nullptr);
    _exit(status);
  }
  running_[child] = task;
}

std::pair<std::size_t, int> Workers::wait() {
  for (;;) {
    int status = 0;
    if (interrupted())
      for (const auto& [child, task] : running_) kill(child, SIGTERM);
    const pid_t child = waitpid(-1, &status, 0);
    if (child < 0 && errno == EINTR) continue;
    const auto found = running_.find(child);
    if (found == running_.end()) continue;
    const std::size_t task = found->second;
    running_.erase(found);
    // A child that a signal ended counts as numerics that gave up, unless the user sent the signal.
    return {task, WIFEXITED(status) ? WEXITSTATUS(status) : interrupted() ? 130 : 3};
  }
}

}  // namespace lamella
