#include "generator/sample/h5.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "generator/sample/errors.h"
#include "generator/sample/h5_chunks.h"
#include "generator/sample/h5_driver.h"

namespace lamella::h5 {
namespace {

constexpr std::size_t kPlainBytes = 1024;           // smaller arrays are not worth a chunk of their own
constexpr std::size_t kChunkBytes = 1 << 20;        // larger arrays are cut into chunks of this size
constexpr double kLargestCompression = 1032;        // of deflate: no honest array claims more than this times its bytes
constexpr double kLargestChunk = 64.0 * (1 << 20);  // of other people's files [bytes]

/// An identifier of the library that closes itself.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library prints its error stack unless told otherwise, in every thread anew.
void silence() {
  thread_local bool silent = false;
  if (!silent) H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  silent = true;
}

/// What the system or the library said about the last failure, innermost cause first.
std::string reason() {
  std::string text;
  const auto keep_first = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
    auto& kept = *static_cast<std::string*>(out);
    if (kept.empty() && error->desc) kept = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &text);
  const std::string key = "error message = '";
  if (const auto from = text.find(key); from != std::string::npos) {
    const auto begin = from + key.size();
    return text.substr(begin, text.find('\'', begin) - begin);
  }
  return text.empty() ? "the HDF5 library gives no reason" : text;
}

template <typename T>
struct Stored;
template <>
struct Stored<double> {
  static hid_t disk() { return H5T_IEEE_F64LE; }
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
};
template <>
struct Stored<std::int32_t> {
  static hid_t disk() { return H5T_STD_I32LE; }
  static hid_t memory() { return H5T_NATIVE_INT32; }
};
template <>
struct Stored<std::int64_t> {
  static hid_t disk() { return H5T_STD_I64LE; }
  static hid_t memory() { return H5T_NATIVE_INT64; }
};
template <>
struct Stored<std::uint8_t> {
  static hid_t disk() { return H5T_STD_U8LE; }
  static hid_t memory() { return H5T_NATIVE_UINT8; }
};

/// False when the library or the disk refuses.
template <typename T>
bool write_array(hid_t group, const std::string& where, const std::string& name, const std::vector<T>& data,
                 int columns, Storage storage) {
  if (columns < 1 || data.size() % static_cast<std::size_t>(columns) != 0)
    throw DataError(
        fmt::format("{}: cannot write '{}': {} values do not fill rows of {}", where, name, data.size(), columns));
  const int rank = columns == 1 ? 1 : 2;
  const std::array<hsize_t, 2> shape{data.size() / static_cast<std::size_t>(columns), static_cast<hsize_t>(columns)};
  const Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  if (!space.valid() || !creation.valid() || !access.valid()) return false;
  H5Pset_obj_track_times(creation.get(), 0);  // no dates: the same arrays are the same bytes
  H5Pset_chunk_cache(access.get(), 0, 0, 1);  // every chunk is written once, so there is nothing to keep
  const Rows rows{data.data(), shape[0], sizeof(T) * static_cast<std::size_t>(columns), sizeof(T)};
  const bool in_chunks = storage == Storage::compressed && data.size() * sizeof(T) > kPlainBytes;
  const std::size_t chunk_rows =
      std::clamp<std::size_t>(kChunkBytes / rows.row_bytes, 1, std::max<hsize_t>(shape[0], 1));
  if (in_chunks) set_chunks(creation.get(), chunk_rows, shape[1], rank);
  const Handle array(
      H5Dcreate2(group, name.c_str(), Stored<T>::disk(), space.get(), H5P_DEFAULT, creation.get(), access.get()),
      H5Dclose);
  if (in_chunks) return array.valid() && write_chunks(array.get(), rows, chunk_rows);
  return array.valid() &&
         (data.empty() || H5Dwrite(array.get(), Stored<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) >= 0);
}

/// True for a member stored in this file. Links into other files are not followed.
bool is_member(hid_t group, const std::string& name) {
  H5L_info_t info;
  return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0 && H5Lget_info(group, name.c_str(), &info, H5P_DEFAULT) >= 0 &&
         info.type == H5L_TYPE_HARD;
}

/// An array opened for reading, with what must be known before any memory is taken for it.
struct Source {
  Handle array, type, space;
  std::string what;  // "file.h5:/group: array 'x'"
  std::array<hsize_t, 2> shape{0, 1};

  Source(hid_t group, const std::string& where, const std::string& name)
      : array(is_member(group, name) ? H5Dopen2(group, name.c_str(), H5P_DEFAULT) : -1, H5Dclose),
        type(array.valid() ? H5Dget_type(array.get()) : -1, H5Tclose),
        space(array.valid() ? H5Dget_space(array.get()) : -1, H5Sclose),
        what(fmt::format("{}: array '{}'", where, name)) {
    if (!is_member(group, name)) throw DataError(what + " is missing");
    if (!array.valid() || !type.valid() || !space.valid())
      throw DataError(fmt::format("{} cannot be read: it is damaged or no array ({})", what, reason()));
    const int rank = H5Sis_simple(space.get()) > 0 ? H5Sget_simple_extent_ndims(space.get()) : -1;
    if (rank < 1 || rank > 2)
      throw DataError(fmt::format("{} has the wrong shape: must be (rows) or (rows, columns)", what));
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  }

  double claimed_bytes() const {
    return static_cast<double>(shape[0]) * static_cast<double>(shape[1]) * static_cast<double>(H5Tget_size(type.get()));
  }

  /// A file may claim any size; only what its bytes can hold is believed.
  void check_size() const {
    const Handle properties(H5Dget_create_plist(array.get()), H5Pclose);
    const H5D_layout_t layout = properties.valid() ? H5Pget_layout(properties.get()) : H5D_LAYOUT_ERROR;
    if (layout == H5D_LAYOUT_ERROR || layout == H5D_VIRTUAL || H5Pget_external_count(properties.get()) != 0)
      throw DataError(what + " is stored outside of its file; must be stored inside");
    if (claimed_bytes() == 0) return;
    const Handle file(H5Iget_file_id(array.get()), H5Fclose);
    hsize_t file_bytes = 0;
    H5Fget_filesize(file.get(), &file_bytes);
    const double stored = static_cast<double>(std::min<hsize_t>(H5Dget_storage_size(array.get()), file_bytes));
    double most = stored;
    if (layout == H5D_CHUNKED) {
      std::array<hsize_t, 2> chunk{1, 1};
      H5Pget_chunk(properties.get(), 2, chunk.data());
      const double chunk_bytes =
          static_cast<double>(chunk[0]) * static_cast<double>(chunk[1]) * static_cast<double>(H5Tget_size(type.get()));
      most = H5Pget_nfilters(properties.get()) > 0 ? kLargestCompression * stored : stored;
      if (chunk_bytes > std::max(most, kLargestChunk)) most = 0;
    }
    if (claimed_bytes() > most)
      throw DataError(fmt::format("{} claims {} x {} values, but the file holds only {:.0f} bytes of it", what,
                                  shape[0], shape[1], stored));
  }

  void check_columns(int columns) const {
    if (shape[1] == static_cast<hsize_t>(columns)) return;
    throw DataError(fmt::format("{} has {} column{}; must have {}", what, shape[1], shape[1] == 1 ? "" : "s", columns));
  }
};

std::string type_in_words(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return "integers";
    case H5T_FLOAT:
      return "floating-point numbers";
    case H5T_STRING:
      return "text";
    case H5T_ENUM:
      return "an enumeration (h5py stores booleans so)";
    default:
      return "something else";
  }
}

template <typename T>
std::vector<T> read_as(const Source& source) {
  std::vector<T> data;
  try {
    data.resize(source.shape[0] * source.shape[1]);
  } catch (const std::bad_alloc&) {
    throw DataError(source.what + " does not fit into memory");
  }
  if (!data.empty() && H5Dread(source.array.get(), Stored<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0)
    throw DataError(fmt::format("{} cannot be read: the file is damaged ({})", source.what, reason()));
  return data;
}

/// Integers of any width, as long as every value fits.
template <typename T>
std::vector<T> read_integers(hid_t group, const std::string& where, const std::string& name, int columns) {
  const Source source(group, where, name);
  if (H5Tget_class(source.type.get()) != H5T_INTEGER)
    throw DataError(fmt::format("{} holds {}; must hold integers", source.what, type_in_words(source.type.get())));
  source.check_columns(columns);
  source.check_size();
  if (H5Tequal(source.type.get(), Stored<T>::disk()) > 0) return read_as<T>(source);
  const auto wide = read_as<std::int64_t>(source);
  std::vector<T> data(wide.size());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    data[i] = static_cast<T>(wide[i]);
    if (data[i] != wide[i])
      throw DataError(fmt::format("{} holds {}; must be from {} to {}", source.what, wide[i],
                                  static_cast<std::int64_t>(std::numeric_limits<T>::min()),
                                  static_cast<std::int64_t>(std::numeric_limits<T>::max())));
  }
  return data;
}

/// The object that an attribute's name refers to: "array@attribute" or "attribute" of the group itself.
struct Attribute {
  Handle object;
  std::string name, what;

  Attribute(hid_t group, const std::string& where, const std::string& full)
      : object(open_object(group, full), H5Oclose),
        name(full.substr(full.find('@') + 1)),
        what(fmt::format("{}: attribute '{}'", where, full)) {}

  static hid_t open_object(hid_t group, const std::string& full) {
    const auto at = full.find('@');
    if (at == std::string::npos) return H5Oopen(group, ".", H5P_DEFAULT);
    const std::string member = full.substr(0, at);
    return is_member(group, member) ? H5Oopen(group, member.c_str(), H5P_DEFAULT) : -1;
  }

  bool exists() const { return object.valid() && H5Aexists(object.get(), name.c_str()) > 0; }
};

bool write_attribute(hid_t group, const std::string& where, const std::string& full, hid_t disk, hid_t memory,
                     const void* value) {
  const Attribute place(group, where, full);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(place.object.valid() ? H5Acreate2(place.object.get(), place.name.c_str(), disk, space.get(),
                                                           H5P_DEFAULT, H5P_DEFAULT)
                                              : -1,
                         H5Aclose);
  return attribute.valid() && H5Awrite(attribute.get(), memory, value) >= 0;
}

/// An attribute opened for reading: one value.
struct Value {
  Attribute place;
  Handle attribute, type;

  Value(hid_t group, const std::string& where, const std::string& full)
      : place(group, where, full),
        attribute(place.exists() ? H5Aopen(place.object.get(), place.name.c_str(), H5P_DEFAULT) : -1, H5Aclose),
        type(attribute.valid() ? H5Aget_type(attribute.get()) : -1, H5Tclose) {
    if (!place.exists()) throw DataError(place.what + " is missing");
    if (!attribute.valid() || !type.valid())
      throw DataError(fmt::format("{} cannot be read: the file is damaged ({})", place.what, reason()));
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    if (!space.valid() || H5Sget_simple_extent_npoints(space.get()) != 1)
      throw DataError(place.what + " must be one value");
  }

  [[noreturn]] void refuse(const std::string& expected) const {
    throw DataError(fmt::format("{} holds {}; must be {}", place.what, type_in_words(type.get()), expected));
  }

  void read(hid_t memory, void* value) const {
    if (H5Aread(attribute.get(), memory, value) < 0)
      throw DataError(fmt::format("{} cannot be read: the file is damaged ({})", place.what, reason()));
  }
};

[[noreturn]] void fail_to_open(const std::filesystem::path& path) {
  const std::string why = reason();
  if (why.find("truncated") != std::string::npos)
    throw DataError(
        fmt::format("{} is truncated: it is shorter than it says itself; it must be written again", path.string()));
  throw DataError(fmt::format("{} cannot be opened: {}", path.string(), why));
}

}  // namespace

Node::Node(Node&& other) noexcept
    : id_(std::exchange(other.id_, -1)),
      where_(std::move(other.where_)),
      storage_(other.storage_),
      error_(std::move(other.error_)) {}

Node& Node::operator=(Node&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(where_, other.where_);
  std::swap(storage_, other.storage_);
  std::swap(error_, other.error_);
  return *this;
}

Node::~Node() {
  // Closing a file that was created closes its groups too: then they are no longer valid here.
  if (id_ < 0 || H5Iis_valid(id_) <= 0) return;
  H5Iget_type(id_) == H5I_FILE ? H5Fclose(id_) : H5Gclose(id_);
}

void Node::check_written(bool done, const std::string& name) const {
  const bool disk_failed = error_ && *error_ != 0;
  if (done && !disk_failed) return;
  const std::string why = disk_failed ? std::strerror(*error_) : reason();
  throw DataError(fmt::format("{}: cannot write '{}': {}", where_, name, why));
}

Node Node::create(const std::filesystem::path& path, Storage storage) { return make(path, path, storage); }

Node Node::make(const std::filesystem::path& path, const std::filesystem::path& shown, Storage storage) {
  silence();
  auto error = std::make_shared<int>(0);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  set_careful_driver(access.get(), error.get());
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // The newest layout guards everything but the values of small arrays by checksums, so that damage is noticed.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), 0);
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get());
  if (id < 0)
    throw DataError(fmt::format("{} cannot be written: {}", shown.string(), *error ? std::strerror(*error) : reason()));
  return Node(id, shown.string() + ":/", storage, std::move(error));
}

Node Node::open(const std::filesystem::path& path) {
  silence();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    throw DataError(fmt::format("{} does not exist", path.string()));
  if (error) throw DataError(fmt::format("{} cannot be opened: {}", path.string(), error.message()));
  if (!std::filesystem::is_regular_file(status))
    throw DataError(fmt::format("{} is not a file; must be an HDF5 file", path.string()));
  if (std::filesystem::file_size(path, error) == 0)
    throw DataError(fmt::format("{} is empty; must be an HDF5 file", path.string()));
  if (::access(path.c_str(), R_OK) != 0)
    throw DataError(fmt::format("{} cannot be opened: {}", path.string(), std::strerror(errno)));
  if (H5Fis_hdf5(path.c_str()) <= 0) throw DataError(fmt::format("{} is not an HDF5 file", path.string()));
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_sec2(access.get());
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get());
  if (id < 0) fail_to_open(path);
  return Node(id, path.string() + ":/", Storage::compressed, nullptr);
}

void Node::close() {
  const hid_t id = std::exchange(id_, -1);
  if (id < 0) return;
  const herr_t status = H5Iget_type(id) == H5I_FILE ? H5Fclose(id) : H5Gclose(id);
  const bool disk_failed = error_ && *error_ != 0;
  if (status >= 0 && !disk_failed) return;
  throw DataError(fmt::format("{} cannot be written: {}", where_.substr(0, where_.rfind(":/")),
                              disk_failed ? std::strerror(*error_) : reason()));
}

Node Node::make_group(const std::string& name) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), 0);
  const hid_t id = H5Gcreate2(id_, name.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT);
  check_written(id >= 0, name);
  return Node(id, where_ + (where_.back() == '/' ? "" : "/") + name, storage_, error_);
}

Node Node::group(const std::string& name) const {
  if (!has(name)) throw DataError(fmt::format("{}: group '{}' is missing", where_, name));
  const hid_t id = H5Gopen2(id_, name.c_str(), H5P_DEFAULT);
  if (id < 0) throw DataError(fmt::format("{}: group '{}' cannot be opened: it is damaged or no group", where_, name));
  return Node(id, where_ + (where_.back() == '/' ? "" : "/") + name, storage_, error_);
}

bool Node::has(const std::string& name) const { return is_member(id_, name); }

std::vector<std::string> Node::names() const {
  std::vector<std::string> found;
  const auto keep = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (H5Literate(id_, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep, &found) < 0)
    throw DataError(fmt::format("{} cannot be listed: the file is damaged ({})", where_, reason()));
  std::sort(found.begin(), found.end());
  return found;
}

void Node::copy(const Node& from, const std::string& name, const std::string& as) {
  if (!from.has(name)) throw DataError(fmt::format("{}: '{}' is missing", from.where_, name));
  check_written(H5Ocopy(from.id_, name.c_str(), id_, as.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0, as);
}

void Node::write(const std::string& name, const std::vector<double>& data, int columns) {
  check_written(write_array(id_, where_, name, data, columns, storage_), name);
}
void Node::write(const std::string& name, const std::vector<std::int32_t>& data, int columns) {
  check_written(write_array(id_, where_, name, data, columns, storage_), name);
}
void Node::write(const std::string& name, const std::vector<std::int64_t>& data, int columns) {
  check_written(write_array(id_, where_, name, data, columns, storage_), name);
}
void Node::write(const std::string& name, const std::vector<std::uint8_t>& data, int columns) {
  check_written(write_array(id_, where_, name, data, columns, storage_), name);
}

std::vector<double> Node::doubles(const std::string& name, int columns) const {
  const Source source(id_, where_, name);
  const H5T_class_t type = H5Tget_class(source.type.get());
  if (type != H5T_FLOAT && type != H5T_INTEGER)
    throw DataError(fmt::format("{} holds {}; must hold numbers", source.what, type_in_words(source.type.get())));
  source.check_columns(columns);
  source.check_size();
  return read_as<double>(source);
}
std::vector<std::int32_t> Node::ints(const std::string& name, int columns) const {
  return read_integers<std::int32_t>(id_, where_, name, columns);
}
std::vector<std::int64_t> Node::longs(const std::string& name, int columns) const {
  return read_integers<std::int64_t>(id_, where_, name, columns);
}
std::vector<std::uint8_t> Node::bytes(const std::string& name, int columns) const {
  return read_integers<std::uint8_t>(id_, where_, name, columns);
}

int Node::columns(const std::string& name) const {
  const Source source(id_, where_, name);
  if (source.shape[1] < 1 || source.shape[1] > 1000)
    throw DataError(fmt::format("{} has {} columns; must have 1 to 1000", source.what, source.shape[1]));
  return static_cast<int>(source.shape[1]);
}

char Node::kind(const std::string& name) const {
  const Source source(id_, where_, name);
  if (H5Tget_class(source.type.get()) == H5T_FLOAT) return 'd';
  if (H5Tget_class(source.type.get()) != H5T_INTEGER)
    throw DataError(fmt::format("{} holds {}; must hold numbers", source.what, type_in_words(source.type.get())));
  const std::size_t bytes = H5Tget_size(source.type.get());
  return bytes == 1 ? 'b' : bytes <= 4 ? 'i' : 'l';
}

void Node::write_text(const std::string& name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), std::max<std::size_t>(value.size(), 1));
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  check_written(write_attribute(id_, where_, name, type.get(), type.get(), value.c_str()), name);
}
void Node::write_number(const std::string& name, double value) {
  check_written(write_attribute(id_, where_, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value), name);
}
void Node::write_integer(const std::string& name, std::int64_t value) {
  check_written(write_attribute(id_, where_, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value), name);
}

std::string Node::text(const std::string& name) const {
  const Value value(id_, where_, name);
  if (H5Tget_class(value.type.get()) != H5T_STRING) value.refuse("text");
  const Handle memory(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_cset(memory.get(), H5Tget_cset(value.type.get()));
  if (H5Tis_variable_str(value.type.get()) > 0) {  // h5py's way
    H5Tset_size(memory.get(), H5T_VARIABLE);
    char* text = nullptr;
    value.read(memory.get(), &text);
    const std::string copy = text ? text : "";
    H5free_memory(text);
    return copy;
  }
  const Handle file(H5Iget_file_id(id_), H5Fclose);
  hsize_t file_bytes = 0;
  H5Fget_filesize(file.get(), &file_bytes);
  const std::size_t bytes = H5Tget_size(value.type.get());
  if (bytes > file_bytes) throw DataError(value.place.what + " claims to be longer than its file");
  H5Tset_size(memory.get(), bytes);
  H5Tset_strpad(memory.get(), H5T_STR_NULLPAD);
  std::string text(bytes, '\0');
  value.read(memory.get(), text.data());
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

void Node::write_texts(const std::string& name, const std::vector<std::string>& lines) {
  std::string joined;
  for (const auto& line : lines) joined += (joined.empty() ? "" : "\n") + line;
  write_text(name, joined);
}

std::vector<std::string> Node::texts(const std::string& name) const {
  std::vector<std::string> lines;
  const std::string joined = text(name);
  for (std::size_t begin = 0; !joined.empty() && begin <= joined.size();) {
    const std::size_t end = std::min(joined.find('\n', begin), joined.size());
    lines.push_back(joined.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

double Node::number(const std::string& name) const {
  const Value value(id_, where_, name);
  const H5T_class_t type = H5Tget_class(value.type.get());
  if (type != H5T_FLOAT && type != H5T_INTEGER) value.refuse("a number");
  double number = 0;
  value.read(H5T_NATIVE_DOUBLE, &number);
  return number;
}

std::int64_t Node::integer(const std::string& name) const {
  const Value value(id_, where_, name);
  if (H5Tget_class(value.type.get()) != H5T_INTEGER) value.refuse("an integer");
  std::int64_t number = 0;
  value.read(H5T_NATIVE_INT64, &number);
  return number;
}

bool Node::has_attribute(const std::string& name) const { return Attribute(id_, where_, name).exists(); }

std::vector<std::string> Node::attributes() const {
  std::vector<std::string> found;
  const auto keep = [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (H5Aiterate2(id_, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep, &found) < 0)
    throw DataError(fmt::format("{}: attributes cannot be listed: the file is damaged ({})", where_, reason()));
  std::sort(found.begin(), found.end());
  return found;
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  return path.parent_path() / fmt::format(".{}.{}.tmp", path.filename().string(), ::getpid());
}

namespace {
bool flushes = true;
}

void leave_flushing_to_the_system() { flushes = false; }

void sync_folder(const std::filesystem::path& folder) {
  if (!flushes) return;
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

void replace_file(const std::filesystem::path& path, const std::function<void(Node&)>& fill, Storage storage) {
  const auto temporary = temporary_name(path);
  const auto check = [&](bool done) {
    if (!done) throw DataError(fmt::format("{} cannot be written: {}", path.string(), std::strerror(errno)));
  };
  try {
    Node file = Node::make(temporary, path, storage);
    fill(file);
    file.close();
    const int descriptor = ::open(temporary.c_str(), O_RDWR | O_CLOEXEC);
    check(descriptor >= 0);
    const int status = flushes ? ::fsync(descriptor) : 0;
    ::close(descriptor);
    check(status == 0);
    check(::rename(temporary.c_str(), path.c_str()) == 0);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_folder(path.parent_path());
}

}  // namespace lamella::h5
