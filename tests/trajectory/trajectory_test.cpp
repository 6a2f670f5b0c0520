#include "simulator/trajectory/trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include "generator/sample/errors.h"
#include "generator/sample/h5.h"
#include "tests/support/messages.h"
#include "tests/support/samples.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::HasSubstr;

const Sample& sample() {
  static const Sample squares = two_bonded_squares(50);
  return squares;
}

/// A frame whose numbers follow from its index.
Frame frame_of(int index) {
  Frame frame;
  frame.time = 0.1 * index;
  frame.step = 1000 * index;
  std::vector<double> x;
  for (const auto& point : sample().x) x.push_back(point.x() + std::sin(index)), x.push_back(point.y() / (1 + index));
  frame.arrays.add({"x", "m", "node", 2, x});
  frame.arrays.add({"link_intact", "1", "link", 1, std::vector<std::int32_t>(sample().links.size(), index % 2)});
  const std::size_t contacts = static_cast<std::size_t>(index % 3);
  frame.arrays.add({"contact_node", "1", "contact", 1, std::vector<std::int32_t>(contacts, 5)});
  frame.arrays.add({"contact_force", "N", "contact", 2, std::vector<double>(2 * contacts, 0.25)});
  return frame;
}

ArraySet restart_of(int index) {
  ArraySet arrays;
  arrays.add({"v", "m/s", "node", 2, std::vector<double>(2 * sample().x.size(), 1.0 / (3 + index))});
  arrays.add({"clock", "1", "model", 1, std::vector<std::int64_t>{index, 7}});
  return arrays;
}

/// Two response rows and, every third frame, one event go before each frame.
void write(TrajectoryWriter& writer, int index) {
  writer.add_response({0.1 * index - 0.05, 10.0 * index});
  writer.add_response({0.1 * index, 10.0 * index + 1});
  if (index % 3 == 0) {
    Event event;
    event.time = 0.1 * index, event.step = 1000 * index, event.link = index % 7, event.position = {0.5, index + 0.25};
    event.f_n = 2, event.f_t = -1, event.mode_mix = 0.4, event.energy = 1e-9, event.strain = 0.01 * index;
    writer.add_event(event);
  }
  writer.write_frame(frame_of(index), restart_of(index));
}

TrajectoryWriter new_writer(const std::filesystem::path& path) {
  TrajectoryWriter writer(path, sample(), {{"title", "test"}, {"scene", "title = \"test\"\n"}});
  writer.set_response_columns({"time", "stress"}, {"s", "Pa"});
  return writer;
}

void expect_same(const ArraySet& read, const ArraySet& expected) {
  ASSERT_EQ(read.all().size(), expected.all().size());
  for (const auto& array : expected.all()) {
    const NamedArray* found = read.find(array.name);
    ASSERT_NE(found, nullptr) << array.name;
    EXPECT_EQ(found->unit, array.unit);
    EXPECT_EQ(found->per, array.per);
    EXPECT_EQ(found->components, array.components);
    EXPECT_TRUE(found->data == array.data) << array.name;
  }
}

/// That a trajectory is, bit by bit, what an uninterrupted run of so many frames writes.
void expect_run(const std::filesystem::path& path, int frames) {
  const TrajectoryReader reader(path);
  EXPECT_EQ(reader.sample().x, sample().x);
  EXPECT_EQ(reader.sample().links.size(), sample().links.size());
  EXPECT_EQ(reader.provenance().at("title"), "test");
  EXPECT_EQ(reader.provenance().at("scene"), "title = \"test\"\n");
  ASSERT_EQ(reader.frames(), frames);
  for (int i = 0; i < frames; ++i) {
    const Frame read = reader.frame(i), expected = frame_of(i);
    EXPECT_EQ(read.time, expected.time);
    EXPECT_EQ(read.step, expected.step);
    EXPECT_EQ(read.stage, expected.stage);
    expect_same(read.arrays, expected.arrays);
  }
  expect_same(reader.restart(), restart_of(frames - 1));
  EXPECT_EQ(reader.response().columns, (std::vector<std::string>{"time", "stress"}));
  EXPECT_EQ(reader.response().units, (std::vector<std::string>{"s", "Pa"}));
  ASSERT_EQ(reader.response().rows.size(), 2u * frames);
  for (int i = 0; i < frames; ++i)
    EXPECT_EQ(reader.response().rows[2 * i + 1], (std::vector<double>{0.1 * i, 10.0 * i + 1}));
  ASSERT_EQ(reader.events().size(), static_cast<std::size_t>((frames + 2) / 3));
  for (std::size_t e = 0; e < reader.events().size(); ++e) {
    const int i = 3 * static_cast<int>(e);
    EXPECT_EQ(reader.events()[e].time, 0.1 * i);
    EXPECT_EQ(reader.events()[e].step, 1000 * i);
    EXPECT_EQ(reader.events()[e].link, i % 7);
    EXPECT_EQ(reader.events()[e].position, Vec2(0.5, i + 0.25));
    EXPECT_EQ(reader.events()[e].strain, 0.01 * i);
  }
}

class Trajectory : public testing::Test {
 protected:
  std::filesystem::path parts() const { return path_.string() + ".parts"; }

  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "run.h5";
};

TEST_F(Trajectory, a_finished_run_comes_back_bit_by_bit_and_leaves_no_parts) {
  auto writer = new_writer(path_);
  for (int i = 0; i < 10; ++i) write(writer, i);
  writer.finish("strain reached");
  expect_run(path_, 10);
  EXPECT_EQ(TrajectoryReader(path_).ended(), "strain reached");
  EXPECT_FALSE(std::filesystem::exists(parts()));
}

TEST_F(Trajectory, rows_after_the_last_frame_are_kept) {
  auto writer = new_writer(path_);
  write(writer, 0);
  writer.add_response({0.02, 5});
  writer.finish("interrupted");
  EXPECT_EQ(TrajectoryReader(path_).response().rows.size(), 3u);
}

TEST_F(Trajectory, a_run_killed_at_any_moment_keeps_every_frame_that_was_written) {
  int progress[2];
  ASSERT_EQ(::pipe(progress), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      auto writer = new_writer(path_);
      for (int i = 0; ::write(progress[1], "f", 1) == 1; ++i) write(writer, i);
    } catch (const DataError&) {
    }
    ::_exit(1);
  }
  ::close(progress[1]);
  char mark;
  for (int i = 0; i < 8; ++i) ASSERT_EQ(::read(progress[0], &mark, 1), 1);
  ::usleep(1500);  // somewhere in the next frame
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  int written = 7;
  while (::read(progress[0], &mark, 1) == 1) ++written;
  ::close(progress[0]);

  std::ofstream(parts() / ".frame_000099.h5.1.tmp") << "half a frame";
  const int frames = TrajectoryReader(path_).frames();
  EXPECT_GE(frames, written);
  EXPECT_LE(frames, written + 1);
  expect_run(path_, frames);
  EXPECT_EQ(TrajectoryReader(path_).ended(), "interrupted");
  EXPECT_FALSE(std::filesystem::exists(parts()));
}

TEST_F(Trajectory, a_run_resumed_from_its_parts_is_the_same_as_an_uninterrupted_one) {
  {
    auto writer = new_writer(path_);
    for (int i = 0; i < 4; ++i) write(writer, i);
    writer.add_response({0.35, 1});  // never saved: computed again
  }
  {
    auto writer = TrajectoryWriter::resume(path_);
    EXPECT_EQ(writer.frames(), 4);
    EXPECT_EQ(writer.sample().x, sample().x);
    EXPECT_EQ(writer.last_frame().step, 3000);
    EXPECT_EQ(writer.response_columns(), (std::vector<std::string>{"time", "stress"}));
    expect_same(writer.restart(), restart_of(3));
    writer.set_response_columns({"time", "stress"}, {"s", "Pa"});
    for (int i = 4; i < 9; ++i) write(writer, i);
    writer.finish("strain reached");
  }
  expect_run(path_, 9);
}

TEST_F(Trajectory, a_run_resumed_from_its_file_is_the_same_as_an_uninterrupted_one) {
  {
    auto writer = new_writer(path_);
    for (int i = 0; i < 4; ++i) write(writer, i);
    writer.add_response({0.35, 1});  // after the restart: computed again
    writer.finish("interrupted");
  }
  {
    auto writer = TrajectoryWriter::resume(path_);
    EXPECT_EQ(writer.frames(), 4);
    EXPECT_EQ(writer.last_frame().step, 3000);
    EXPECT_EQ(writer.ended(), "interrupted");
    expect_same(writer.restart(), restart_of(3));
    for (int i = 4; i < 6; ++i) write(writer, i);
  }  // stopped again, with parts beside the file
  EXPECT_EQ(TrajectoryReader(path_).frames(), 4);
  {
    auto writer = TrajectoryWriter::resume(path_);
    EXPECT_EQ(writer.frames(), 6);
    EXPECT_EQ(writer.ended(), "interrupted");
    expect_same(writer.restart(), restart_of(5));
    for (int i = 6; i < 9; ++i) write(writer, i);
    writer.finish("strain reached");
  }
  expect_run(path_, 9);
}

TEST_F(Trajectory, resuming_without_a_new_frame_changes_nothing) {
  {
    auto writer = new_writer(path_);
    for (int i = 0; i < 4; ++i) write(writer, i);
    writer.finish("interrupted");
  }
  { const auto writer = TrajectoryWriter::resume(path_); }
  EXPECT_FALSE(std::filesystem::exists(parts()));
  expect_run(path_, 4);
  TrajectoryWriter::resume(path_).finish("interrupted");
  expect_run(path_, 4);
}

TEST_F(Trajectory, there_must_be_something_to_resume) {
  EXPECT_THAT(message_of([&] { TrajectoryWriter::resume(path_); }), HasSubstr("there is nothing to resume"));
  EXPECT_FALSE(std::filesystem::exists(parts()));
  { auto writer = new_writer(path_); }
  EXPECT_THAT(message_of([&] { TrajectoryWriter::resume(path_); }), HasSubstr("there is nothing to resume"));
  new_writer(path_).finish("time reached");
  EXPECT_EQ(TrajectoryReader(path_).frames(), 0);
  EXPECT_THAT(message_of([&] { TrajectoryWriter::resume(path_); }), HasSubstr("there is nothing to resume"));
  EXPECT_THAT(message_of([&] { TrajectoryReader(path_).restart(); }), HasSubstr("nothing to restart from"));
}

TEST_F(Trajectory, a_new_run_leaves_the_file_of_the_last_one_until_it_is_complete) {
  {
    auto writer = new_writer(path_);
    for (int i = 0; i < 3; ++i) write(writer, i);
    writer.finish("strain reached");
  }
  {
    auto writer = new_writer(path_);
    for (int i = 0; i < 6; ++i) write(writer, i);
    expect_run(path_, 3);
  }
  expect_run(path_, 3);
  {
    const auto writer = TrajectoryWriter::resume(path_);  // would continue the new one, not the complete one
    EXPECT_EQ(writer.frames(), 6);
    EXPECT_EQ(writer.ended(), "interrupted");
  }
  auto writer = new_writer(path_);  // drops the unfinished one
  for (int i = 0; i < 2; ++i) write(writer, i);
  writer.finish("strain reached");
  expect_run(path_, 2);
}

TEST_F(Trajectory, two_programs_cannot_write_the_same_file) {
  auto writer = new_writer(path_);
  write(writer, 0);
  const std::string process = std::to_string(::getpid());
  EXPECT_THAT(message_of([&] { new_writer(path_); }), HasSubstr("another program (process " + process + ")"));
  EXPECT_THAT(message_of([&] { TrajectoryWriter::resume(path_); }), HasSubstr("another program"));
  EXPECT_THAT(message_of([&] { TrajectoryReader reader(path_); }), HasSubstr("another program"));
  write(writer, 1);
  writer.finish("strain reached");
  expect_run(path_, 2);
}

TEST_F(Trajectory, the_lock_of_a_program_that_died_is_free) {
  std::filesystem::create_directory(parts());
  std::ofstream(parts() / "lock") << "1";
  auto writer = new_writer(path_);
  write(writer, 0);
  writer.finish("strain reached");
  expect_run(path_, 1);
}

TEST_F(Trajectory, a_target_that_cannot_be_written_is_found_at_once) {
  EXPECT_THAT(message_of([&] { new_writer(folder_ / "no/run.h5"); }), HasSubstr("no does not exist"));
  EXPECT_THAT(message_of([&] { new_writer(folder_.path()); }), HasSubstr("it is not a file"));
  std::ofstream(parts()) << "a file where the folder must be";
  EXPECT_THAT(message_of([&] { new_writer(path_); }), HasSubstr("run.h5.parts cannot be written"));
}

TEST_F(Trajectory, frames_that_could_not_be_read_again_are_not_written) {
  auto writer = new_writer(path_);
  write(writer, 1);
  const auto spoilt = [&](auto spoil) {
    Frame frame = frame_of(2);
    spoil(frame);
    return message_of([&] { writer.write_frame(frame, {}); });
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t nodes = sample().x.size();
  EXPECT_THAT(spoilt([](Frame& f) { f.arrays = {}; }),
              HasSubstr("frame 1: array 'x', two numbers per node, is missing"));
  EXPECT_THAT(spoilt([](Frame& f) { f.time = 0.1; }), HasSubstr("time 0.1 s follows 0.1 s; times must increase"));
  EXPECT_THAT(spoilt([](Frame& f) { f.stage = -1; }), HasSubstr("stages must not go back"));
  EXPECT_THAT(spoilt([&](Frame& f) {
                f.arrays.add({"v", "m/s", "node", 1, std::vector<double>(nodes, nan)});
              }),
              HasSubstr("array 'v' of node 0 is not a finite number"));
  EXPECT_THAT(spoilt([](Frame& f) {
                f.arrays.add({"p", "Pa", "cell", 1, std::vector<double>(3)});
              }),
              HasSubstr("array 'p' has 3 values of 1 components; must have 2 rows, one per cell"));
  EXPECT_THAT(spoilt([](Frame& f) {
                f.arrays.add({"p", "Pa", "cells", 1, std::vector<double>(2)});
              }),
              HasSubstr("is per 'cells'; must be per node"));
  EXPECT_THAT(spoilt([](Frame& f) {
                f.arrays.add({"contact_cell", "1", "contact", 1, std::vector<std::int32_t>{0, 2}});
              }),
              HasSubstr("'contact_cell' holds 2; must be from 0 to 1"));
  EXPECT_THAT(message_of([&] { writer.add_response({1}); }), HasSubstr("has 1 values; must have 2"));
  EXPECT_THAT(message_of([&] {
                writer.add_response({1, nan});
              }),
              HasSubstr("'stress' of the response is not a finite"));
  EXPECT_THAT(message_of([&] { writer.add_event({.link = 1000}); }), HasSubstr("an event names link 1000"));
  EXPECT_THAT(message_of([&] { writer.add_event({.link = 0, .bar = 2}); }),
              HasSubstr("an event names bar 2 and link 0"));
  EXPECT_THAT(message_of([&] { writer.add_event({.link = -1, .bar = 1000}); }), HasSubstr("an event names bar 1000"));
  EXPECT_THAT(message_of([&] { writer.set_response_columns({"time"}, {"s"}); }),
              HasSubstr("cannot change within a run"));
  Frame next = frame_of(1);
  next.stage = 1;  // the same time, but a new stage
  writer.write_frame(next, restart_of(1));
}

TEST_F(Trajectory, events_of_bars_and_links_come_back_as_they_were) {
  {
    TrajectoryWriter writer = new_writer(path_);
    writer.add_event({.time = 0.1, .link = 3});
    writer.write_frame(frame_of(0), restart_of(0));
    writer.add_event({.time = 0.2, .link = -1, .bar = 2, .position = {1, 2}, .f_n = 5});
    writer.add_event({.time = 0.2, .link = 1});
    writer.write_frame(frame_of(1), restart_of(1));
    writer.finish("test");
  }
  const TrajectoryReader reader(path_);
  ASSERT_EQ(reader.events().size(), 3u);
  EXPECT_EQ(reader.events()[0].bar, -1);
  EXPECT_EQ(reader.events()[0].link, 3);
  EXPECT_EQ(reader.events()[1].bar, 2);
  EXPECT_EQ(reader.events()[1].link, -1);
  EXPECT_EQ(reader.events()[1].f_n, 5);
  EXPECT_EQ(reader.events()[2].bar, -1);
}

TEST_F(Trajectory, an_array_is_found_by_name_and_type) {
  ArraySet arrays;
  arrays.add({"a", "1", "model", 1, std::vector<double>{1}});
  EXPECT_EQ(arrays.find("b"), nullptr);
  EXPECT_EQ(arrays.doubles("a").at(0), 1);
  EXPECT_THAT(message_of([&] { arrays.doubles("b"); }), HasSubstr("array 'b' is missing"));
  EXPECT_THAT(message_of([&] { arrays.ints("a"); }), HasSubstr("'a' is of the wrong type; must hold 32-bit integers"));
  EXPECT_THAT(message_of([&] { arrays.longs("a"); }), HasSubstr("must hold 64-bit integers"));
  EXPECT_THAT(message_of([&] {
                arrays.add({"a", "1", "model", 1, std::vector<double>{1}});
              }),
              HasSubstr("given twice"));
}

TEST_F(Trajectory, a_frame_too_large_for_the_disk_leaves_those_before_it) {
  auto writer = new_writer(path_);
  for (int i = 0; i < 3; ++i) write(writer, i);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{3000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const std::string frame_message = message_of([&] { write(writer, 3); });
  const std::string finish_message = message_of([&] { writer.finish("strain reached"); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(frame_message, HasSubstr("File too large"));
  EXPECT_THAT(finish_message, HasSubstr("every frame is kept in"));
  { const auto gone = std::move(writer); }  // lets go of the lock
  expect_run(path_, 3);
}

TEST_F(Trajectory, a_full_disk_leaves_the_frames_before_it_and_the_run_can_be_resumed) {
  const auto disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=256k") != 0) GTEST_SKIP() << "no right to mount a small disk";
  const auto target = disk / "run.h5";
  const auto ballast = disk / "ballast";
  int written = 0;
  std::string message;
  {
    auto writer = new_writer(target);
    std::ofstream(ballast) << std::string(120'000, 'x');
    message = message_of([&] {
      for (; written < 1000; ++written) write(writer, written);
    });
  }
  std::filesystem::remove(ballast);
  {
    auto writer = TrajectoryWriter::resume(target);
    EXPECT_EQ(writer.frames(), written);
    writer.finish("the disk was full");
  }
  EXPECT_THAT(message, HasSubstr("No space left on device"));
  EXPECT_GT(written, 0);
  expect_run(target, written);
  ::umount(disk.c_str());
}

}  // namespace
}  // namespace lamella
