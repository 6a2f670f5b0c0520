#include "generator/tissue/polygon_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>

#include "generator/packing/word_reader.h"
#include "generator/sample/errors.h"
#include "generator/sample/polygon.h"
#include "generator/sample/sample.h"
#include "generator/tissue/crossings.h"

namespace lamella {
namespace {

constexpr std::size_t kMostFaults = 50;

/// Faults of one file, in the order of its lines.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}
  void add(int line, const std::string& what) { list_.emplace_back(line, fmt::format("{}:{}: {}", file_, line, what)); }
  bool any() const { return !list_.empty(); }
  [[noreturn]] void raise() {
    std::stable_sort(list_.begin(), list_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < std::min(kMostFaults, list_.size()); ++k) lines.push_back(list_[k].second);
    if (list_.size() > kMostFaults)
      lines.push_back(fmt::format("{}: and {} more faults", file_, list_.size() - kMostFaults));
    throw SceneError(lines);
  }

 private:
  std::string file_;
  std::vector<std::pair<int, std::string>> list_;
};

std::vector<std::string_view> words_of(std::string_view line) {
  if (const auto comment = line.find('#'); comment != std::string_view::npos) line = line.substr(0, comment);
  std::vector<std::string_view> words;
  constexpr std::string_view separators = " \t\r,;";
  while (true) {
    const auto begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const auto end = std::min(line.find_first_of(separators), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

bool read_coordinate(std::string_view word, const char* name, int line, double& value, Faults& faults) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    faults.add(line, fmt::format("{} is \"{}\", not a number; a line is `x y cell`", name, shown(word)));
    return false;
  }
  if (!std::isfinite(value) || std::abs(value) > 1e100) {
    faults.add(line, fmt::format("{} is {}; coordinates must be finite", name, shown(word)));
    return false;
  }
  return true;
}

std::vector<ImportedCell> read_lines(std::istream& in, double scale, Faults& faults) {
  std::vector<ImportedCell> cells;
  std::map<std::string, int, std::less<>> first_line;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const auto words = words_of(text);
    if (words.empty()) continue;
    if (words.size() != 3) {
      faults.add(line, fmt::format("{} columns; a line is `x y cell`, three columns", words.size()));
      continue;
    }
    if (cells.empty() && words[0] == "x" && words[1] == "y") continue;  // names of the columns
    Vec2 point = Vec2::Zero();
    const bool x = read_coordinate(words[0], "x", line, point.x(), faults);
    const bool y = read_coordinate(words[1], "y", line, point.y(), faults);
    const std::string label(words[2]);
    if (cells.empty() || cells.back().label != label) {
      const auto [known, fresh] = first_line.try_emplace(label, line);
      if (!fresh)
        faults.add(line, fmt::format(
                             "cell {} began at line {} and ended before this; the points of a cell must be consecutive",
                             shown(label), known->second));
      cells.push_back({label, {}, {}, {}});
    }
    if (!x || !y) continue;
    cells.back().points.push_back(scale * point);
    cells.back().lines.push_back(line);
  }
  return cells;
}

void check_points(ImportedCell& cell, int& closing, Faults& faults) {
  auto& points = cell.points;
  auto& lines = cell.lines;
  if (points.empty()) return;  // its faults are known
  if (points.size() > 3 && points.front() == points.back()) {
    points.pop_back();
    lines.pop_back();
    if (!cell.vertex.empty()) cell.vertex.pop_back();
    ++closing;
  }
  const std::string name = shown(cell.label);
  if (points.size() < 3) {
    faults.add(lines.front(), fmt::format("cell {} has {} points; it needs at least 3", name, points.size()));
    return;
  }
  std::map<std::pair<double, double>, int> seen;
  bool repeated = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [known, fresh] = seen.try_emplace({points[k].x(), points[k].y()}, lines[k]);
    if (fresh) continue;
    faults.add(lines[k], fmt::format("cell {} has the point of line {} again; every point must be there once", name,
                                     known->second));
    repeated = true;
  }
  if (repeated) return;
  const double area = polygon_area(points);
  double perimeter = 0;
  for (std::size_t k = 0; k < points.size(); ++k) perimeter += (points[(k + 1) % points.size()] - points[k]).norm();
  if (!(std::abs(area) > 1e-12 * perimeter * perimeter)) {
    faults.add(lines.front(), fmt::format("cell {} encloses no area", name));
    return;
  }
  if (area < 0) {
    std::reverse(points.begin(), points.end());
    std::reverse(lines.begin(), lines.end());
    std::reverse(cell.vertex.begin(), cell.vertex.end());
  }
}

void check_self_crossing(const std::vector<ImportedCell>& cells, Faults& faults) {
  for (const ImportedCell& cell : cells) {
    const auto count = static_cast<int>(cell.points.size());
    if (count < 4) continue;
    std::vector<OwnedSegment> segments;
    for (int k = 0; k < count; ++k)
      segments.push_back({cell.points[k], cell.points[(k + 1) % count], 0, (k + count - 1) % count, (k + 1) % count});
    for (const Crossing& crossing : find_crossings(segments, 1))
      faults.add(cell.lines[crossing.second],
                 fmt::format("cell {} crosses itself: the side from here crosses the one from line {}",
                             shown(cell.label), cell.lines[crossing.first]));
  }
}

}  // namespace

std::vector<ImportedCell> read_polygons(const std::filesystem::path& path, double scale, Notes& notes) {
  if (!std::filesystem::is_regular_file(path))
    throw DataError(
        fmt::format("{}: no such file; sample.file must name a text file of lines `x y cell`", path.string()));
  Faults faults(path.string());
  std::vector<ImportedCell> cells;
  if (path.extension() == ".tess" || path.extension() == ".off") {
    cells = read_numbered_polygons(path, scale, notes);
  } else {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw DataError(fmt::format("{}: cannot be read", path.string()));
    cells = read_lines(in, scale, faults);
    if (in.bad()) throw DataError(fmt::format("{}: reading failed", path.string()));
  }
  int closing = 0;
  for (ImportedCell& cell : cells) check_points(cell, closing, faults);
  if (cells.empty() && !faults.any()) faults.add(1, "no cells; a line is `x y cell`");
  if (!faults.any()) check_self_crossing(cells, faults);
  if (faults.any()) faults.raise();
  if (closing > 0)
    notes.push_back(fmt::format("{}: {} cells repeat their first point at the end; left out", path.string(), closing));
  return cells;
}

}  // namespace lamella
