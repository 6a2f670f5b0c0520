#include "generator/sample/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "generator/sample/team.h"

namespace lamella {
namespace {

std::atomic<int> threads{1};

}  // namespace

void use_threads(int count) { threads = std::max(1, count); }

int threads_in_use() { return threads; }

void for_pieces(std::size_t count, std::size_t piece,
                const std::function<void(std::size_t begin, std::size_t end)>& work) {
  const std::size_t pieces = (count + piece - 1) / piece;
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t first_failed = pieces;
  std::exception_ptr failure;
  const std::function<void(int)> take_pieces = [&](int) {
    for (std::size_t k; (k = next++) < pieces;) {
      try {
        work(k * piece, std::min(count, (k + 1) * piece));
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (k < first_failed) first_failed = k, failure = std::current_exception();
      }
    }
  };
  if (pieces > 0) Team(static_cast<int>(std::min<std::size_t>(threads_in_use(), pieces))).run(take_pieces);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace lamella
