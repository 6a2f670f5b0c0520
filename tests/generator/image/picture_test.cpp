// Files of every format, good and bad: what is written is read, and what is broken says so.
#include "generator/image/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/generator/image/pictures.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace lamella {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Pictures : public ::testing::Test {
 protected:
  TemporaryFolder folder;

  /// Values that use all bits.
  static Picture of_bits(int bits, int width = 37, int height = 23) {
    std::mt19937 random(7);
    const std::uint32_t white = bits == 32 ? 0xffffffffu : (1u << bits) - 1;
    std::uniform_int_distribution<std::uint32_t> value(0, white);
    Picture picture = picture_of(
        width, height, [&](int, int) { return value(random); }, white);
    picture.value[0] = white;
    picture.value[1] = 0;
    return picture;
  }

  void expect_read(const std::string& name, const Picture& picture, Colours colours = Colours::kRefuse) {
    const Picture read = read_picture(folder / name, colours);
    EXPECT_EQ(read.width, picture.width);
    EXPECT_EQ(read.height, picture.height);
    EXPECT_EQ(read.white, picture.white);
    EXPECT_EQ(read.value, picture.value);
  }

  std::string fault_of(const std::string& name, Colours colours = Colours::kRefuse) {
    const std::string fault = message_of([&] { read_picture(folder / name, colours); });
    EXPECT_THAT(fault, HasSubstr((folder / name).string() + ": "));
    return fault;
  }
  std::string fault_of_text(const std::string& text, Colours colours = Colours::kRefuse) {
    write(folder / "picture", text);
    return fault_of("picture", colours);
  }
};

TEST_F(Pictures, graymaps_are_read_as_written_in_digits_and_bytes_of_8_and_16_bits) {
  for (const int bits : {1, 8, 12, 16})
    for (const bool digits : {false, true}) {
      const Picture picture = of_bits(bits);
      write(folder / "a.pgm", pgm(picture, digits));
      expect_read("a.pgm", picture);
    }
}

TEST_F(Pictures, png_is_read_as_written_with_1_to_16_bits_interlaced_or_not) {
  for (const int bits : {1, 2, 4, 8, 16})
    for (const bool interlaced : {false, true}) {
      const Picture picture = of_bits(bits);
      write_png(folder / "a.png", picture, {.bits = bits, .interlaced = interlaced});
      expect_read("a.png", picture);
    }
}

TEST_F(Pictures, tiff_is_read_as_written_in_strips_and_tiles_of_either_byte_order) {
  for (const int bits : {8, 16, 32})
    for (const bool big_endian : {false, true})
      for (const int tile : {0, 16})
        for (const int compression : {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE}) {
          const Picture picture = of_bits(bits);
          write_tiff(folder / "a.tif", picture,
                     {.bits = bits, .compression = compression, .big_endian = big_endian, .tile = tile});
          expect_read("a.tif", picture);
        }
}

TEST_F(Pictures, signed_numbers_are_read_unless_they_are_negative) {
  Picture picture = of_bits(15);
  write_tiff(folder / "a.tif", picture, {.bits = 16, .format = SAMPLEFORMAT_INT});
  expect_read("a.tif", picture);
  picture.value[5] = 0xfffd;
  write_tiff(folder / "b.tif", picture, {.bits = 16, .format = SAMPLEFORMAT_INT});
  EXPECT_THAT(fault_of("b.tif"), HasSubstr("a negative number, -3"));
}

TEST_F(Pictures, colours_are_refused_as_numbers_and_become_brightness_in_a_micrograph) {
  const Picture picture = of_bits(8);
  write_png(folder / "rgb.png", picture, {.type = PNG_COLOR_TYPE_RGB});
  write_png(folder / "rgba.png", picture, {.type = PNG_COLOR_TYPE_RGB_ALPHA});
  write_png(folder / "palette.png", picture, {.type = PNG_COLOR_TYPE_PALETTE});
  write_tiff(folder / "rgb.tif", picture, {.bits = 8, .channels = 3});
  for (const char* name : {"rgb.png", "rgba.png", "palette.png", "rgb.tif"}) {
    EXPECT_THAT(fault_of(name), HasSubstr("save the numbers of the cells as one channel"));
    expect_read(name, picture, Colours::kToGrey);
  }
  const Picture wide = of_bits(16);
  write_png(folder / "wide.png", wide, {.bits = 16, .type = PNG_COLOR_TYPE_RGB});
  expect_read("wide.png", wide, Colours::kToGrey);
}

TEST_F(Pictures, white_stored_as_0_is_turned_round_in_a_micrograph_only) {
  Picture picture = of_bits(8);
  write_tiff(folder / "a.tif", picture, {.bits = 8, .photometric = PHOTOMETRIC_MINISWHITE});
  expect_read("a.tif", picture);
  for (auto& value : picture.value) value = 255 - value;
  expect_read("a.tif", picture, Colours::kToGrey);
}

TEST_F(Pictures, what_is_no_picture_is_refused_by_name) {
  EXPECT_THAT(message_of([&] { read_picture(folder / "none.png", Colours::kRefuse); }),
              HasSubstr("none.png: no such file; sample.image.file must name a PGM, PNG or TIFF picture"));
  EXPECT_THAT(message_of([&] { read_picture(folder.path(), Colours::kRefuse); }), HasSubstr("no such file"));
  EXPECT_THAT(fault_of_text(""), HasSubstr("is empty"));
  EXPECT_THAT(fault_of_text("P"), HasSubstr("is neither PGM nor PNG nor TIFF"));
  EXPECT_THAT(fault_of_text("x y cell\n0 0 a\n"), HasSubstr("is neither PGM nor PNG nor TIFF"));
  EXPECT_THAT(fault_of_text(std::string("\xff\xd8\xff\xe0 JPEG", 9)), HasSubstr("convert the picture"));
  EXPECT_THAT(fault_of_text("P6\n1 1\n255\nabc"), HasSubstr("is a P6 picture; convert it to a graymap"));
  EXPECT_THAT(fault_of_text("P1\n1 1\n1"), HasSubstr("is a P1 picture"));
}

TEST_F(Pictures, unreadable_files_are_refused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root reads everything";
  write(folder / "a.pgm", "P2 1 1 255 0");
  std::filesystem::permissions(folder / "a.pgm", std::filesystem::perms::none);
  EXPECT_THAT(fault_of("a.pgm"), HasSubstr("cannot be read"));
}

TEST_F(Pictures, graymaps_that_lie_are_refused) {
  EXPECT_THAT(fault_of_text("P2 2 2 255 1 2 3"), HasSubstr("is truncated"));
  EXPECT_THAT(fault_of_text("P2 2 2 255 1 2 3 4 5"), HasSubstr("goes on after 2 x 2 pixels"));
  EXPECT_THAT(fault_of_text("P2 2 2 255 1 2 x 4"), HasSubstr("a pixel is no number"));
  EXPECT_THAT(fault_of_text("P2 2 2 255 1 2 -3 4"), HasSubstr("is no number"));
  EXPECT_THAT(fault_of_text("P2 2 2 255 1 2 3.5 4"), HasSubstr("is no number"));
  EXPECT_THAT(fault_of_text("P2 2 2 3 1 2 3 4"), HasSubstr("pixel 1 of row 1 is 4, more than the maximum of 3"));
  EXPECT_THAT(fault_of_text("P2 0 2 255"), HasSubstr("0 x 2 pixels; it needs at least one"));
  EXPECT_THAT(fault_of_text("P2 2 2 70000 1 2 3 4"), HasSubstr("maximum is 70000; it must be 1 to 65535"));
  EXPECT_THAT(fault_of_text("P2 2 2 0 0 0 0 0"), HasSubstr("maximum is 0"));
  EXPECT_THAT(fault_of_text("P2 2"), HasSubstr("ends before the height"));
  EXPECT_THAT(fault_of_text("P2 # no end"), HasSubstr("ends before the width"));
  EXPECT_THAT(fault_of_text("P2 99999999999 2 255 1"), HasSubstr("the width is no number"));
  EXPECT_THAT(fault_of_text("P2 1000000 1000000 255 1"), HasSubstr("1e+08 are refused"));
  EXPECT_THAT(fault_of_text("P5 9000 9000 255 abc"), HasSubstr("it is truncated"));
  EXPECT_THAT(fault_of_text("P5 2 2 255 abcde"), HasSubstr("no single picture"));
  EXPECT_THAT(fault_of_text("P5 2 2 255"), HasSubstr("it is truncated"));
}

/// Cuts the file everywhere: no prefix of it is a picture.
void expect_no_prefix_is_read(const std::filesystem::path& path, const std::filesystem::path& cut) {
  const std::string whole = contents(path);
  for (std::size_t length = 1; length < whole.size(); length += 1 + length / 16) {
    write(cut, whole.substr(0, length));
    EXPECT_THAT(message_of([&] { read_picture(cut, Colours::kRefuse); }), HasSubstr(cut.string() + ": ")) << length;
  }
}

TEST_F(Pictures, truncated_png_and_tiff_are_refused) {
  const Picture picture = of_bits(16);
  for (const bool interlaced : {false, true}) {
    write_png(folder / "a.png", picture, {.bits = 16, .interlaced = interlaced});
    expect_no_prefix_is_read(folder / "a.png", folder / "cut.png");
    write(folder / "cut.png", contents(folder / "a.png").substr(0, contents(folder / "a.png").size() / 2));
    EXPECT_THAT(message_of([&] { read_picture(folder / "cut.png", Colours::kRefuse); }),
                HasSubstr("cut.png: is truncated: it ends within the picture; it must be a whole PNG"));
  }
  write_tiff(folder / "a.tif", picture, {});
  expect_no_prefix_is_read(folder / "a.tif", folder / "cut.tif");
}

TEST_F(Pictures, broken_bytes_give_a_message_or_a_picture_of_the_same_size_but_never_a_crash) {
  const Picture picture = of_bits(8, 20, 20);
  write_png(folder / "a.png", picture, {});
  write_tiff(folder / "a.tif", picture, {.bits = 8, .compression = COMPRESSION_LZW});
  write_tiff(folder / "b.tif", picture, {.bits = 8, .tile = 16});
  std::mt19937 random(3);
  for (const char* name : {"a.png", "a.tif", "b.tif"}) {
    const std::string whole = contents(folder / name);
    std::uniform_int_distribution<std::size_t> place(8, whole.size() - 1);
    for (int k = 0; k < 400; ++k) {
      std::string broken = whole;
      for (int n = 0; n <= k % 3; ++n) broken[place(random)] = static_cast<char>(random());
      write(folder / "broken", broken);
      try {
        const Picture read = read_picture(folder / "broken", Colours::kToGrey);
        EXPECT_EQ(read.value.size(), read.pixels());
      } catch (const DataError& error) {
        EXPECT_THAT(error.what(), HasSubstr("broken: "));
      }
    }
  }
}

TEST_F(Pictures, png_that_claims_to_be_huge_or_empty_is_refused_before_it_is_allocated) {
  write_png(folder / "a.png", of_bits(8), {});
  std::string png = contents(folder / "a.png");
  const auto with_size = [&](std::uint32_t width, std::uint32_t height) {
    for (int k = 0; k < 4; ++k) png[16 + k] = static_cast<char>(width >> (24 - 8 * k));
    for (int k = 0; k < 4; ++k) png[20 + k] = static_cast<char>(height >> (24 - 8 * k));
    // The header's checksum, of its type and data.
    std::uint32_t crc = 0xffffffffu;
    for (int k = 12; k < 29; ++k) {
      crc ^= static_cast<unsigned char>(png[k]);
      for (int b = 0; b < 8; ++b) crc = crc & 1 ? 0xedb88320u ^ crc >> 1 : crc >> 1;
    }
    crc ^= 0xffffffffu;
    for (int k = 0; k < 4; ++k) png[29 + k] = static_cast<char>(crc >> (24 - 8 * k));
    return png;
  };
  EXPECT_THAT(fault_of_text(with_size(100000, 100000)), HasSubstr("1e+08 are refused"));
  EXPECT_THAT(fault_of_text(with_size(0, 10)), HasSubstr("picture: "));
  EXPECT_THAT(fault_of_text(with_size(37, 24)), HasSubstr("picture: "));
}

TEST_F(Pictures, tiff_in_forms_that_are_not_read_is_refused) {
  const Picture picture = of_bits(8);
  write_tiff(folder / "pages.tif", picture, {.bits = 8, .pages = 2});
  EXPECT_THAT(fault_of("pages.tif"), HasSubstr("has several pages: save one of them"));
  write_tiff(folder / "float.tif", picture, {.bits = 32, .format = SAMPLEFORMAT_IEEEFP});
  EXPECT_THAT(fault_of("float.tif"), HasSubstr("save it as integers"));
  Picture huge = picture;
  huge.width = huge.height = 1;
  write_tiff(folder / "huge.tif", huge, {.bits = 8});
  std::string bytes = contents(folder / "huge.tif");
  // The tags of width and height: two bytes of tag, two of type, four of count, then the value.
  for (const char tag : {'\0', '\1'}) {
    const std::size_t at = bytes.find(std::string{tag, '\1'});
    for (const char* type : {"\3", "\4"})
      if (const std::size_t entry = bytes.find(std::string{tag, '\1'} + type); entry != std::string::npos) {
        bytes[entry + 8] = '\0';
        bytes[entry + 9] = '\x90';
      }
    ASSERT_NE(at, std::string::npos);
  }
  EXPECT_THAT(fault_of_text(bytes), HasSubstr("36864 x 36864 pixels; more than"));
}

}  // namespace
}  // namespace lamella
