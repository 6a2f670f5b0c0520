#include "pipelines/studies/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lamella {
namespace {

std::string joined(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const auto& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

std::string rule(std::size_t columns) {
  std::string line = "|";
  for (std::size_t k = 0; k < columns; ++k) line += "---|";
  return line + "\n";
}

/// A bar in a cell would end it.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

/// Two-sided 95 % quantile of Student's t.
double student(int freedom) {
  static constexpr double kTable[] = {12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228};
  return freedom <= 10 ? kTable[std::max(1, freedom) - 1] : 2.0;
}

}  // namespace

void StudyReport::add(Finding finding) {
  blocks_.push_back({Kind::kFinding, "", "", findings_.size()});
  findings_.push_back(std::move(finding));
}

void StudyReport::section(const std::string& title) { blocks_.push_back({Kind::kSection, title, "", 0}); }
void StudyReport::text(const std::string& paragraph) { blocks_.push_back({Kind::kText, paragraph, "", 0}); }

void StudyReport::compare(const std::string& what, double found, double exact, double allowed) {
  const double error = std::abs(found - exact) / std::abs(exact);
  add({what, found, fmt::format("{:.7g}", exact), error, fmt::format("{:.3g}", allowed), error <= allowed});
}

void StudyReport::compare_absolute(const std::string& what, double found, double exact, double allowed) {
  const double error = std::abs(found - exact);
  add({what, found, fmt::format("{:.7g}", exact), error, fmt::format("{:.3g} absolute", allowed), error <= allowed});
}

void StudyReport::at_most(const std::string& what, double found, double bound) {
  add({what, found, fmt::format("at most {:.4g}", bound), 0, "", found <= bound});
}

void StudyReport::at_least(const std::string& what, double found, double bound) {
  add({what, found, fmt::format("at least {:.4g}", bound), 0, "", found >= bound});
}

void StudyReport::between(const std::string& what, double found, double low, double high) {
  add({what, found, fmt::format("{:.4g} to {:.4g}", low, high), 0, "", found >= low && found <= high});
}

void StudyReport::holds(const std::string& what, bool met, const std::string& said) {
  add({what, 0, said, std::nan(""), "", met});
}

void StudyReport::table(ReportTable table) {
  blocks_.push_back({Kind::kTable, "", "", tables_.size()});
  tables_.push_back(std::move(table));
}

void StudyReport::chart(const std::string& name, const std::string& caption, const Chart& chart) {
  picture(name, caption, {560, 340}, [&](Canvas& canvas) { draw_chart(canvas, {Vec2(0, 0), Vec2(560, 340)}, chart); });
}

void StudyReport::picture(const std::string& name, const std::string& caption, const Vec2& size,
                          const std::function<void(Canvas&)>& draw) {
  draw_page(folder_ / name, size, draw);
  blocks_.push_back({Kind::kPicture, caption, name, 0});
}

int StudyReport::missed() const {
  return static_cast<int>(std::count_if(findings_.begin(), findings_.end(), [](const Finding& f) { return !f.met; }));
}

std::string StudyReport::markdown(const std::string& pictures, int level) const {
  std::string page;
  Kind before = Kind::kSection;
  for (const Block& block : blocks_) {
    const bool in_table = block.kind == Kind::kFinding && before == Kind::kFinding;
    if (!in_table && !page.empty()) page += "\n";
    if (block.kind == Kind::kSection) {
      page += std::string(static_cast<std::size_t>(level), '#') + " " + block.text + "\n";
    } else if (block.kind == Kind::kText) {
      page += block.text + "\n";
    } else if (block.kind == Kind::kFinding) {
      const Finding& f = findings_[block.index];
      if (!in_table) page += joined({"what", "found", "expected", "error", "allowed", ""}) + rule(6);
      page += joined({cell(f.what), std::isnan(f.error) && f.allowed.empty() ? "" : fmt::format("{:.7g}", f.found),
                      cell(f.expected), f.allowed.empty() ? "" : fmt::format("{:.2g}", f.error), f.allowed,
                      f.met ? "met" : "MISSED"});
    } else if (block.kind == Kind::kTable) {
      const ReportTable& t = tables_[block.index];
      page += joined(t.head) + rule(t.head.size());
      for (const auto& row : t.rows) page += joined(row);
    } else {
      page += fmt::format("![{}]({}{}.png)\n\n*{}*\n", block.name, pictures, block.name, block.text);
    }
    before = block.kind;
  }
  return page;
}

std::string StudyReport::csv() const {
  const auto quoted = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, "\"");
    return "\"" + text + "\"";
  };
  std::string out = "what,found,expected,error,allowed,met\n";
  for (const Finding& f : findings_)
    out += fmt::format("{},{:.10g},{},{:.4g},{},{}\n", quoted(f.what), f.found, quoted(f.expected), f.error,
                       quoted(f.allowed), f.met ? "met" : "missed");
  return out;
}

Colour curve_colour(int k) {
  static const Colour kColours[] = {{0.12, 0.35, 0.65}, {0.85, 0.37, 0.01}, {0.11, 0.55, 0.35}, {0.70, 0.20, 0.45},
                                    {0.45, 0.45, 0.48}, {0.60, 0.48, 0.05}, {0.30, 0.65, 0.80}, {0.35, 0.20, 0.55},
                                    {0.78, 0.07, 0.10}, {0.60, 0.75, 0.20}, {0.42, 0.24, 0.10}, {0.93, 0.58, 0.70}};
  return kColours[static_cast<std::size_t>(k) % std::size(kColours)];
}

Curve line_curve(int k, const std::string& label, std::vector<double> x, std::vector<double> y) {
  return {std::move(x), std::move(y), {curve_colour(k), 1.6, {}}, label};
}

Curve dotted_curve(int k, const std::string& label, std::vector<double> x, std::vector<double> y) {
  Curve curve = line_curve(k, label, std::move(x), std::move(y));
  curve.drawn = CurveKind::kDots;
  return curve;
}

FittedLine fitted_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  FittedLine line{.points = static_cast<int>(x.size())};
  if (x.size() < 2) return line;
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) mean_x += x[k] / count, mean_y += y[k] / count;
  for (std::size_t k = 0; k < x.size(); ++k)
    xx += (x[k] - mean_x) * (x[k] - mean_x), xy += (x[k] - mean_x) * (y[k] - mean_y);
  line.slope = xy / xx, line.at_zero = mean_y - line.slope * mean_x;
  double square = 0;
  for (std::size_t k = 0; k < x.size(); ++k) square += std::pow(y[k] - line.at_zero - line.slope * x[k], 2);
  if (x.size() > 2) line.half_width = student(static_cast<int>(x.size()) - 2) * std::sqrt(square / (count - 2) / xx);
  return line;
}

Order observed_order(const std::vector<double>& n, const std::vector<double>& error) {
  std::vector<double> x, y;
  for (std::size_t k = 0; k < n.size(); ++k)
    if (error[k] != 0) x.push_back(-std::log(n[k])), y.push_back(std::log(std::abs(error[k])));
  const FittedLine line = fitted_line(x, y);
  return {line.slope, line.half_width};
}

}  // namespace lamella
