#include "simulator/trajectory/extract.h"

#include <gtest/gtest.h>

#include "generator/sample/errors.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

/// Two bonded squares, in frame k moved by k along x; in the last frame one link is broken.
TrajectoryReader moved_squares(const std::filesystem::path& path) {
  Sample sample = two_bonded_squares();
  sample.cell_thickness = {1, 2};
  for (std::size_t l = 0; l < sample.links.size(); ++l)
    sample.link_strength.push_back(1 + 0.1 * static_cast<double>(l));
  TrajectoryWriter writer(path, sample, {});
  for (int k = 0; k < 3; ++k) {
    Frame frame;
    frame.time = k;
    std::vector<double> x;
    for (const Vec2& at : sample.x) x.push_back(at.x() + k), x.push_back(at.y());
    frame.arrays.add({"x", "m", "node", 2, x});
    std::vector<std::int32_t> intact(sample.links.size(), 1);
    if (k == 2) intact[1] = 0;
    frame.arrays.add({"link_intact", "1", "link", 1, intact});
    writer.write_frame(frame, {});
  }
  writer.finish("test");
  return TrajectoryReader(path);
}

TEST(Extract, a_frame_gives_positions_and_the_sample_what_is_at_rest) {
  const TemporaryFolder folder;
  const TrajectoryReader reader = moved_squares(folder / "t.h5");
  const Sample before = reader.sample(), after = extract_sample(reader, 1);
  for (std::size_t i = 0; i < before.x.size(); ++i) EXPECT_EQ(after.x[i], before.x[i] + Vec2(1, 0));
  EXPECT_EQ(after.rest_length, before.rest_length);
  EXPECT_EQ(after.rest_angle, before.rest_angle);
  EXPECT_EQ(after.rest_area, before.rest_area);
  EXPECT_EQ(after.links.size(), before.links.size());
}

TEST(Extract, links_that_are_broken_are_left_out) {
  const TemporaryFolder folder;
  const TrajectoryReader reader = moved_squares(folder / "t.h5");
  const Sample before = reader.sample(), after = extract_sample(reader, -1);
  ASSERT_EQ(after.links.size(), before.links.size() - 1);
  EXPECT_EQ(after.links[0].a, before.links[0].a);
  EXPECT_EQ(after.links[1].a, before.links[2].a);
  EXPECT_EQ(after.cell_thickness, before.cell_thickness);
  ASSERT_EQ(after.link_strength.size(), after.links.size());
  EXPECT_EQ(after.link_strength[0], before.link_strength[0]);
  EXPECT_EQ(after.link_strength[1], before.link_strength[2]);
}

TEST(Extract, a_frame_that_is_not_there_is_refused) {
  const TemporaryFolder folder;
  const TrajectoryReader reader = moved_squares(folder / "t.h5");
  EXPECT_THROW(extract_sample(reader, 3), SceneError);
  EXPECT_THROW(extract_sample(reader, -4), SceneError);
}

}  // namespace
}  // namespace lamella
