// Drawing on pages without a display: PNG, PDF and SVG by cairo, which stays behind this header. Lengths are points
// (1/72 inch), y down, as on a page.
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "generator/sample/vec.h"

namespace lamella {

struct Colour {
  double red = 0, green = 0, blue = 0, alpha = 1;
};

Colour mix(const Colour& a, const Colour& b, double share_of_b);
/// Perceptually uniform, from dark violet (0) over green to yellow (1); values beyond are clamped.
Colour viridis(double value);
/// From pale yellow (0) to dark red (1): stands out on grey.
Colour embers(double value);

struct Style {
  Colour colour;
  double width = 1;            // [pt]
  std::vector<double> dashes;  // on, off, ... [pt]; empty: solid
};

enum class Anchor { kLeft, kCentre, kRight };
enum class Weight { kNormal, kBold };

struct TextStyle {
  double size = 10;  // [pt]
  Anchor anchor = Anchor::kLeft;
  Colour colour{0.13, 0.14, 0.17};
  Weight weight = Weight::kNormal;
  double angle = 0;  // clockwise [rad]
};

class Canvas {
 public:
  explicit Canvas(void* cairo) : cairo_(cairo) {}
  void polygon(const std::vector<Vec2>& points, const Colour& fill);
  void outline(const std::vector<Vec2>& points, const Style& style);  // closed
  void line(const std::vector<Vec2>& points, const Style& style);     // open, round ends
  void rectangle(const Box& box, const Colour& fill);
  void dot(const Vec2& centre, double radius, const Colour& fill);
  void arrow(const Vec2& from, const Vec2& to, const Style& style);
  /// `at` is the baseline's left end, middle or right end.
  void text(const Vec2& at, const std::string& words, const TextStyle& style = {});
  double text_width(const std::string& words, const TextStyle& style);
  /// What `draw` draws is cut off outside the box.
  void clipped(const Box& box, const std::function<void()>& draw);

 private:
  void* cairo_;
};

/// Draws a page to one file, in the format that its ending says: .png (two pixels a point, on white), .pdf or .svg. Throws
/// DataError for other endings, and where the file cannot be written.
void draw_file(const std::filesystem::path& path, const Vec2& size, const std::function<void(Canvas&)>& draw);

/// Draws the same page as STEM.png (two pixels a point, on white) and STEM.pdf, and returns both paths.
std::vector<std::filesystem::path> draw_page(const std::filesystem::path& stem, const Vec2& size,
                                             const std::function<void(Canvas&)>& draw);

}  // namespace lamella
