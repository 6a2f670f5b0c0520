// Trajectories that are truncated, damaged, or contradict themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>

#include "generator/sample/errors.h"
#include "generator/sample/h5.h"
#include "simulator/trajectory/trajectory.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

/// HDF5 itself forgets some memory when it refuses a damaged file.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace lamella {
namespace {

using testing::HasSubstr;

class DamagedTrajectory : public testing::Test {
 protected:
  void SetUp() override {
    const Sample sample = two_bonded_squares(30);
    TrajectoryWriter writer(path_, sample, {{"title", "test"}});
    writer.set_response_columns({"time"}, {"s"});
    for (int i = 0; i < 3; ++i) {
      Frame frame;
      frame.time = i;
      std::vector<double> x;
      for (const auto& point : sample.x) x.push_back(point.x()), x.push_back(point.y() * (1 + i / 7.0));
      frame.arrays.add({"x", "m", "node", 2, x});
      writer.add_response({1.0 * i});
      writer.add_event({.time = 1.0 * i, .link = i});
      writer.write_frame(frame, frame.arrays);
    }
    writer.finish("strain reached");
    std::ifstream file(path_, std::ios::binary);
    whole_.assign(std::istreambuf_iterator<char>(file), {});
  }

  /// What reading everything says.
  std::string message() const {
    try {
      const TrajectoryReader reader(path_);
      for (int i = 0; i < reader.frames(); ++i) reader.frame(i);
      reader.restart();
    } catch (const DataError& error) {
      return error.what();
    }
    return "no DataError";
  }

  void replace(const std::string& bytes) const { std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes; }

  /// A copy of the file, with some members replaced by what `spoil` writes.
  std::string fault(const std::vector<std::string>& without, const std::function<void(h5::Node&)>& spoil) {
    const auto spoilt = folder_ / "spoilt.h5";
    {
      replace(whole_);
      const auto from = h5::Node::open(path_);
      auto file = h5::Node::create(spoilt);
      file.write_text("format", "lamella trajectory 1");
      file.write_text("ended", "strain reached");
      for (const auto& name : from.names())
        if (std::find(without.begin(), without.end(), name) == without.end()) file.copy(from, name, name);
      spoil(file);
      file.close();
    }
    std::filesystem::rename(spoilt, path_);
    return message();
  }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "run.h5";
  std::string whole_;
};

TEST_F(DamagedTrajectory, a_whole_file_is_read) {
  EXPECT_EQ(message(), "no DataError");
  EXPECT_EQ(fault({}, [](h5::Node&) {}), "no DataError");
}

TEST_F(DamagedTrajectory, a_truncated_file_is_refused) {
  for (int part = 0; part < 50; ++part) {
    replace(whole_.substr(0, whole_.size() * part / 50));
    EXPECT_NE(message(), "no DataError") << "cut at " << part << "/50";
  }
}

TEST_F(DamagedTrajectory, damaged_bytes_are_refused_or_do_no_harm) {
  std::mt19937 random(1);
  int refused = 0;
  const int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    std::string damaged = whole_;
    for (int i = 0; i < 8; ++i) damaged[random() % damaged.size()] = static_cast<char>(random());
    replace(damaged);
    refused += message() != "no DataError";
  }
  EXPECT_GT(refused, trials / 2);
}

TEST_F(DamagedTrajectory, contradictions_are_named) {
  EXPECT_THAT(fault({"sample"}, [](h5::Node&) {}), HasSubstr("group 'sample' is missing"));
  EXPECT_THAT(fault({"response"}, [](h5::Node&) {}), HasSubstr("group 'response' is missing"));
  EXPECT_THAT(fault({"restart"}, [](h5::Node&) {}), HasSubstr("group 'restart' is missing"));
  EXPECT_THAT(fault({"time"},
                    [](h5::Node& file) {
                      file.write("time", std::vector<double>{0, 1});
                    }),
              HasSubstr("holds 3 frames, but 2 times, 3 steps and 3 stages"));
  EXPECT_THAT(fault({"time"},
                    [](h5::Node& file) {
                      file.write("time", std::vector<double>{0, 2, 1});
                    }),
              HasSubstr("frame 2: time 1 s follows 2 s; times must increase"));
  EXPECT_THAT(fault({"frames"},
                    [](h5::Node& file) {
                      auto frames = file.make_group("frames");
                      for (const char* name : {"000000", "000001", "000003"}) frames.make_group(name);
                    }),
              HasSubstr("frame 0: array 'x', two numbers per node, is missing"));
  EXPECT_THAT(fault({"events"},
                    [](h5::Node& file) {
                      auto events = file.make_group("events");
                      events.write("time", std::vector<double>{1});
                    }),
              HasSubstr("array 'step' is missing"));
}

TEST_F(DamagedTrajectory, other_files_are_named_as_such) {
  EXPECT_THAT(fault({"sample", "frames", "restart"}, [](h5::Node&) {}), HasSubstr("is missing"));
  {
    auto file = h5::Node::create(path_);
    file.write_text("format", "lamella sample 1");
    file.close();
  }
  EXPECT_THAT(message(), HasSubstr("is of the format 'lamella sample 1'; must be 'lamella trajectory 1'"));
  std::filesystem::remove(path_);
  EXPECT_THAT(message(), HasSubstr("run.h5 does not exist"));
}

TEST_F(DamagedTrajectory, a_frame_is_read_without_the_others) {
  // A hole in the middle of the file, in one frame or another: some frame is still there.
  std::string damaged = whole_;
  const auto at = damaged.size() / 2;
  for (std::size_t i = at; i < at + 64; ++i) damaged[i] = static_cast<char>(~damaged[i]);
  replace(damaged);
  int read = 0;
  try {
    const TrajectoryReader reader(path_);
    for (int i = 0; i < 3; ++i) {
      try {
        reader.frame(i);
        ++read;
      } catch (const DataError&) {
      }
    }
  } catch (const DataError&) {
    GTEST_SKIP() << "the hole is not in a frame";
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace lamella
