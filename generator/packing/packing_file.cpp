#include "generator/packing/packing_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>
#include <optional>

#include "generator/packing/tess_file.h"
#include "generator/sample/errors.h"

namespace lamella {
namespace {

std::vector<std::string> split(const std::string& line) {
  constexpr const char* kBlank = " \t\r";
  std::vector<std::string> words;
  const bool by_blanks = line.find_first_of(",;") == std::string::npos;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(by_blanks ? " \t\r" : ",;", begin), line.size());
    std::string word = line.substr(begin, end - begin);
    const std::size_t first = word.find_first_not_of(kBlank);
    word = first == std::string::npos ? "" : word.substr(first, word.find_last_not_of(kBlank) - first + 1);
    if (!word.empty() || !by_blanks) words.push_back(word);
    begin = end + 1;
  }
  return words;
}

std::optional<double> number(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0') return {};
  return value;
}

/// Collects faults as `file:line: ...`; a file of another kind entirely need not be listed line by line.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}
  void add(int line, const std::string& what) {
    if (++count_ <= kShown) faults_.push_back(fmt::format("{}:{}: {}", file_, line, what));
  }
  void add(const std::string& what) { ++count_, faults_.push_back(fmt::format("{}: {}", file_, what)); }
  bool none() const { return count_ == 0; }
  void throw_if_any() {
    if (count_ == 0) return;
    if (count_ > kShown) faults_.push_back(fmt::format("{}: and {} more lines with faults", file_, count_ - kShown));
    throw SceneError(std::move(faults_));
  }

 private:
  static constexpr int kShown = 50;
  std::string file_;
  std::vector<std::string> faults_;
  int count_ = 0;
};

/// A line of the file.
struct Row {
  Disk disk;
  std::optional<double> target_area;
};

std::optional<Row> parse_row(const std::string& line, int line_number, Faults& faults) {
  const auto words = split(line);
  if (words.size() != 3 && words.size() != 4) {
    faults.add(line_number,
               fmt::format("{} columns: must be three, x, y and r, or four, with target_area", words.size()));
    return {};
  }
  std::array<double, 4> values{};
  for (std::size_t k = 0; k < words.size(); ++k) {
    const auto value = number(words[k]);
    const char* name = std::array{"x", "y", "r", "target_area"}[k];
    // Beyond this, squared distances lose the radii or overflow.
    constexpr double kHuge = 1e100;
    if (!value)
      faults.add(line_number, fmt::format("{} = \"{}\" is not a number", name, words[k]));
    else if (!std::isfinite(*value) || std::abs(*value) > kHuge)
      faults.add(line_number, fmt::format("{} = {}: must be finite, at most 1e100", name, words[k]));
    else if (k == 2 && !(*value > 0))
      faults.add(line_number, fmt::format("r = {}: a radius must be positive", words[k]));
    else if (k == 3 && !(*value > 0))
      faults.add(line_number, fmt::format("target_area = {}: an area must be positive", words[k]));
    else {
      values[k] = *value;
      continue;
    }
    return {};
  }
  Row row{.disk = {{values[0], values[1]}, values[2]}, .target_area = {}};
  if (words.size() == 4) row.target_area = values[3];
  return row;
}

/// The first line may name its columns. Two numbers out of three are a broken line, not a header.
bool is_header(const std::string& line) {
  const auto words = split(line);
  return std::none_of(words.begin(), words.end(), [](const std::string& word) { return number(word).has_value(); });
}

}  // namespace

Packing read_packing(const std::filesystem::path& path, const Box* box, const std::string& duplicates) {
  if (path.extension() == ".tess") return read_tess_seeds(path, box);
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    throw DataError(fmt::format("{}: cannot be read; it should be a packing, x,y,r a line", path.string()));
  Packing packing;
  Faults faults(path.string());
  std::map<std::array<double, 3>, int> line_of;
  bool first = true;
  std::vector<std::string> left_out;
  std::vector<int> number;
  int row_number = -1;
  int columns_set_by = 0;  // line of the first disk
  bool with_area = false;
  std::string line;
  for (int line_number = 1; std::getline(in, line); ++line_number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const bool header = first && is_header(line);
    first = false;
    if (header) continue;
    const auto row = parse_row(line, line_number, faults);
    if (!row) continue;
    const Disk* disk = &row->disk;
    ++row_number;
    if (columns_set_by == 0) columns_set_by = line_number, with_area = row->target_area.has_value();
    if (row->target_area.has_value() != with_area)
      faults.add(line_number, fmt::format("{} target_area, line {} has {}: give it for all disks, or for none",
                                          with_area ? "no" : "a", columns_set_by, with_area ? "one" : "none"));
    const auto [same, is_new] = line_of.insert({{disk->centre.x(), disk->centre.y(), disk->radius}, line_number});
    if (!is_new && duplicates == "keep_first") {
      if (left_out.size() < 10) left_out.push_back(fmt::format("{} (line {})", row_number, line_number));
      continue;
    }
    if (!is_new)
      faults.add(
          line_number,
          fmt::format("the same disk as in line {}: remove it, or set sample.packing.duplicates = \"keep_first\"",
                      same->second));
    if (box && !box->contains(disk->centre))
      faults.add(line_number,
                 fmt::format("the centre ({:.9g}, {:.9g}) lies outside the box [{:.9g}, {:.9g}] x [{:.9g}, {:.9g}]",
                             disk->centre.x(), disk->centre.y(), box->lo.x(), box->hi.x(), box->lo.y(), box->hi.y()));
    packing.disks.push_back(*disk);
    number.push_back(row_number);
    if (row->target_area) packing.target_area.push_back(*row->target_area);
  }
  if (packing.disks.empty() && faults.none()) faults.add("holds no disk: must have at least one line x,y,r");
  faults.throw_if_any();

  if (box) {
    packing.box = *box;
  } else {
    packing.box = {packing.disks[0].centre, packing.disks[0].centre};
    for (const Disk& disk : packing.disks) {
      packing.box.lo = packing.box.lo.cwiseMin(disk.centre - Vec2::Constant(disk.radius));
      packing.box.hi = packing.box.hi.cwiseMax(disk.centre + Vec2::Constant(disk.radius));
    }
  }
  packing.fraction = area_fraction(packing.disks, packing.box);
  if (left_out.empty()) return packing;
  packing.notes.push_back(
      fmt::format("{}: {} disks left out that occur earlier in the file: {}{}; the others keep their "
                  "numbers",
                  path.string(), row_number + 1 - static_cast<int>(number.size()), fmt::join(left_out, ", "),
                  left_out.size() == 10 ? ", ..." : ""));
  packing.number = std::move(number);
  return packing;
}

void keep_first_at_each_place(Packing& packing) {
  std::map<std::array<double, 2>, std::size_t> first;
  std::vector<std::string> dropped;
  const bool with_area = !packing.target_area.empty();
  std::size_t kept = 0;
  std::vector<int> number = packing.number;
  if (number.empty()) {
    number.resize(packing.disks.size());
    std::iota(number.begin(), number.end(), 0);
  }
  for (std::size_t k = 0; k < packing.disks.size(); ++k) {
    Vec2 place = packing.disks[k].centre;
    for (const int axis : {0, 1})
      if (packing.periodic[axis] && place[axis] == packing.box.hi[axis]) place[axis] = packing.box.lo[axis];
    const auto [same, is_new] = first.insert({{place.x(), place.y()}, k});
    if (!is_new) {
      if (dropped.size() < 10) dropped.push_back(fmt::format("{} as {}", number[k], number[same->second]));
      continue;
    }
    packing.disks[kept] = packing.disks[k];
    number[kept] = number[k];
    if (with_area) packing.target_area[kept] = packing.target_area[k];
    ++kept;
  }
  if (kept == packing.disks.size()) return;
  packing.notes.push_back(
      fmt::format("{} disks left out that lie where an earlier one lies, as no areas can be shared "
                  "between them: {}",
                  packing.disks.size() - kept, fmt::join(dropped, ", ")));
  packing.disks.resize(kept);
  number.resize(kept);
  packing.number = std::move(number);
  if (with_area) packing.target_area.resize(kept);
  packing.fraction = area_fraction(packing.disks, packing.box);
}

void write_packing(const std::filesystem::path& path, const Packing& packing) {
  std::ofstream out(path);
  const bool with_area = !packing.target_area.empty();
  out << (with_area ? "x,y,r,target_area\n" : "x,y,r\n");
  for (std::size_t k = 0; k < packing.disks.size(); ++k) {
    const Disk& disk = packing.disks[k];
    out << fmt::format("{:.17g},{:.17g},{:.17g}", disk.centre.x(), disk.centre.y(), disk.radius);
    if (with_area) out << fmt::format(",{:.17g}", packing.target_area[k]);
    out << '\n';
  }
  out.flush();
  if (!out) throw DataError(fmt::format("{}: cannot be written", path.string()));
}

}  // namespace lamella
