#include "generator/image/picture.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "generator/sample/errors.h"

namespace lamella {

std::string fault_of_size(double width, double height) {
  if (!(width >= 1) || !(height >= 1))
    return fmt::format("the picture is {} x {} pixels; it needs at least one", width, height);
  if (width * height > kMostPixels)
    return fmt::format("the picture says that it has {} x {} pixels; more than {:.0g} are refused: cut or scale it",
                       width, height, kMostPixels);
  return "";
}

Picture read_picture(const std::filesystem::path& path, Colours colours) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw DataError(
        fmt::format("{}: no such file; sample.image.file must name a PGM, PNG or TIFF picture", path.string()));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw DataError(fmt::format("{}: cannot be read", path.string()));
  std::array<char, 8> first{};
  in.read(first.data(), first.size());
  const std::string_view magic(first.data(), static_cast<std::size_t>(in.gcount()));
  in.close();
  if (magic.size() >= 2 && magic[0] == 'P' && magic[1] >= '1' && magic[1] <= '7') return read_pgm(path);
  if (magic == std::string_view("\x89PNG\r\n\x1a\n", 8)) return read_png(path, colours);
  for (const std::string_view tiff : {"II*\0", "MM\0*", "II+\0", "MM\0+"})
    if (magic.substr(0, 4) == std::string_view(tiff.data(), 4)) return read_tiff(path, colours);
  throw DataError(fmt::format("{}: {}; convert the picture to PGM, PNG or TIFF", path.string(),
                              magic.empty() ? "is empty" : "is neither PGM nor PNG nor TIFF"));
}

}  // namespace lamella
