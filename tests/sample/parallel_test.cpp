#include "generator/sample/parallel.h"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace lamella {
namespace {

class Parallel : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { use_threads(GetParam()); }
  void TearDown() override { use_threads(1); }
};

TEST_P(Parallel, every_element_is_worked_on_once) {
  for (const std::size_t count : {0u, 1u, 7u, 64u, 65u, 10000u}) {
    std::vector<int> times(count, 0);
    for_pieces(count, 64, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 64, 0u);
      EXPECT_LE(end - begin, 64u);
      for (std::size_t k = begin; k < end; ++k) ++times[k];
    });
    EXPECT_EQ(times, std::vector<int>(count, 1));
  }
}

TEST_P(Parallel, the_first_failure_is_the_one_that_is_told) {
  std::vector<int> times(100, 0);
  try {
    for_pieces(100, 1, [&](std::size_t k, std::size_t) {
      ++times[k];
      if (k % 10 == 7) throw std::runtime_error(std::to_string(k));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "7");
  }
  EXPECT_EQ(std::accumulate(times.begin(), times.end(), 0), 100);
}

INSTANTIATE_TEST_SUITE_P(threads, Parallel, testing::Values(1, 2, 3));

}  // namespace
}  // namespace lamella
