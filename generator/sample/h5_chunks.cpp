#include "generator/sample/h5_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <new>
#include <vector>

#include "generator/sample/parallel.h"

namespace lamella::h5 {
namespace {

constexpr int kLevel = 1;           // of deflate: the fastest
constexpr std::size_t kBatch = 32;  // chunks that are compressed before they are written

static_assert(std::endian::native == std::endian::little, "arrays go to the disk as they are in memory");

using Bytes = std::vector<unsigned char>;

/// HDF5's shuffle: the first bytes of all values, then the second ones, and so on.
void shuffle(const unsigned char* values, std::size_t count, std::size_t value_bytes, unsigned char* shuffled) {
  for (std::size_t b = 0; b < value_bytes; ++b)
    for (std::size_t k = 0; k < count; ++k) shuffled[b * count + k] = values[k * value_bytes + b];
}

/// A chunk at the end of the array is as long as all, filled up with zeros.
Bytes compressed(const Rows& rows, std::size_t begin, std::size_t chunk_rows) {
  const std::size_t bytes = chunk_rows * rows.row_bytes;
  const std::size_t used = std::min(chunk_rows, rows.count - begin) * rows.row_bytes;
  const auto* data = static_cast<const unsigned char*>(rows.data) + begin * rows.row_bytes;
  Bytes whole(data, data + used), shuffled(bytes);
  whole.resize(bytes, 0);
  shuffle(whole.data(), bytes / rows.value_bytes, rows.value_bytes, shuffled.data());
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  Bytes chunk(libdeflate_zlib_compress_bound(compressor.get(), bytes));
  chunk.resize(libdeflate_zlib_compress(compressor.get(), shuffled.data(), bytes, chunk.data(), chunk.size()));
  return chunk;
}

}  // namespace

void set_chunks(hid_t creation, std::size_t chunk_rows, std::size_t columns, int rank) {
  const std::array<hsize_t, 2> chunk{chunk_rows, columns};
  H5Pset_chunk(creation, rank, chunk.data());
  H5Pset_shuffle(creation);
  H5Pset_deflate(creation, kLevel);
}

bool write_chunks(hid_t array, const Rows& rows, std::size_t chunk_rows) {
  const std::size_t chunks = (rows.count + chunk_rows - 1) / chunk_rows;
  for (std::size_t done = 0; done < chunks; done += kBatch) {
    std::vector<Bytes> batch(std::min(kBatch, chunks - done));
    for_pieces(batch.size(), 1,
               [&](std::size_t k, std::size_t) { batch[k] = compressed(rows, (done + k) * chunk_rows, chunk_rows); });
    for (std::size_t k = 0; k < batch.size(); ++k) {
      const std::array<hsize_t, 2> offset{(done + k) * chunk_rows, 0};
      if (H5Dwrite_chunk(array, H5P_DEFAULT, 0, offset.data(), batch[k].size(), batch[k].data()) < 0) return false;
    }
  }
  return true;
}

}  // namespace lamella::h5
