// Threads that take every step together. OpenMP's own barriers spin for milliseconds: harmless alone on a machine, but where other programs
// run beside, the thread that waits takes the core from the one it waits for (measured: 2 instead of 30 to 60 million
// node-steps a second). These spin for some microseconds, then sleep.
#pragma once
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace lamella {

class Team {
 public:
  explicit Team(int size);
  ~Team();
  Team(const Team&) = delete;

  int size() const { return size_; }
  /// Calls work(thread) for every thread in [0, size), 0 being the caller, and returns when all have. `work` must not throw.
  void run(const std::function<void(int)>& work);
  /// Inside `work`: waits until all threads are here.
  void meet();

 private:
  const int size_;
  const std::function<void(int)>* work_ = nullptr;
  bool leaving_ = false;
  std::atomic<int> arrived_{0}, round_{0};
  std::vector<std::thread> others_;
};

}  // namespace lamella
