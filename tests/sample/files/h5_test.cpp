#include "generator/sample/h5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>

#include "generator/sample/errors.h"
#include "generator/sample/parallel.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using testing::HasSubstr;

class H5 : public testing::Test {
 protected:
  TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "file.h5";
};

TEST_F(H5, arrays_of_every_type_come_back_bit_by_bit) {
  std::vector<double> doubles{0.0, -0.0, 1e-310, std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::quiet_NaN()};
  for (int i = 0; i < 300'001; ++i) doubles.push_back(std::sin(i));  // several chunks
  const std::vector<std::int32_t> ints{1, -2, std::numeric_limits<std::int32_t>::min(), 3};
  const std::vector<std::int64_t> longs{1, std::numeric_limits<std::int64_t>::max()};
  const std::vector<std::uint8_t> bytes{0, 255};
  {
    auto file = h5::Node::create(path_);
    file.write("doubles", doubles, 2);
    auto group = file.make_group("group");
    group.write("ints", ints, 2);
    group.write("longs", longs);
    group.write("bytes", bytes);
    group.write("nothing", std::vector<double>{}, 2);
    file.close();
  }
  const auto file = h5::Node::open(path_);
  const auto read = file.doubles("doubles", 2);
  ASSERT_EQ(read.size(), doubles.size());
  EXPECT_EQ(std::memcmp(read.data(), doubles.data(), read.size() * sizeof(double)), 0);
  const auto group = file.group("group");
  EXPECT_EQ(group.ints("ints", 2), ints);
  EXPECT_EQ(group.longs("longs"), longs);
  EXPECT_EQ(group.bytes("bytes"), bytes);
  EXPECT_TRUE(group.doubles("nothing", 2).empty());
  EXPECT_EQ(group.names(), (std::vector<std::string>{"bytes", "ints", "longs", "nothing"}));
  EXPECT_EQ(file.kind("doubles"), 'd');
  EXPECT_EQ(group.kind("ints"), 'i');
  EXPECT_EQ(group.kind("longs"), 'l');
  EXPECT_EQ(group.kind("bytes"), 'b');
  EXPECT_EQ(group.columns("ints"), 2);
}

TEST_F(H5, files_hold_no_dates_so_that_the_same_content_is_the_same_bytes) {
  {
    auto file = h5::Node::create(path_);
    file.write("small", std::vector<double>{1});
    auto group = file.make_group("group");
    group.write("large", std::vector<double>(300'000, 1.0));
    group.close();
    file.close();
  }
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  for (const char* name : {"/", "/small", "/group", "/group/large"}) {
    H5O_info_t info{};
    ASSERT_GE(H5Oget_info_by_name(file, name, &info, H5P_DEFAULT), 0) << name;
    for (const auto date : {info.atime, info.mtime, info.ctime, info.btime}) EXPECT_EQ(date, 0) << name;
  }
  H5Fclose(file);
}

TEST_F(H5, attributes_come_back_whatever_their_length) {
  const std::string scene(1'000'000, 'x');
  {
    auto file = h5::Node::create(path_);
    file.write("array", std::vector<double>{1});
    file.write_text("scene", scene);
    file.write_text("empty", "");
    file.write_text("array@unit", "µm");
    file.write_number("number", 0.1);
    file.write_integer("integer", -7);
    file.write_texts("names", {"a", "", "c d"});
    file.write_texts("none", {});
    file.close();
  }
  const auto file = h5::Node::open(path_);
  EXPECT_EQ(file.text("scene"), scene);
  EXPECT_EQ(file.text("empty"), "");
  EXPECT_EQ(file.text("array@unit"), "µm");
  EXPECT_EQ(file.number("number"), 0.1);
  EXPECT_EQ(file.integer("integer"), -7);
  EXPECT_EQ(file.texts("names"), (std::vector<std::string>{"a", "", "c d"}));
  EXPECT_TRUE(file.texts("none").empty());
  EXPECT_EQ(file.attributes().size(), 6u);
  EXPECT_TRUE(file.has_attribute("scene"));
  EXPECT_FALSE(file.has_attribute("array@meaning"));
}

TEST_F(H5, integers_of_other_widths_are_read_and_refused_only_when_they_do_not_fit) {
  {
    auto file = h5::Node::create(path_);
    file.write("fits", std::vector<std::int64_t>{1, 200});
    file.write("wide", std::vector<std::int64_t>{1, std::int64_t{1} << 40});
    file.close();
  }
  const auto file = h5::Node::open(path_);
  EXPECT_EQ(file.ints("fits"), (std::vector<std::int32_t>{1, 200}));
  EXPECT_EQ(file.bytes("fits"), (std::vector<std::uint8_t>{1, 200}));
  EXPECT_EQ(file.doubles("fits"), (std::vector<double>{1, 200}));
  EXPECT_THAT(message_of([&] { file.ints("wide"); }),
              HasSubstr("array 'wide' holds 1099511627776; must be from -2147483648"));
}

TEST_F(H5, faults_of_a_file_are_named) {
  EXPECT_THAT(message_of([&] { h5::Node::open(path_); }), HasSubstr("file.h5 does not exist"));
  EXPECT_THAT(message_of([&] { h5::Node::open(folder_.path()); }), HasSubstr("is not a file"));
  std::ofstream(path_).flush();
  EXPECT_THAT(message_of([&] { h5::Node::open(path_); }), HasSubstr("file.h5 is empty"));
  std::ofstream(path_) << "x y cell\n0 0 1\n";
  EXPECT_THAT(message_of([&] { h5::Node::open(path_); }), HasSubstr("file.h5 is not an HDF5 file"));
  {
    auto file = h5::Node::create(path_);
    file.write("array", std::vector<double>(1000, 1.0));
    file.close();
  }
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 10);
  EXPECT_THAT(message_of([&] { h5::Node::open(path_); }), HasSubstr("file.h5 is truncated"));
  EXPECT_THAT(message_of([&] { h5::Node::create(folder_ / "no/file.h5"); }), HasSubstr("No such file or directory"));
}

TEST_F(H5, faults_of_an_array_are_named) {
  {
    auto file = h5::Node::create(path_);
    file.write("pairs", std::vector<double>{1, 2}, 2);
    file.write("reals", std::vector<double>{1.5});
    file.make_group("group");
    file.write_text("text", "a");
    file.close();
  }
  const auto file = h5::Node::open(path_);
  EXPECT_THAT(message_of([&] { file.doubles("absent"); }), HasSubstr("file.h5:/: array 'absent' is missing"));
  EXPECT_THAT(message_of([&] { file.doubles("group"); }), HasSubstr("no array"));
  EXPECT_THAT(message_of([&] { file.doubles("pairs"); }), HasSubstr("array 'pairs' has 2 columns; must have 1"));
  EXPECT_THAT(message_of([&] { file.ints("reals"); }), HasSubstr("holds floating-point numbers; must hold integers"));
  EXPECT_THAT(message_of([&] { file.group("absent"); }), HasSubstr("group 'absent' is missing"));
  EXPECT_THAT(message_of([&] { file.group("pairs"); }), HasSubstr("no group"));
  EXPECT_THAT(message_of([&] { file.text("absent"); }), HasSubstr("attribute 'absent' is missing"));
  EXPECT_THAT(message_of([&] { file.text("absent@unit"); }), HasSubstr("attribute 'absent@unit' is missing"));
  EXPECT_THAT(message_of([&] { file.number("text"); }), HasSubstr("holds text; must be a number"));
}

/// A file by the library itself, with an array that claims more than the file can hold.
void write_claim(const std::filesystem::path& path, hsize_t rows, bool chunked) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(1, &rows, nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunk = 1 << 20;
  if (chunked) {
    H5Pset_chunk(properties, 1, &chunk);
    H5Pset_deflate(properties, 1);
  }
  const hid_t array = H5Dcreate2(file, "x", H5T_IEEE_F64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  H5Dclose(array), H5Pclose(properties), H5Sclose(space), H5Fclose(file);
}

TEST_F(H5, an_array_that_claims_more_than_the_file_holds_is_refused_before_memory_is_taken) {
  for (const bool chunked : {false, true}) {
    write_claim(path_, 1'000'000'000'000'000, chunked);
    const auto file = h5::Node::open(path_);
    EXPECT_THAT(message_of([&] { file.doubles("x"); }), HasSubstr("claims 1000000000000000 x 1 values"));
  }
}

TEST_F(H5, links_into_other_files_are_not_followed) {
  const auto other = folder_ / "other.h5";
  {
    auto file = h5::Node::create(other);
    file.write("x", std::vector<double>{1});
    file.close();
  }
  const hid_t file = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Lcreate_external(other.c_str(), "/x", file, "x", H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  EXPECT_THAT(message_of([&] { h5::Node::open(path_).doubles("x"); }), HasSubstr("array 'x' is missing"));
}

TEST_F(H5, a_group_is_copied_between_files_with_its_attributes) {
  const auto other = folder_ / "other.h5";
  {
    auto file = h5::Node::create(other);
    auto group = file.make_group("frame");
    group.write("x", std::vector<double>(1000, 2.5));
    group.write_text("x@unit", "m");
    file.close();
  }
  {
    auto file = h5::Node::create(path_);
    auto frames = file.make_group("frames");
    frames.copy(h5::Node::open(other), "frame", "000007");
    file.close();
  }
  const auto frame = h5::Node::open(path_).group("frames").group("000007");
  EXPECT_EQ(frame.doubles("x"), std::vector<double>(1000, 2.5));
  EXPECT_EQ(frame.text("x@unit"), "m");
}

/// Files cannot grow beyond a limit while this lives: to a program, the same as a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_F(H5, arrays_of_many_chunks_come_back_whatever_the_number_of_threads) {
  // 1 MB a chunk: whole ones, a short one at the end, one row in the last, and rows wider than a value.
  const auto some = [](std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t k = 0; k < count; ++k) values[k] = std::sin(0.01 * static_cast<double>(k)) * 1e-3;
    return values;
  };
  std::vector<std::int32_t> whole(3u << 18), odd((2u << 18) + 2);
  std::iota(whole.begin(), whole.end(), -1000), std::iota(odd.begin(), odd.end(), 5);
  std::vector<std::int64_t> longs(300'000);
  std::iota(longs.begin(), longs.end(), std::int64_t{1} << 40);
  std::vector<std::uint8_t> bytes(5'000'001);
  for (std::size_t k = 0; k < bytes.size(); ++k) bytes[k] = static_cast<std::uint8_t>(k * k >> 8);
  std::vector<std::uint8_t> noise(2'000'000);
  std::mt19937 random(1);
  for (std::uint8_t& value : noise) value = static_cast<std::uint8_t>(random());
  for (const int threads : {1, 2, 3}) {
    use_threads(threads);
    h5::replace_file(path_, [&](h5::Node& file) {
      file.write("doubles", some(1'000'000));
      file.write("pairs", some(1'000'002), 2);
      file.write("whole", whole);
      file.write("odd", odd, 2);
      file.write("longs", longs, 3);
      file.write("bytes", bytes);
      file.write("noise", noise);
    });
    const auto file = h5::Node::open(path_);
    EXPECT_EQ(file.doubles("doubles"), some(1'000'000));
    EXPECT_EQ(file.doubles("pairs", 2), some(1'000'002));
    EXPECT_EQ(file.ints("whole"), whole);
    EXPECT_EQ(file.ints("odd", 2), odd);
    EXPECT_EQ(file.longs("longs", 3), longs);
    EXPECT_EQ(file.bytes("bytes"), bytes);
    EXPECT_EQ(file.bytes("noise"), noise);
  }
  use_threads(1);
}

TEST_F(H5, a_file_that_cannot_be_written_leaves_the_one_before_it) {
  const auto write = [&](double value, std::size_t rows) {
    h5::replace_file(
        path_, [&](h5::Node& file) { file.write("x", std::vector<double>(rows, value)); }, h5::Storage::plain);
  };
  write(1, 10);
  {
    const FileSizeLimit limit(100'000);
    EXPECT_THAT(message_of([&] { write(2, 1'000'000); }),
                testing::AllOf(HasSubstr("file.h5"), HasSubstr("File too large")));
  }
  EXPECT_EQ(h5::Node::open(path_).doubles("x"), std::vector<double>(10, 1.0));
  EXPECT_FALSE(std::filesystem::exists(h5::temporary_name(path_)));
  write(3, 1'000'000);  // and the library is none the worse
  EXPECT_EQ(h5::Node::open(path_).doubles("x").size(), 1'000'000u);
}

TEST_F(H5, a_full_disk_that_shows_when_closing_is_reported_too) {
  // Arrays of less than a buffer stay in memory until the file is flushed.
  const auto write = [&] {
    h5::replace_file(path_, [&](h5::Node& file) {
      for (int i = 0; i < 200; ++i) file.make_group(std::to_string(i)).write_text("text", std::string(500, 'x'));
    });
  };
  {
    const FileSizeLimit limit(20'000);
    EXPECT_THAT(message_of(write), HasSubstr("File too large"));
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
  write();
  EXPECT_EQ(h5::Node::open(path_).names().size(), 200u);
}

}  // namespace
}  // namespace lamella
