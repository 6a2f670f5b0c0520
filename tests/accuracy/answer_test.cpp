// The answer of a run and its error by two paces, on curves whose error is known.
#include "pipelines/accuracy/answer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamella {
namespace {

/// load = s (1 + error s) on s in [0, 1].
Answer line(double error) {
  Answer answer{"force", "N", {}, {}};
  for (int k = 0; k <= 100; ++k) {
    const double s = 0.01 * k;
    answer.progress.push_back(s), answer.load.push_back(s * (1 + error * s));
  }
  return answer;
}

TEST(Answer, is_read_between_rows) {
  const Answer answer = line(0);
  EXPECT_NEAR(answer.at(0.123), 0.123, 1e-12);
  EXPECT_EQ(answer.at(-1), 0);
  EXPECT_EQ(answer.at(2), 1);
}

TEST(ErrorEstimate, of_a_first_order_error_is_that_error) {
  for (const double ratio : {2.0, 3.0}) {
    const Answer slow = line(0.01), fast = line(0.01 * ratio), exact = line(0);
    const ErrorEstimate estimated = error_of_slower(slow, fast, ratio);
    const ErrorEstimate truth = distance(slow, exact, compared_places(slow, exact));
    EXPECT_NEAR(truth.peak, 0.01, 1e-12);
    EXPECT_NEAR(estimated.peak / truth.peak, 1, 0.02);
    EXPECT_NEAR(estimated.curve / truth.curve, 1, 0.02);
    EXPECT_EQ(estimated.larger(), std::max(estimated.peak, estimated.curve));
  }
}

TEST(ErrorEstimate, compares_up_to_the_earlier_peak) {
  Answer early = line(0);
  early.progress.resize(51), early.load.resize(51);
  const auto places = compared_places(early, line(0), 5);
  ASSERT_EQ(places.size(), 5u);
  EXPECT_DOUBLE_EQ(places.front(), 0.1);
  EXPECT_DOUBLE_EQ(places.back(), 0.5);
}

}  // namespace
}  // namespace lamella
