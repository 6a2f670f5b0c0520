// What a study finds: numbers beside what they should be, tables, charts, sentences, in the order in which a reader meets them. Every
// checked number says what was found, what is exact and what was allowed; a number that misses is never hidden.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "postproc/drawing/canvas.h"
#include "postproc/drawing/chart.h"

namespace lamella {

/// One number beside what it should be.
struct Finding {
  std::string what;
  double found = 0;
  std::string expected;  // "1.0078", "at most 0.01", "2.95 to 3.05"
  double error = 0;      // relative or absolute, as `allowed` is; 0 for a bound, NaN where nothing is counted
  std::string allowed;   // "1e-06", "0.01 absolute"; empty for a bound
  bool met = false;
};

struct ReportTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

class StudyReport {
 public:
  /// Pictures go to `folder`, which is there.
  explicit StudyReport(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void section(const std::string& title);
  void text(const std::string& paragraph);

  /// |found - exact| <= allowed |exact|.
  void compare(const std::string& what, double found, double exact, double allowed);
  /// |found - exact| <= allowed, in the unit of the numbers.
  void compare_absolute(const std::string& what, double found, double exact, double allowed);
  void at_most(const std::string& what, double found, double bound);
  void at_least(const std::string& what, double found, double bound);
  void between(const std::string& what, double found, double low, double high);
  /// Something that holds or does not; `said` tells what was seen.
  void holds(const std::string& what, bool met, const std::string& said);

  /// Numbers that are shown and not judged.
  void table(ReportTable table);
  /// Draws NAME.png and NAME.pdf.
  void chart(const std::string& name, const std::string& caption, const Chart& chart);
  void picture(const std::string& name, const std::string& caption, const Vec2& size,
               const std::function<void(Canvas&)>& draw);

  int checked() const { return static_cast<int>(findings_.size()); }
  int missed() const;
  const std::vector<Finding>& findings() const { return findings_; }
  /// The report as Markdown. `pictures`: what stands before a picture's name in its link; `level`: of the sections' heads.
  std::string markdown(const std::string& pictures, int level) const;
  /// `what,found,expected,error,allowed,met`, one finding a line.
  std::string csv() const;

 private:
  enum class Kind { kSection, kText, kFinding, kTable, kPicture };
  struct Block {
    Kind kind;
    std::string text;  // of a picture: its caption
    std::string name;  // of a picture
    std::size_t index = 0;
  };
  void add(Finding finding);

  std::filesystem::path folder_;
  std::vector<Block> blocks_;
  std::vector<Finding> findings_;
  std::vector<ReportTable> tables_;
};

/// Colour of the k-th curve of a chart, told apart by people who do not see all colours; the twelfth is followed by the first again.
Colour curve_colour(int k);
/// Of what curves are compared with: no curve has it.
inline constexpr Colour kReferenceColour{0, 0, 0};
/// A curve in that colour.
Curve line_curve(int k, const std::string& label, std::vector<double> x, std::vector<double> y);
/// Dots in that colour: what was computed, beside lines that are exact.
Curve dotted_curve(int k, const std::string& label, std::vector<double> x, std::vector<double> y);

/// Straight line through points by least squares.
struct FittedLine {
  double slope = 0, at_zero = 0;
  double half_width = 0;  // of the slope's 95 % interval, as if the points were independent; 0 with fewer than three
  int points = 0;
};
FittedLine fitted_line(const std::vector<double>& x, const std::vector<double>& y);

/// Slope of log(error) over log(1 / n) by least squares, and its 95 % interval's half width: the observed order of convergence.
struct Order {
  double order = 0, half_width = 0;
};
Order observed_order(const std::vector<double>& n, const std::vector<double>& error);

}  // namespace lamella
