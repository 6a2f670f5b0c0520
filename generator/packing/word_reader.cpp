#include "generator/packing/word_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "generator/sample/errors.h"

namespace lamella {

WordReader::WordReader(const std::filesystem::path& path, const std::string& kind) : file_(path.string()) {
  if (!std::filesystem::is_regular_file(path))
    throw DataError(fmt::format("{}: no such file; it should be {}", file_, kind));
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw DataError(fmt::format("{}: cannot be read; it should be {}", file_, kind));
  text_ = std::move(text).str();
  advance();
}

void WordReader::advance() {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (at_ < text_.size()) {
    if (text_[at_] == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else if (blank(text_[at_])) {
      if (text_[at_++] == '\n') ++next_line_;
    } else {
      break;
    }
  }
  const std::size_t begin = at_;
  while (at_ < text_.size() && !blank(text_[at_]) && text_[at_] != '#') ++at_;
  word_ = std::string_view(text_).substr(begin, at_ - begin);
}

std::string_view WordReader::next(const std::string& what) {
  line_ = next_line_;
  if (at_end()) refuse(fmt::format("the file ends where {} should be", what));
  const std::string_view word = word_;
  advance();
  return word;
}

void WordReader::pass_line() {
  while (!at_end() && next_line_ == line_) advance();
}

void WordReader::expect(std::string_view word) {
  const std::string_view found = next(std::string(word));
  if (found != word) refuse(fmt::format("\"{}\" where {} should be", shown(found), word));
}

double WordReader::number(const std::string& what) {
  std::string_view word = next(what);
  if (word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    refuse(fmt::format("{} is \"{}\"; must be a number", what, shown(word)));
  if (!std::isfinite(value) || std::abs(value) > 1e100)
    refuse(fmt::format("{} is {}; must be finite, at most 1e100", what, shown(word)));
  return value;
}

int WordReader::whole(const std::string& what, int low, int high) {
  const std::string_view word = next(what);
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size())
    refuse(fmt::format("{} is \"{}\"; must be a whole number", what, shown(word)));
  if (error != std::errc() || value < low || value > high)
    refuse(fmt::format("{} is {}; must be from {} to {}", what, shown(word), low, high));
  return value;
}

int WordReader::count(const std::string& what) {
  const int value = whole(what, 0, std::numeric_limits<int>::max());
  const std::size_t left = (text_.size() - at_ + word_.size() + 1) / 2;
  if (static_cast<std::size_t>(value) > left)
    refuse(fmt::format("{} is {}; the rest of the file can hold {} at most", what, value, left));
  return value;
}

std::string WordReader::where() const { return fmt::format("{}:{}", file_, line_); }

void WordReader::refuse(const std::string& what) const { throw SceneError(fmt::format("{}: {}", where(), what)); }

std::string shown(std::string_view word) {
  std::string text(word.substr(0, 30));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return text;
}

}  // namespace lamella
