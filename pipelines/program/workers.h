// Work in processes of its own: a run that gives up, or is killed, takes nothing else with it.
#pragma once
#include <sys/types.h>

#include <functional>
#include <map>

namespace lamella {

class Workers {
 public:
  /// Runs `command` in a child, which ends with its return value. Forked before the parent has threads, so that the child starts clean.
  void start(std::size_t task, const std::function<int()>& command);
  std::size_t count() const { return running_.size(); }
  /// Waits for one to end; returns its task and exit status. Passes a request to stop on to all of them.
  std::pair<std::size_t, int> wait();

 private:
  std::map<pid_t, std::size_t> running_;
};

}  // namespace lamella
