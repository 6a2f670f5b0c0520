// Pictures from files: one number per pixel, whatever the format.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lamella {

/// Rows from the top, pixels from the left.
struct Picture {
  int width = 0, height = 0;
  std::uint32_t white = 255;         // largest value that a pixel may have; what stands for 1
  std::vector<std::uint32_t> value;  // height x width

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
};

/// Larger pictures are refused before anything is allocated.
inline constexpr double kMostPixels = 1e8;

/// What to do with colours: as numbers of cells they mean nothing, in a micrograph their brightness does.
enum class Colours { kRefuse, kToGrey };

/// Reads PGM (P2, P5), PNG or TIFF, told apart by their first bytes: unsigned integers of up to 16 bits (TIFF: 32), one
/// channel, one page. Brightness of colours is 0.299 red + 0.587 green + 0.114 blue; transparency is ignored.
/// Throws DataError `file: what, and what would be right`: missing, not a picture, truncated, broken, empty, too large,
/// with colours where they are refused.
Picture read_picture(const std::filesystem::path& path, Colours colours);

// ---- for the readers of the formats -------------------------------------------------------------------------------

Picture read_pgm(const std::filesystem::path& path);
Picture read_png(const std::filesystem::path& path, Colours colours);
Picture read_tiff(const std::filesystem::path& path, Colours colours);

/// Why such a picture cannot be read, or "".
std::string fault_of_size(double width, double height);

/// What to do with a picture of colours where numbers of cells are wanted.
inline constexpr const char* kColoursAreNoNumbers =
    "save the numbers of the cells as one channel of 8, 16 or 32 bits, or read a micrograph with kind = \"grey\"";

inline std::uint32_t brightness(std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
  return static_cast<std::uint32_t>(0.299 * red + 0.587 * green + 0.114 * blue + 0.5);
}

}  // namespace lamella
