// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <hdf5.h>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/row_major.h"

/// A thin layer over the HDF5 1.10 C API: identifiers that close themselves, errors that throw.
///
/// Debian's library takes calls of several threads one at a time, but for those about scales
/// (H5DS).
namespace millstudy::io::hdf5 {

/// The mask of a chunk that went past all filters.
constexpr std::uint32_t kAllFilters = ~std::uint32_t{0};

/// What the library said, innermost cause first.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// While it lives, the library does not print its errors to stderr.
class QuietErrors {
 public:
  QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors();

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Owns one identifier of any kind: file, dataset, dataspace, type, property list, attribute.
class Handle {
 public:
  Handle() = default;
  /// @throws Error if id is the library's sign of failure
  Handle(hid_t id, const char* doing);
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() { close(); }
  /// Errors of closing are lost here; flush first where they matter.
  void close() noexcept;
  hid_t get() const { return id_; }

 private:
  hid_t id_ = H5I_INVALID_HID;
};

/// The library's name of a C++ type in memory.
template <class T>
hid_t memory_type() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int8_t>) return H5T_NATIVE_INT8;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
}

/// Throws Error with the library's own text if the result of a call is negative.
template <class Result>
Result check(Result result, const char* doing);
[[noreturn]] void fail(const char* doing);

Handle open_file_to_read(const std::string& path);

struct DatasetOptions {
  Shape chunk = {};                           ///< empty: contiguous
  bool unlimited = false;                     ///< one dimension that grows from 0
  int gzip = 0;                               ///< level; with byte shuffle when > 0; chunked only
  std::optional<double> fill = std::nullopt;  ///< of elements that nobody writes; else 0
  bool fill_is_missing = false;  ///< told to readers as _FillValue: such elements have no value
  bool allocate = true;          ///< false: elements that nobody writes take no space
};

/// @param type   stored type, e.g. H5T_IEEE_F64LE
/// @param shape  empty for a scalar
Handle create_dataset(hid_t parent, const std::string& name, hid_t type, const Shape& shape,
                      const DatasetOptions& options = {});

/// Sets the lengths of the dimension of an unlimited dataset.
void extend(hid_t dataset, std::int64_t length);

Shape shape_of(hid_t dataset);
/// Of a chunk; empty if the dataset is not in chunks.
Shape chunk_of(hid_t dataset);

/// Writes elements begin .. begin + count - 1, counted in row-major order.
void write_range(hid_t dataset, hid_t memory_type, const Shape& shape, std::int64_t begin,
                 std::int64_t count, const void* data);
/// Stores the bytes of a whole chunk as they are.
/// @param start    of the chunk
/// @param skipped  filters that they have not gone through: 0, or kAllFilters
void write_chunk(hid_t dataset, const Shape& start, std::uint32_t skipped,
                 std::span<const std::byte> bytes);
void read_range(hid_t dataset, hid_t memory_type, const Shape& shape, std::int64_t begin,
                std::int64_t count, void* data);

/// Makes the dataset the scale of a dimension of that name, or attaches a scale to a dimension.
void make_scale(hid_t dataset, const std::string& name);
void attach_scale(hid_t dataset, hid_t scale, std::size_t dimension);

/// Text attributes are fixed-length UTF-8, which ncdump prints as text; numbers are little-endian
/// int64 and float64. An attribute of that name is replaced.
void write_attribute(hid_t object, const std::string& name, const std::string& text);
void write_attribute(hid_t object, const std::string& name, std::int64_t value);
void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, std::span<const std::int8_t> values);

template <class Result>
Result check(Result result, const char* doing) {
  if (result < 0) fail(doing);
  return result;
}

}  // namespace millstudy::io::hdf5
