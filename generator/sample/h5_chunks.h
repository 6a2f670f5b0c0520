// Chunks of an array that is compressed: the library compresses on one thread, this does on all that are in use.
#pragma once
#include <hdf5.h>

#include <cstddef>

namespace lamella::h5 {

/// Rows of a two- or one-dimensional array in the machine's memory, as they go to the disk.
struct Rows {
  const void* data;
  std::size_t count, row_bytes, value_bytes;
};

/// Shuffled and deflated chunks of at most so many rows.
void set_chunks(hid_t creation, std::size_t chunk_rows, std::size_t columns, int rank);

/// Writes all rows of an array that was created so, `chunk_rows` at a time. What stands in the file is what the
/// library's own filters would read. False when the library or the disk refuses.
bool write_chunks(hid_t array, const Rows& rows, std::size_t chunk_rows);

}  // namespace lamella::h5
