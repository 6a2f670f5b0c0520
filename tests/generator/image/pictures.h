// Pictures that tests make: drawn cells, and files in every format.
#pragma once
#include <png.h>
#include <tiffio.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "generator/image/labels.h"
#include "generator/image/picture.h"
#include "generator/packing/packing.h"

namespace lamella {

inline Picture picture_of(int width, int height, const std::function<std::uint32_t(int x, int y)>& value,
                          std::uint32_t white = 255) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.white = white;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.value.push_back(value(x, y));
  return picture;
}

/// One character a pixel, rows from the top: `.` is background (0), digits and letters are the numbers 1 to 35.
inline Picture drawn(const std::vector<std::string>& rows) {
  return picture_of(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()),
                    [&](int x, int y) -> std::uint32_t {
                      const char c = rows[y][x];
                      return c == '.' ? 0 : c <= '9' ? c - '0' : c - 'a' + 10;
                    });
}

inline LabelImage labels_of(const Picture& picture) {
  bool pieces = false;
  return labels_of(picture, 0, pieces);
}

/// As drawn() reads it.
inline std::vector<std::string> drawing_of(const LabelImage& labels) {
  std::vector<std::string> rows;
  for (int y = 0; y < labels.height; ++y) {
    rows.emplace_back();
    for (int x = 0; x < labels.width; ++x) {
      const Index cell = labels.cell[labels.at(x, y)];
      const std::uint32_t number = cell < 0 ? 0 : labels.number[cell];
      rows.back() += number == 0 ? '.' : static_cast<char>(number < 10 ? '0' + number : 'a' + number - 10);
    }
  }
  return rows;
}

/// Which of the disks has the least power at a point.
inline std::size_t nearest(const std::vector<Disk>& disks, const Vec2& p) {
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const double power = (p - disks[i].centre).squaredNorm() - disks[i].radius * disks[i].radius;
    if (power < least) {
      least = power;
      best = i;
    }
  }
  return best;
}

inline std::vector<Disk> random_disks(int count, double width, double height, double radius, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Disk> disks;
  for (int i = 0; i < count; ++i)
    disks.push_back({Vec2(width * unit(random), height * unit(random)), radius * unit(random)});
  return disks;
}

/// The Laguerre tessellation of disks (pixels, y upwards), numbered from 1; pixels by their centres.
inline Picture tessellated(int width, int height, const std::vector<Disk>& disks) {
  return picture_of(width, height, [&](int x, int y) {
    return static_cast<std::uint32_t>(nearest(disks, {x + 0.5, height - y - 0.5})) + 1;
  });
}

/// The same with boundaries that wander by a few pixels, so that cells are concave.
inline Picture wavy(int width, int height, const std::vector<Disk>& disks, double amplitude) {
  return picture_of(width, height, [&](int x, int y) {
    const Vec2 p(x + 0.5 + amplitude * std::sin(0.31 * y) + amplitude * std::sin(0.83 * y + 1),
                 height - y - 0.5 + amplitude * std::cos(0.37 * x) + amplitude * std::sin(0.71 * x));
    return static_cast<std::uint32_t>(nearest(disks, p)) + 1;
  });
}

inline std::string pgm(const Picture& picture, bool digits) {
  std::string text = std::string(digits ? "P2" : "P5") + "\n# a comment\n" + std::to_string(picture.width) + " " +
                     std::to_string(picture.height) + "\n" + std::to_string(picture.white) + "\n";
  for (const std::uint32_t value : picture.value) {
    if (digits) {
      text += std::to_string(value) + "\n";
    } else {
      if (picture.white > 255) text += static_cast<char>(value >> 8);
      text += static_cast<char>(value & 255);
    }
  }
  return text;
}

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct PngForm {
  int bits = 8;
  int type = PNG_COLOR_TYPE_GRAY;  // RGB: three equal channels
  bool interlaced = false;
};

inline void write_png(const std::filesystem::path& path, const Picture& picture, const PngForm& form) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), form.bits,
               form.type, form.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::vector<png_color> palette(256);
  for (int k = 0; k < 256; ++k)
    palette[k] = {static_cast<png_byte>(k), static_cast<png_byte>(k), static_cast<png_byte>(k)};
  if (form.type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 256);
  png_write_info(png, info);
  if (form.bits < 8) png_set_packing(png);
  const int channels = form.type == PNG_COLOR_TYPE_RGB ? 3 : form.type == PNG_COLOR_TYPE_RGB_ALPHA ? 4 : 1;
  std::vector<std::vector<png_byte>> rows(picture.height);
  std::vector<png_bytep> pointers;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < channels; ++c) {
        const std::uint32_t value = picture.value[static_cast<std::size_t>(y) * picture.width + x];
        if (form.bits == 16) rows[y].push_back(static_cast<png_byte>(value >> 8));
        rows[y].push_back(static_cast<png_byte>(value));
      }
    pointers.push_back(rows[y].data());
  }
  png_write_image(png, pointers.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

struct TiffForm {
  int bits = 16;
  int format = SAMPLEFORMAT_UINT;
  int compression = COMPRESSION_NONE;
  bool big_endian = false;
  int tile = 0;  // side of tiles; 0: strips
  int channels = 1;
  int pages = 1;
  int photometric = PHOTOMETRIC_MINISBLACK;
};

inline void write_tiff(const std::filesystem::path& path, const Picture& picture, const TiffForm& form) {
  TIFF* tiff = TIFFOpen(path.c_str(), form.big_endian ? "wb" : "wl");
  const auto append = [&](std::vector<std::uint8_t>& bytes, std::uint32_t value) {  // libtiff swaps
    const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), raw, raw + form.bits / 8);
  };
  for (int page = 0; page < form.pages; ++page) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, picture.width);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, picture.height);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, form.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, form.channels);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, form.format);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, form.compression);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, form.channels >= 3 ? PHOTOMETRIC_RGB : form.photometric);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    if (form.tile > 0) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, form.tile);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, form.tile);
      for (int top = 0; top < picture.height; top += form.tile)
        for (int left = 0; left < picture.width; left += form.tile) {
          std::vector<std::uint8_t> bytes;
          for (int y = top; y < top + form.tile; ++y)
            for (int x = left; x < left + form.tile; ++x)
              append(bytes, x < picture.width && y < picture.height
                                ? picture.value[static_cast<std::size_t>(y) * picture.width + x]
                                : 0);
          TIFFWriteTile(tiff, bytes.data(), left, top, 0, 0);
        }
    } else {
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
      for (int y = 0; y < picture.height; ++y) {
        std::vector<std::uint8_t> bytes;
        for (int x = 0; x < picture.width; ++x)
          for (int c = 0; c < form.channels; ++c)
            append(bytes, picture.value[static_cast<std::size_t>(y) * picture.width + x]);
        TIFFWriteScanline(tiff, bytes.data(), y, 0);
      }
    }
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
}

}  // namespace lamella
