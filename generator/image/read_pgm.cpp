// Portable graymaps: `P2` in decimal digits, `P5` in bytes, one or (from a maximum of 256 on) two a pixel, the higher
// first. Comments run from # to the end of the line.
#include <fmt/format.h>

#include <charconv>
#include <fstream>

#include "generator/image/picture.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

class Graymap {
 public:
  explicit Graymap(const std::filesystem::path& path) : path_(path.string()) {
    // A pixel in digits takes at most 12 characters of a sensible file.
    const auto size = std::filesystem::file_size(path);
    if (static_cast<double>(size) > 12 * kMostPixels) fail("is larger than any picture that is accepted");
    text_.resize(size);
    std::ifstream in(path, std::ios::binary);
    if (!in.read(text_.data(), static_cast<std::streamsize>(size))) fail("reading failed");
  }

  Picture read() {
    const char kind = text_.size() > 1 ? text_[1] : '?';
    if (kind != '2' && kind != '5')
      fail(fmt::format("is a P{} picture; convert it to a graymap (PGM, P2 or P5)", kind));
    at_ = 2;
    Picture picture;
    const std::uint32_t width = number("the width");
    const std::uint32_t height = number("the height");
    if (const std::string fault = fault_of_size(width, height); !fault.empty()) fail(fault);
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    picture.white = number("the maximum");
    if (picture.white < 1 || picture.white > 65535)
      fail(fmt::format("says that its maximum is {}; it must be 1 to 65535", picture.white));
    if (kind == '2')
      read_digits(picture);
    else
      read_bytes(picture);
    return picture;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw DataError(path_ + ": " + what); }

  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#')
        while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
      else
        ++at_;
    }
  }

  std::uint32_t number(const std::string& what) {
    skip();
    std::uint32_t value = 0;
    const char* begin = text_.data() + at_;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (begin == end) fail(fmt::format("ends before {}: it is truncated", what));
    if (error != std::errc() || (stop != end && !is_blank(*stop) && *stop != '#'))
      fail(fmt::format("{} is no number at byte {}", what, at_));
    at_ += static_cast<std::size_t>(stop - begin);
    return value;
  }

  void check(std::uint32_t value, std::size_t pixel, const Picture& picture) const {
    if (value > picture.white)
      fail(fmt::format("pixel {} of row {} is {}, more than the maximum of {} that the file states",
                       pixel % picture.width, pixel / picture.width, value, picture.white));
  }

  void read_digits(Picture& picture) {
    if (text_.size() - at_ < picture.pixels())  // before allocating
      fail(fmt::format("is truncated: {} x {} pixels need more than {} bytes", picture.width, picture.height,
                       text_.size()));
    picture.value.resize(picture.pixels());
    for (std::size_t k = 0; k < picture.value.size(); ++k) {
      picture.value[k] = number(k % 1000 == 0 || at_ == text_.size() ? fmt::format("pixel {}", k) : "a pixel");
      check(picture.value[k], k, picture);
    }
    skip();
    if (at_ < text_.size())
      fail(fmt::format("goes on after {} x {} pixels: the size is wrong, or it is no single picture", picture.width,
                       picture.height));
  }

  void read_bytes(Picture& picture) {
    if (at_ < text_.size()) ++at_;  // a single blank ends the header
    const std::size_t each = picture.white > 255 ? 2 : 1;
    const std::size_t wanted = each * picture.pixels();
    if (text_.size() - at_ != wanted)
      fail(fmt::format("has {} bytes of pixels where {} x {} pixels need {}: it is {}", text_.size() - at_,
                       picture.width, picture.height, wanted,
                       text_.size() - at_ < wanted ? "truncated" : "no single picture, or its size is wrong"));
    picture.value.resize(picture.pixels());
    const auto byte = [&](std::size_t k) -> std::uint32_t { return static_cast<unsigned char>(text_[at_ + k]); };
    for (std::size_t k = 0; k < picture.value.size(); ++k) {
      picture.value[k] = each == 1 ? byte(k) : 256 * byte(2 * k) + byte(2 * k + 1);
      check(picture.value[k], k, picture);
    }
  }

  std::string path_, text_;
  std::size_t at_ = 0;
};

}  // namespace

Picture read_pgm(const std::filesystem::path& path) { return Graymap(path).read(); }

}  // namespace lamella
