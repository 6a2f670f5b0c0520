#include "generator/sample/team.h"

#include <gtest/gtest.h>

namespace lamella {
namespace {

TEST(Team, threads_that_meet_see_what_the_others_wrote_before) {
  for (const int size : {1, 2, 3}) {
    Team team(size);
    std::vector<int> written(size, 0), seen(size, 0);
    for (int round = 1; round <= 300; ++round) {
      team.run([&](int thread) {
        written[thread] = round;
        team.meet();
        for (const int value : written) seen[thread] += value == round ? 1 : 0;
        team.meet();
      });
    }
    for (const int count : seen) EXPECT_EQ(count, 300 * size);
  }
}

TEST(Team, work_is_done_when_run_returns) {
  Team team(2);
  std::vector<int> done(2, 0);
  for (int round = 1; round <= 300; ++round) {
    team.run([&](int thread) { done[thread] = round; });
    ASSERT_EQ(done, std::vector<int>(2, round));
  }
}

}  // namespace
}  // namespace lamella
