// SPDX-License-Identifier: MIT
#include "io/chunk_reader.h"

#include <memory>
#include <span>
#include <vector>
#include <zlib.h>

namespace millstudy::io {
namespace {

using hdf5::check;
using hdf5::Handle;

/// True if the filters of a variable are byte shuffle and gzip.
bool goes_through_shuffle_and_gzip(hid_t dataset) {
  const Handle creation(H5Dget_create_plist(dataset), "read the properties of a variable");
  if (H5Pget_nfilters(creation.get()) != 2) return false;
  const auto filter = [&](unsigned number) {
    unsigned flags = 0;
    std::size_t values = 0;
    return H5Pget_filter2(creation.get(), number, &flags, &values, nullptr, 0, nullptr, nullptr);
  };
  return filter(0) == H5Z_FILTER_SHUFFLE && filter(1) == H5Z_FILTER_DEFLATE;
}

/// Undoes byte shuffle: first the first bytes of all elements, then the second ones, ...
template <std::size_t size>
void unshuffle(const char* from, std::size_t elements, char* to) {
  for (std::size_t i = 0; i < elements; ++i) {
    for (std::size_t byte = 0; byte < size; ++byte) to[i * size + byte] = from[byte * elements + i];
  }
}

bool unshuffle(const char* from, std::size_t bytes, std::size_t size, char* to) {
  switch (size) {
    case 1:
      unshuffle<1>(from, bytes, to);
      return true;
    case 4:
      unshuffle<4>(from, bytes / 4, to);
      return true;
    case 8:
      unshuffle<8>(from, bytes / 8, to);
      return true;
    default:
      return false;
  }
}

/// What gzip packed; nothing but exactly so many bytes will do.
std::unique_ptr<char[]> unpack(std::span<const char> packed, std::size_t bytes) {
  auto unpacked = std::make_unique_for_overwrite<char[]>(bytes);
  uLongf length = bytes;
  const int result = ::uncompress(reinterpret_cast<Bytef*>(unpacked.get()), &length,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (result != Z_OK || length != bytes) throw hdf5::Error("a chunk cannot be unpacked");
  return unpacked;
}

}  // namespace

std::optional<ChunkReader> ChunkReader::of(hid_t dataset, hid_t memory_type, const Shape& shape) {
  const H5T_class_t kind = H5Tget_class(memory_type);  // texts hold addresses
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || shape.empty()) return {};
  const Handle type(H5Dget_type(dataset), "read a type");
  if (check(H5Tequal(type.get(), memory_type), "compare types") == 0) return {};
  if (hdf5::shape_of(dataset) != shape) return {};
  if (!goes_through_shuffle_and_gzip(dataset)) return {};
  Shape chunk = hdf5::chunk_of(dataset);
  if (chunk.empty() || !is_row_major(shape, chunk)) return {};
  return ChunkReader(dataset, shape, std::move(chunk), H5Tget_size(memory_type));
}

std::vector<hsize_t> ChunkReader::place_of(std::int64_t element) const {
  const Shape start = row_major_boxes(shape_, element, element + 1)[0].start;
  return {start.begin(), start.end()};
}

std::size_t ChunkReader::stored_bytes(const std::vector<hsize_t>& place) const {
  hsize_t stored = 0;
  if (H5Dget_chunk_storage_size(dataset_, place.data(), &stored) < 0) return 0;
  if (stored > 2 * bytes() + 64) throw hdf5::Error("a chunk is larger than what is in it");
  return stored;
}

bool ChunkReader::read_packed(std::int64_t element, PackedChunk& to) const {
  const std::vector<hsize_t> place = place_of(element);
  to.bytes.resize(stored_bytes(place));
  if (to.bytes.empty()) return false;
  check(H5Dread_chunk(dataset_, H5P_DEFAULT, place.data(), &to.skipped, to.bytes.data()),
        "read a variable");
  if (to.skipped == hdf5::kAllFilters && to.bytes.size() != bytes())
    throw hdf5::Error("a chunk has not the size of what is in it");
  return to.skipped == hdf5::kAllFilters || to.skipped == 0;
}

bool ChunkReader::read(std::int64_t element, char* to) const {
  const std::vector<hsize_t> place = place_of(element);
  const std::size_t bytes = this->bytes();
  // Both look for the chunk in the same way, so that it has the size that there is room for.
  const std::size_t stored = stored_bytes(place);
  if (stored == 0) return false;
  std::vector<char> packed(stored == bytes ? 0 : stored);
  std::uint32_t skipped = 0;
  check(H5Dread_chunk(dataset_, H5P_DEFAULT, place.data(), &skipped,
                      packed.empty() ? to : packed.data()),
        "read a variable");
  if (skipped == hdf5::kAllFilters) {
    if (!packed.empty()) throw hdf5::Error("a chunk has not the size of what is in it");
    return true;
  }
  if (packed.empty() || skipped != 0) return false;
  return unshuffle(unpack(packed, bytes).get(), bytes, size_, to);
}

}  // namespace millstudy::io
