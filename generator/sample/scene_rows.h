// What a row of the scene's parameters is. Parsing, units, messages, `lamella describe` and the reference page all come
// from the rows in scene_rows.cpp, and from the defaults in scene.h, which stand nowhere else.
#pragma once
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "generator/sample/scene.h"

namespace lamella {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false, high_excluded = false;

  bool contains(double value) const;
  std::string text(const std::string& unit) const;  // "> 0 m", "0 to 1", "" where everything goes
};

template <class S>
using MemberOf = std::variant<double S::*, std::optional<double> S::*, int S::*, std::uint64_t S::*, bool S::*,
                              std::string S::*, Vec2 S::*, std::vector<Vec2> S::*, std::vector<int> S::*,
                              std::optional<Vec2> S::*, std::optional<Box> S::*>;

template <class S>
struct Row {
  const char* key;
  MemberOf<S> member;
  const char* unit = "";  // SI; "" for words, "1" for ratios
  Range range = {};
  const char* sentence = "";
  const char* fallback = "";              // what holds when absent, where scene.h's value does not say it
  std::vector<std::string> choices = {};  // of a word
  const char* unit_per_link = "";         // replaces `unit` with per = "link"
  const char* unit_of_second = "";        // of the second number of a pair, where it is not that of the first
  bool required = false;
};

/// Rows of each section, in the order of the reference page.
template <class S>
const std::vector<Row<S>>& rows();

template <>
const std::vector<Row<Scene>>& rows();
template <>
const std::vector<Row<SampleScene>>& rows();
template <>
const std::vector<Row<SizesScene>>& rows();
template <>
const std::vector<Row<PackingScene>>& rows();
template <>
const std::vector<Row<WallsScene>>& rows();
template <>
const std::vector<Row<NotchScene>>& rows();
template <>
const std::vector<Row<ShapeScene>>& rows();
template <>
const std::vector<Row<MixtureScene>>& rows();
template <>
const std::vector<Row<DomainScene>>& rows();
template <>
const std::vector<Row<HoleScene>>& rows();
template <>
const std::vector<Row<AreasScene>>& rows();
template <>
const std::vector<Row<LayerScene>>& rows();
template <>
const std::vector<Row<GradientScene>>& rows();
template <>
const std::vector<Row<StretchScene>>& rows();
template <>
const std::vector<Row<ImageScene>>& rows();
template <>
const std::vector<Row<CellScene>>& rows();
template <>
const std::vector<Row<CoreScene>>& rows();
template <>
const std::vector<Row<LinkScene>>& rows();
template <>
const std::vector<Row<ContactScene>>& rows();
template <>
const std::vector<Row<GravityScene>>& rows();
template <>
const std::vector<Row<DragScene>>& rows();
template <>
const std::vector<Row<LoadScene>>& rows();
template <>
const std::vector<Row<InitialScene>>& rows();
template <>
const std::vector<Row<Selection>>& rows();
template <>
const std::vector<Row<LoadingScene>>& rows();
template <>
const std::vector<Row<StopScene>>& rows();
template <>
const std::vector<Row<RunScene>>& rows();
template <>
const std::vector<Row<OutputScene>>& rows();
/// Keys of an entry of [[stages]] that are not sections: its name, what it continues and what it leaves out.
struct StageScene {
  std::string name, from;
};
template <>
const std::vector<Row<StageScene>>& rows();

}  // namespace lamella
