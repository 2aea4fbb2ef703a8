// SPDX-License-Identifier: MIT
#include "io/hdf5_text.h"

#include <algorithm>
#include <cstring>

namespace millstudy::io::hdf5 {
namespace {

constexpr std::size_t kLongestText = 64u << 20;
constexpr std::int64_t kPiece = 1 << 14;  // texts written or read at once

Handle variable_text_type() {
  Handle type(H5Tcopy(H5T_C_S1), "make a text type");
  check(H5Tset_size(type.get(), H5T_VARIABLE), "size a text type");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "encode a text type");
  return type;
}

/// The stored bytes of count texts of a fixed size, each cut at its first NUL.
std::vector<std::string> split(const std::string& bytes, std::size_t size, std::size_t count) {
  std::vector<std::string> texts(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* text = bytes.data() + i * size;
    texts[i].assign(text, strnlen(text, size));
  }
  return texts;
}

/// Reads texts through transfer(memory type, buffer), whatever their stored form.
template <class Transfer>
std::vector<std::string> read(hid_t stored, hid_t space, std::size_t count,
                              const Transfer& transfer) {
  if (H5Tget_class(stored) != H5T_STRING) throw Error("a text is stored as something else");
  if (check(H5Tis_variable_str(stored), "read a text type") == 0) {
    const std::size_t size = H5Tget_size(stored);
    if (size == 0 || size > kLongestText / std::max<std::size_t>(count, 1)) {
      throw Error("a text is larger than 64 MiB");
    }
    std::string bytes(size * count, '\0');
    transfer(stored, bytes.data());
    return split(bytes, size, count);
  }
  // The character set asked for must be the stored one: HDF5 does not convert.
  const Handle type(H5Tcopy(stored), "copy a text type");
  std::vector<char*> pointers(count, nullptr);
  transfer(type.get(), pointers.data());
  std::vector<std::string> texts;
  texts.reserve(count);
  for (const char* text : pointers) texts.emplace_back(text == nullptr ? "" : text);
  H5Dvlen_reclaim(type.get(), space, H5P_DEFAULT, pointers.data());
  return texts;
}

}  // namespace

Handle create_texts(hid_t parent, const std::string& name, std::span<const std::string> texts) {
  const Handle type = variable_text_type();
  const Shape shape = {static_cast<std::int64_t>(texts.size())};
  Handle dataset = create_dataset(parent, name, type.get(), shape);
  for (std::int64_t begin = 0; begin < shape[0]; begin += kPiece) {
    const std::int64_t count = std::min(kPiece, shape[0] - begin);
    std::vector<const char*> pointers;
    for (std::int64_t i = begin; i < begin + count; ++i) pointers.push_back(texts[i].c_str());
    write_range(dataset.get(), type.get(), shape, begin, count, pointers.data());
  }
  return dataset;
}

std::vector<std::string> read_texts(hid_t dataset, const Shape& shape, std::int64_t begin,
                                    std::int64_t count) {
  const Handle stored(H5Dget_type(dataset), "read a type");
  const auto elements = static_cast<hsize_t>(count);
  const Handle space(H5Screate_simple(1, &elements, nullptr), "make a dataspace");
  return read(
      stored.get(), space.get(), static_cast<std::size_t>(count),
      [&](hid_t type, void* buffer) { read_range(dataset, type, shape, begin, count, buffer); });
}

std::string read_text_attribute(hid_t attribute) {
  const Handle stored(H5Aget_type(attribute), "read a type");
  const Handle space(H5Aget_space(attribute), "read a shape");
  if (H5Sget_simple_extent_npoints(space.get()) != 1) throw Error("a text is stored as a list");
  return read(stored.get(), space.get(), 1,
              [&](hid_t type, void* buffer) {
                check(H5Aread(attribute, type, buffer), "read an attribute");
              })
      .front();
}

}  // namespace millstudy::io::hdf5
