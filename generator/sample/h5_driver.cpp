#include "generator/sample/h5_driver.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace lamella::h5 {
namespace {

/// What the access properties carry.
struct Settings {
  int* error;
};

/// What could not be written.
struct Patch {
  haddr_t begin;
  std::vector<char> bytes;
};

struct File {
  H5FD_t base{};  // the library's part, first
  int descriptor = -1;
  int* error = nullptr;
  haddr_t allocated = 0;  // end of what the library uses
  haddr_t end = 0;        // of the file
  std::vector<Patch> patches;
};

File& file_of(H5FD_t* base) { return *reinterpret_cast<File*>(base); }
const File& file_of(const H5FD_t* base) { return *reinterpret_cast<const File*>(base); }

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t) {
  const auto* settings = static_cast<const Settings*>(H5Pget_driver_info(access));
  if (!settings) return nullptr;
  int mode = (flags & H5F_ACC_RDWR) ? O_RDWR : O_RDONLY;
  if (flags & H5F_ACC_TRUNC) mode |= O_TRUNC;
  if (flags & H5F_ACC_CREAT) mode |= O_CREAT;
  if (flags & H5F_ACC_EXCL) mode |= O_EXCL;
  const int descriptor = ::open(name, mode | O_CLOEXEC, 0666);
  struct stat status {};
  if (descriptor < 0 || ::fstat(descriptor, &status) != 0) {
    *settings->error = errno;
    if (descriptor >= 0) ::close(descriptor);
    return nullptr;
  }
  *settings->error = 0;  // the library first tries to open what it is going to create
  auto* file = new File;
  file->descriptor = descriptor;
  file->error = settings->error;
  file->end = static_cast<haddr_t>(status.st_size);
  return &file->base;
}

void note_failure(File& file) {
  if (*file.error == 0) *file.error = errno;
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<File> file(&file_of(base));
  if (::close(file->descriptor) != 0) note_failure(*file);  // where a network's disk says that it is full
  return 0;
}

/// Two handles are the same file when they are the same object: a temporary file is opened once.
int compare(const H5FD_t* a, const H5FD_t* b) { return a == b ? 0 : a < b ? -1 : 1; }

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated_end(const H5FD_t* base, H5FD_mem_t) { return file_of(base).allocated; }
haddr_t file_end(const H5FD_t* base, H5FD_mem_t) { return file_of(base).end; }

herr_t set_allocated_end(H5FD_t* base, H5FD_mem_t, haddr_t end) {
  file_of(base).allocated = end;
  return 0;
}

herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t begin, size_t size, void* buffer) {
  const File& file = file_of(base);
  auto* bytes = static_cast<char*>(buffer);
  size_t done = 0;
  while (done < size) {
    const auto count = ::pread(file.descriptor, bytes + done, size - done, static_cast<off_t>(begin + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<size_t>(count);
  }
  std::memset(bytes + done, 0, size - done);
  for (const auto& patch : file.patches) {
    const haddr_t from = std::max(begin, patch.begin), to = std::min(begin + size, patch.begin + patch.bytes.size());
    if (from < to) std::memcpy(bytes + (from - begin), patch.bytes.data() + (from - patch.begin), to - from);
  }
  return 0;
}

herr_t write(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t begin, size_t size, const void* buffer) {
  File& file = file_of(base);
  const auto* bytes = static_cast<const char*>(buffer);
  size_t done = 0;
  while (done < size && *file.error == 0) {
    const auto count = ::pwrite(file.descriptor, bytes + done, size - done, static_cast<off_t>(begin + done));
    if (count < 0 && errno != EINTR) note_failure(file);
    if (count > 0) done += static_cast<size_t>(count);
  }
  if (done < size) file.patches.push_back({begin + done, {bytes + done, bytes + size}});
  file.end = std::max(file.end, begin + size);
  return 0;
}

herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
  File& file = file_of(base);
  if (file.end != file.allocated && *file.error == 0 &&
      ::ftruncate(file.descriptor, static_cast<off_t>(file.allocated)) != 0)
    note_failure(file);
  file.end = file.allocated;
  return 0;
}

hid_t register_driver() {
  static H5FD_class_t driver;  // zero: what is not set does not exist
  driver.name = "careful";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(Settings);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = allocated_end;
  driver.set_eoa = set_allocated_end;
  driver.get_eof = file_end;
  driver.read = read;
  driver.write = write;
  driver.truncate = truncate;
  for (auto& type : driver.fl_map) type = H5FD_MEM_DEFAULT;
  return H5FDregister(&driver);
}

}  // namespace

void set_careful_driver(hid_t access, int* error) {
  static const hid_t driver = register_driver();
  const Settings settings{error};
  H5Pset_driver(access, driver, &settings);
}

}  // namespace lamella::h5
