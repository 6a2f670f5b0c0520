#include "generator/sample/team.h"

namespace lamella {

Team::Team(int size) : size_(size) {
  for (int thread = 1; thread < size; ++thread)
    others_.emplace_back([this, thread] {
      for (meet(); !leaving_; meet()) {
        (*work_)(thread);
        meet();
      }
    });
}

Team::~Team() {
  leaving_ = true;
  meet();
  for (std::thread& other : others_) other.join();
}

void Team::run(const std::function<void(int)>& work) {
  work_ = &work;
  meet();
  work(0);
  meet();
}

// The last to arrive opens the next round. What threads wrote before they met, all can read after it.
void Team::meet() {
  if (size_ == 1) return;
  constexpr int spins = 2000;  // about 30 microseconds, a tenth of a step of 20,000 nodes
  const int round = round_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    round_.store(static_cast<int>(static_cast<unsigned>(round) + 1), std::memory_order_release);
    round_.notify_all();
    return;
  }
  for (int k = 0; k < spins; ++k) {
    if (round_.load(std::memory_order_acquire) != round) return;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  round_.wait(round, std::memory_order_acquire);
}

}  // namespace lamella
