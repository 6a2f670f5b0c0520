// HDF5 behind one thin file: handles that close themselves, and every failure turned into one DataError sentence.
// The library's own stack printing is off.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lamella::h5 {

/// How arrays above 1 kB are stored: plain suits what is written often and read once.
enum class Storage { compressed, plain };

class Node;

/// Lets `fill` write a new file under a temporary name beside `path`, brings it to the disk, and renames it: `path` is
/// complete or as it was. Throws DataError, with the system's reason; then the temporary file is gone.
void replace_file(const std::filesystem::path& path, const std::function<void(Node&)>& fill,
                  Storage storage = Storage::compressed);

/// An open file or group. Move only.
class Node {
 public:
  static Node create(const std::filesystem::path& path, Storage storage = Storage::compressed);  // truncates
  static Node open(const std::filesystem::path& path);                                           // read only
  Node(Node&&) noexcept;
  Node& operator=(Node&&) noexcept;
  ~Node();
  /// Flushes and closes, and reports what a destructor could not (a full disk).
  void close();

  Node make_group(const std::string& name);
  Node group(const std::string& name) const;
  bool has(const std::string& name) const;
  std::vector<std::string> names() const;  // members of the group, sorted
  /// Copies a member of another file with all it holds, compressed as it is, under the name `as`.
  void copy(const Node& from, const std::string& name, const std::string& as);

  // Arrays of shape (rows) or (rows, columns); compressed when large.
  void write(const std::string& name, const std::vector<double>& data, int columns = 1);
  void write(const std::string& name, const std::vector<std::int32_t>& data, int columns = 1);
  void write(const std::string& name, const std::vector<std::int64_t>& data, int columns = 1);
  void write(const std::string& name, const std::vector<std::uint8_t>& data, int columns = 1);
  // `what` in the message is the path of the file and of the array. `columns` is checked.
  std::vector<double> doubles(const std::string& name, int columns = 1) const;
  std::vector<std::int32_t> ints(const std::string& name, int columns = 1) const;
  std::vector<std::int64_t> longs(const std::string& name, int columns = 1) const;
  std::vector<std::uint8_t> bytes(const std::string& name, int columns = 1) const;
  /// Columns of an array (1 for shape (rows)), and its kind: 'd' floating, 'i' 32-bit, 'l' 64-bit, 'b' 8-bit.
  int columns(const std::string& name) const;
  char kind(const std::string& name) const;

  // Attributes of the group, or of one of its arrays: name "array@attribute".
  void write_text(const std::string& name, const std::string& value);
  void write_number(const std::string& name, double value);
  void write_integer(const std::string& name, std::int64_t value);
  void write_texts(const std::string& name, const std::vector<std::string>& lines);  // none of which has a line break
  std::string text(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  double number(const std::string& name) const;
  std::int64_t integer(const std::string& name) const;
  bool has_attribute(const std::string& name) const;
  std::vector<std::string> attributes() const;  // of the group, sorted

  const std::string& where() const { return where_; }  // "file.h5:/group" for messages

 private:
  friend void replace_file(const std::filesystem::path& path, const std::function<void(Node&)>& fill, Storage storage);
  /// `shown` stands for the file in messages.
  static Node make(const std::filesystem::path& path, const std::filesystem::path& shown, Storage storage);
  Node(std::int64_t id, std::string where, Storage storage, std::shared_ptr<int> error)
      : id_(id), where_(std::move(where)), storage_(storage), error_(std::move(error)) {}
  void check_written(bool done, const std::string& name) const;
  std::int64_t id_ = -1;
  std::string where_;
  Storage storage_ = Storage::compressed;
  std::shared_ptr<int> error_;  // of the disk, as errno; shared by a file that is written and its groups
};

/// Name under which replace_file writes: never mistaken for a complete file.
std::filesystem::path temporary_name(const std::filesystem::path& path);
/// From now on, files of this process are left to the operating system to bring to the disk: for runs that can be had again, and are many.
/// A crash of the machine may then cost a file that was complete; a crash of the program does not.
void leave_flushing_to_the_system();
/// Brings the entries of a folder (files made, renamed, removed) to the disk.
void sync_folder(const std::filesystem::path& folder);

}  // namespace lamella::h5
