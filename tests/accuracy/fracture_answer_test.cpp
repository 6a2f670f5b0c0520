// How far two runs agree on fracture: the overlap of what broke, what is read off one run, and rest against slow time.
#include "pipelines/accuracy/fracture_answer.h"

#include <gmock/gmock.h>

#include <cmath>

#include "pipelines/accuracy/measured.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

TEST(Overlap, is_what_both_have_over_what_either_has) {
  EXPECT_DOUBLE_EQ(overlap({1, 2, 3}, {1, 2, 3}), 1);
  EXPECT_DOUBLE_EQ(overlap({1, 2, 3}, {2, 3, 4}), 0.5);
  EXPECT_DOUBLE_EQ(overlap({2, 3, 4}, {1, 2, 3}), 0.5);
  EXPECT_DOUBLE_EQ(overlap({1, 2, 3, 4}, {1}), 0.25);
  EXPECT_DOUBLE_EQ(overlap({1, 2}, {3, 4}), 0);
}

TEST(Overlap, of_nothing_with_nothing_is_whole) {
  EXPECT_DOUBLE_EQ(overlap({}, {}), 1);
  EXPECT_DOUBLE_EQ(overlap({}, {1}), 0);
  EXPECT_DOUBLE_EQ(overlap({1}, {}), 0);
}

TEST(ErrorText, says_where_there_is_no_answer) {
  EXPECT_EQ(error_text(0.0321), "3.2 %");
  EXPECT_EQ(error_text(std::nan("")), "no answer");
}

class SlowTissue : public testing::Test {
 protected:
  StudyRun run(const std::string& name, std::vector<std::string> settings) {
    for (const char* size : {"sample.packing.count=25", "sample.width=0.4002e-3", "sample.height=0.6261e-3"})
      settings.emplace_back(size);
    return bench_.run(name, "slow_fracture.toml", settings);
  }

 private:
  TemporaryFolder folder_;
  StudyBench bench_{LAMELLA_SOURCE_DIR "/pipelines/accuracy", folder_.path(), StudySize::kSmall, nullptr, {}};
};

TEST_F(SlowTissue, at_rest_is_what_time_comes_to_when_it_is_slow) {
  const FractureAnswer rest = fracture_answer_of(run("rest", {"run.stepper=quasi_static"}));
  const FractureAnswer slow =
      fracture_answer_of(run("slow", {"run.slowdown=80", "drag.rate=3e5", "output.response=3000"}));
  EXPECT_GT(rest.links.size(), 5u);
  EXPECT_GT(rest.peak_stress, rest.first_break_stress * 0.99);
  EXPECT_GE(rest.strain_at_peak, rest.first_break_strain);
  EXPECT_NEAR(slow.first_break_strain / rest.first_break_strain, 1, 0.02);
  EXPECT_NEAR(slow.first_break_stress / rest.first_break_stress, 1, 0.03);
  EXPECT_NEAR(slow.peak_stress / rest.peak_stress, 1, 0.05);
}

TEST_F(SlowTissue, walls_that_crack_are_those_of_the_links_that_broke) {
  const StudyRun done = run("rest", {"run.stepper=quasi_static", "run.breaking=all_at_once"});
  const FractureAnswer answer = fracture_answer_of(done);
  EXPECT_EQ(static_cast<double>(answer.links.size()), done.last("broken_links"));
  EXPECT_LE(answer.walls.size(), answer.links.size());
  for (int wall : answer.walls) EXPECT_LT(wall, static_cast<int>(done.reader.sample().walls.size()));
  EXPECT_DOUBLE_EQ(answer.work, done.last("work"));
}

}  // namespace
}  // namespace lamella
