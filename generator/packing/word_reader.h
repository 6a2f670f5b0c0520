// Text files of words (.tess, .off), read in order: every word knows its line, and every fault names it.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace lamella {

/// Words are separated by blanks and line ends; `#` starts a comment. The first fault ends the reading: what follows a
/// wrong word of such a file means nothing.
class WordReader {
 public:
  /// Throws DataError when the file cannot be read; `kind` says what it should be: "a tessellation (.tess)".
  WordReader(const std::filesystem::path& path, const std::string& kind);

  bool at_end() const { return word_.empty(); }
  /// The next word, which stays the next one; empty at the end.
  std::string_view peek() const { return word_; }
  std::string_view next(const std::string& what);
  /// Passes over what is left of the line of the last word.
  void pass_line();
  /// The next word, which must be `word`.
  void expect(std::string_view word);
  /// Finite, at most 1e100 in size.
  double number(const std::string& what);
  /// In [low, high].
  int whole(const std::string& what, int low, int high);
  /// How many items follow: 0 or more, and no more than the rest of the file can hold at two characters each.
  int count(const std::string& what);

  int line() const { return line_; }  // of the word that was read last
  std::string where() const;          // "file:line"
  const std::string& file() const { return file_; }
  /// Throws SceneError "file:line: what".
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  void advance();

  std::string file_, text_;
  std::size_t at_ = 0;
  std::string_view word_;
  int line_ = 1, next_line_ = 1;
};

/// What a message shows of a file: the first characters of a word, none that a terminal would act on.
std::string shown(std::string_view word);

}  // namespace lamella
