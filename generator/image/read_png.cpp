// PNG by libpng, which reports errors by longjmp: nothing between setjmp and there may own memory, so all that does
// lives in the caller.
#include <fmt/format.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <memory>

#include "generator/image/picture.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

/// What the decoder fills, and what it works with.
struct Decoding {
  Picture picture;
  std::vector<png_byte> raw;      // a row, or the whole of an interlaced picture
  std::vector<png_bytep> rows;    // into raw
  std::array<char, 200> fault{};  // of libpng, or our own
  Colours colours = Colours::kRefuse;
  bool broken = false;  // the fault is libpng's
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* decoding = static_cast<Decoding*>(png_get_error_ptr(png));
  std::snprintf(decoding->fault.data(), decoding->fault.size(), "%s", message);
  decoding->broken = true;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void append_row(const png_byte* row, int channels, int bits, Picture& picture) {
  const auto sample = [&](int k) -> std::uint32_t { return bits == 16 ? 256u * row[2 * k] + row[2 * k + 1] : row[k]; };
  for (int x = 0; x < picture.width; ++x) {
    const int first = x * channels;
    picture.value.push_back(channels >= 3 ? brightness(sample(first), sample(first + 1), sample(first + 2))
                                          : sample(first));
  }
}

/// Whether the colours are those asked for; else says why not.
bool accept_colours(int type, Decoding& decoding) {
  if (type == PNG_COLOR_TYPE_GRAY || decoding.colours == Colours::kToGrey) return true;
  const char* what = type == PNG_COLOR_TYPE_PALETTE ? "has a palette" : "has several channels";
  std::snprintf(decoding.fault.data(), decoding.fault.size(), "%s: %s", what, kColoursAreNoNumbers);
  return false;
}

bool accept_size(double width, double height, Decoding& decoding) {
  const std::string fault = fault_of_size(width, height);
  std::snprintf(decoding.fault.data(), decoding.fault.size(), "%s", fault.c_str());
  return fault.empty();
}

/// False with decoding.fault set. Objects with destructors must not live in this function.
bool decode(png_structp png, png_infop info, Decoding& decoding) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_user_limits(png, 0x7fffffff, 0x7fffffff);  // sizes are ours to judge
  png_read_info(png, info);
  Picture& picture = decoding.picture;
  if (!accept_size(png_get_image_width(png, info), png_get_image_height(png, info), decoding)) return false;
  const int type = png_get_color_type(png, info);
  if (!accept_colours(type, decoding)) return false;
  picture.width = static_cast<int>(png_get_image_width(png, info));
  picture.height = static_cast<int>(png_get_image_height(png, info));
  int bits = png_get_bit_depth(png, info);
  png_set_packing(png);
  if (type == PNG_COLOR_TYPE_PALETTE) {
    png_set_palette_to_rgb(png);
    bits = 8;
  }
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const int channels = png_get_channels(png, info);
  const std::size_t row_size = png_get_rowbytes(png, info);
  picture.white = (1u << bits) - 1;
  if (passes == 1) {  // row by row: a small file that promises much is found out before much is allocated
    decoding.raw.resize(row_size);
    for (int y = 0; y < picture.height; ++y) {
      png_read_row(png, decoding.raw.data(), nullptr);
      append_row(decoding.raw.data(), channels, bits, picture);
    }
  } else {
    decoding.raw.resize(row_size * picture.height);
    for (int y = 0; y < picture.height; ++y) decoding.rows.push_back(decoding.raw.data() + y * row_size);
    png_read_image(png, decoding.rows.data());
    for (int y = 0; y < picture.height; ++y) append_row(decoding.rows[y], channels, bits, picture);
  }
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

Picture read_png(const std::filesystem::path& path, Colours colours) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw DataError(fmt::format("{}: cannot be read", path.string()));
  Decoding decoding;
  decoding.colours = colours;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoding, on_error, on_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool done = false;
  if (info) {
    png_init_io(png, file.get());
    done = decode(png, info, decoding);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (done) return std::move(decoding.picture);
  if (decoding.broken && std::feof(file.get()))
    throw DataError(fmt::format("{}: is truncated: it ends within the picture; it must be a whole PNG", path.string()));
  if (decoding.broken)
    throw DataError(fmt::format("{}: is broken ({}); it must be a whole PNG", path.string(), decoding.fault.data()));
  throw DataError(
      fmt::format("{}: {}", path.string(), decoding.fault[0] ? decoding.fault.data() : "is no PNG that can be read"));
}

}  // namespace lamella
