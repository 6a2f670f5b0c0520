// TIFF by libtiff, in strips or tiles, with any compression that it knows.
#include <fmt/format.h>
#include <tiffio.h>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>

#include "generator/image/picture.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

struct Closer {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};

/// Keeps the first message of libtiff, which would print it.
int on_error(TIFF*, void* user, const char* module, const char* format, std::va_list arguments) {
  auto& fault = *static_cast<std::string*>(user);
  if (!fault.empty()) return 1;
  char text[200];
  std::vsnprintf(text, sizeof text, format, arguments);
  fault = fmt::format("{}: {}", module ? module : "libtiff", text);
  return 1;
}

int on_warning(TIFF*, void*, const char*, const char*, std::va_list) { return 1; }

class Tiff {
 public:
  Tiff(const std::filesystem::path& path, Colours colours) : path_(path.string()), colours_(colours) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, on_error, &message_);
    TIFFOpenOptionsSetWarningHandlerExtR(options, on_warning, nullptr);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(8 * kMostPixels));
    tiff_.reset(TIFFOpenExt(path.c_str(), "r", options));
    TIFFOpenOptionsFree(options);
    if (!tiff_) fail("is no TIFF that can be read");
  }

  Picture read() {
    read_head();
    if (TIFFIsTiled(tiff_.get()))
      read_tiles();
    else
      read_strips();
    if (!TIFFLastDirectory(tiff_.get())) fail("has several pages: save one of them");
    if (inverted_)
      for (auto& value : picture_.value) value = picture_.white - value;
    return std::move(picture_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw DataError(
        fmt::format("{}: {}{}", path_, what, message_.empty() ? "" : fmt::format(" (libtiff: {})", message_)));
  }

  template <typename T>
  T tag(ttag_t which, T otherwise) {
    T value{};
    return TIFFGetFieldDefaulted(tiff_.get(), which, &value) ? value : otherwise;
  }

  void read_head() {
    const auto width = tag<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
    const auto height = tag<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
    if (const std::string fault = fault_of_size(width, height); !fault.empty()) fail(fault);
    picture_.width = static_cast<int>(width);
    picture_.height = static_cast<int>(height);
    bits_ = tag<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
    channels_ = tag<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
    const auto format = tag<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
    const auto photometric = tag<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    const bool planar = tag<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) != PLANARCONFIG_CONTIG;
    if (format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_INT && format != SAMPLEFORMAT_VOID)
      fail("holds floating-point or complex numbers; save it as integers of 8, 16 or 32 bits");
    signed_ = format == SAMPLEFORMAT_INT;
    if (bits_ != 1 && bits_ != 8 && bits_ != 16 && bits_ != 32)
      fail(fmt::format("has {} bits per pixel; save it with 8, 16 or 32", bits_));
    picture_.white = 0xffffffffu >> (32 - bits_ + (signed_ ? 1 : 0));
    if (colours_ == Colours::kRefuse && (channels_ != 1 || photometric == PHOTOMETRIC_PALETTE))
      fail(fmt::format("has {}: {}", channels_ != 1 ? "several channels" : "a palette", kColoursAreNoNumbers));
    if (photometric == PHOTOMETRIC_PALETTE || (channels_ > 1 && bits_ == 1) || (planar && channels_ > 1) ||
        (channels_ >= 3 && photometric != PHOTOMETRIC_RGB) || channels_ < 1 || channels_ > 8)
      fail("has colours in a form that is not read; save it as grey, or as RGB with 8 or 16 bits");
    // White that is stored as 0 matters to a micrograph; the number of a cell is what is stored.
    inverted_ = photometric == PHOTOMETRIC_MINISWHITE && colours_ == Colours::kToGrey;
  }

  std::uint32_t sample(const unsigned char* row, std::size_t k) const {
    std::uint32_t value = 0;
    if (bits_ == 1) return row[k / 8] >> (7 - k % 8) & 1u;
    if (bits_ == 8) value = row[k];
    if (bits_ == 16) {
      std::uint16_t two;
      std::memcpy(&two, row + 2 * k, sizeof two);
      value = two;
    }
    if (bits_ == 32) std::memcpy(&value, row + 4 * k, sizeof value);
    if (value > picture_.white)
      fail(fmt::format("holds a negative number, {}; numbers of cells begin at 0",
                       static_cast<std::int64_t>(value) - (std::int64_t{1} << bits_)));
    return value;
  }

  std::uint32_t pixel(const unsigned char* row, int x) const {
    const std::size_t first = static_cast<std::size_t>(x) * channels_;
    return channels_ >= 3 ? brightness(sample(row, first), sample(row, first + 1), sample(row, first + 2))
                          : sample(row, first);
  }

  std::size_t row_bytes(int width) const { return (static_cast<std::size_t>(width) * channels_ * bits_ + 7) / 8; }

  void read_strips() {
    const auto size = static_cast<std::size_t>(TIFFScanlineSize64(tiff_.get()));
    if (size < row_bytes(picture_.width) || size > 64 * kMostPixels) fail("its rows are not as long as it says");
    std::vector<unsigned char> row(size);
    for (int y = 0; y < picture_.height; ++y) {
      if (TIFFReadScanline(tiff_.get(), row.data(), static_cast<std::uint32_t>(y)) != 1)
        fail(fmt::format("row {} cannot be read: it is truncated or broken", y));
      for (int x = 0; x < picture_.width; ++x) picture_.value.push_back(pixel(row.data(), x));
    }
  }

  void read_tiles() {
    const auto across = tag<std::uint32_t>(TIFFTAG_TILEWIDTH, 0);
    const auto down = tag<std::uint32_t>(TIFFTAG_TILELENGTH, 0);
    if (const std::string fault = fault_of_size(across, down); !fault.empty()) fail("its tiles: " + fault);
    const auto size = static_cast<std::size_t>(TIFFTileSize64(tiff_.get()));
    const std::size_t row_size = row_bytes(static_cast<int>(across));
    if (size < row_size * down || size > 64 * kMostPixels) fail("its tiles are not as large as it says");
    std::vector<unsigned char> tile(size);
    picture_.value.resize(picture_.pixels());
    for (std::uint32_t top = 0; top < static_cast<std::uint32_t>(picture_.height); top += down)
      for (std::uint32_t left = 0; left < static_cast<std::uint32_t>(picture_.width); left += across) {
        if (TIFFReadTile(tiff_.get(), tile.data(), left, top, 0, 0) < 0)
          fail(fmt::format("the tile at ({}, {}) cannot be read: it is truncated or broken", left, top));
        const auto rows = std::min<std::uint32_t>(down, picture_.height - top);
        const auto columns = static_cast<int>(std::min<std::uint32_t>(across, picture_.width - left));
        for (std::uint32_t y = 0; y < rows; ++y)
          for (int x = 0; x < columns; ++x)
            picture_.value[static_cast<std::size_t>(top + y) * picture_.width + left + x] =
                pixel(tile.data() + y * row_size, x);
      }
  }

  std::string path_, message_;
  Colours colours_;
  std::unique_ptr<TIFF, Closer> tiff_;
  Picture picture_;
  std::uint16_t bits_ = 1, channels_ = 1;
  bool signed_ = false, inverted_ = false;
};

}  // namespace

Picture read_tiff(const std::filesystem::path& path, Colours colours) { return Tiff(path, colours).read(); }

}  // namespace lamella
