// A scene file as a tree of values that remember where they stand, and the merging of layers: what a group takes from its
// section, a stage from the one it continues, and the file from --set. It knows TOML, and no key of any section.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace lamella {

struct Member;

struct Value {
  enum class Kind { text, number, integer, boolean, array, table, date };
  Kind kind = Kind::table;
  int line = 0;         // in the file
  std::string setting;  // "--set a.b=1" when it comes from there, and not from the file
  std::string text;
  double number = 0;  // of an integer too
  std::int64_t integer = 0;
  bool boolean = false;
  std::vector<Value> items;     // of an array
  std::vector<Member> members;  // of a table, in the order of the file

  bool is_table() const { return kind == Kind::table; }
  /// The member of a table; nullptr when there is none.
  const Value* find(const std::string& key) const;
  Value* find(const std::string& key);
  void erase(const std::string& key);
  /// What it is, for messages: "a string", "a table".
  const char* kind_name() const;
};

struct Member {
  std::string key;
  Value value;
};

/// Collects what is wrong, as lines `file:line: key: what; what would be right`. A value that groups and stages inherit is
/// reported once.
class Faults {
 public:
  explicit Faults(std::string file) : file_(std::move(file)) {}
  void add(const Value& at, const std::string& key, const std::string& what);
  /// Throws SceneError with all of them, in the order of the file's lines, when there are any.
  void raise() const;

 private:
  struct Fault {
    int line;
    std::string place, key, what;
  };
  std::string file_;
  std::vector<Fault> faults_;
};

/// Throws SceneError `name:line: ...` when the text is not TOML.
Value parse_document(const std::string& text, const std::string& name);

/// Applies "a.b.c=value" to the root. A value that is not TOML is taken as a string, so that `--set kind=rings` and
/// `--set x=3 um` need no quotes. In an array of tables, a part of the key is the name of an entry, or its number from 0.
void apply_setting(Value& root, const std::string& setting, Faults& faults);

/// `lower` with what `upper` says put over it, key by key; arrays of tables with names, entry by entry. A key of `upper`
/// takes away what it contradicts below: a stage that gives a speed replaces the strain rate that it would inherit.
Value merged(const Value& lower, const Value& upper);

/// Two ways of saying one thing: keys of one side exclude those of the other within a table.
struct Alternative {
  std::vector<std::string> one, other;
};
const std::vector<Alternative>& alternatives();

}  // namespace lamella
