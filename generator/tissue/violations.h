// What is wrong with a sample, in words: the first of each kind, and how many more.
#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "generator/sample/sample.h"

namespace lamella {

class Violations {
 public:
  static constexpr std::size_t kMost = 20;  // of one kind that are listed
  template <class... T>
  void add(fmt::format_string<T...> format, T&&... values) {
    if (list_.size() < kMost) list_.push_back(fmt::format(format, std::forward<T>(values)...));
    ++count_;
  }
  void append_to(std::vector<std::string>& all) const {
    all.insert(all.end(), list_.begin(), list_.end());
    if (count_ > list_.size()) all.push_back(fmt::format("... and {} more like it", count_ - list_.size()));
  }
  bool any() const { return count_ > 0; }

 private:
  std::vector<std::string> list_;
  std::size_t count_ = 0;
};

/// Each appends what it finds; the arrays have the sizes that they should have.
void check_walls_and_links(const Sample& sample, std::vector<std::string>& all);
void check_crossings(const Sample& sample, std::vector<std::string>& all);

}  // namespace lamella
