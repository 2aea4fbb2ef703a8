// SPDX-License-Identifier: MIT
#include "io/hdf5.h"

#include <algorithm>
#include <array>
#include <hdf5_hl.h>

#include "io/chunk_reader.h"

namespace millstudy::io::hdf5 {
namespace {

std::vector<hsize_t> sizes(std::span<const std::int64_t> shape) {
  return {shape.begin(), shape.end()};
}

Handle space_of(const Shape& shape, bool unlimited = false) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), "make a scalar"};
  const std::vector<hsize_t> lengths = sizes(shape);
  std::vector<hsize_t> most = lengths;
  if (unlimited) most.front() = H5S_UNLIMITED;
  return {H5Screate_simple(static_cast<int>(lengths.size()), lengths.data(), most.data()),
          "make a dataspace"};
}

/// H5Ewalk callback: keeps the description of the innermost cause.
herr_t keep_first(unsigned /*depth*/, const H5E_error2_t* error, void* text) {
  auto& kept = *static_cast<std::string*>(text);
  if (kept.empty() && error->desc != nullptr) kept = error->desc;
  return 0;
}

void write_attribute_data(hid_t object, const std::string& name, hid_t stored, hid_t memory,
                          const Shape& shape, const void* data) {
  if (check(H5Aexists(object, name.c_str()), "look for an attribute") > 0) {
    check(H5Adelete(object, name.c_str()), "replace an attribute");
  }
  const Handle space = space_of(shape);
  const Handle attribute(
      H5Acreate2(object, name.c_str(), stored, space.get(), H5P_DEFAULT, H5P_DEFAULT),
      "create an attribute");
  check(H5Awrite(attribute.get(), memory, data), "write an attribute");
}

/// Calls transfer(memory space, file space, offset of the data in elements) for every box.
template <class Transfer>
void for_boxes(hid_t dataset, const Shape& shape, std::int64_t begin, std::int64_t count,
               const Transfer& transfer) {
  const Handle file_space(H5Dget_space(dataset), "open a dataspace");
  if (H5Sget_simple_extent_ndims(file_space.get()) != static_cast<int>(shape.size())) {
    throw Error("HDF5 cannot select elements: a variable has another number of dimensions");
  }
  std::int64_t offset = 0;
  for (const Box& box : row_major_boxes(shape, begin, begin + count)) {
    if (!shape.empty()) {
      const std::vector<hsize_t> start = sizes(box.start);
      const std::vector<hsize_t> lengths = sizes(box.count);
      check(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr,
                                lengths.data(), nullptr),
            "select elements");
    }
    // Of the same shape: between a line and a box the library goes element by element.
    const Handle memory_space = space_of(box.count);
    transfer(memory_space.get(), file_space.get(), offset);
    offset += element_count(box.count);
  }
}

}  // namespace

QuietErrors::QuietErrors() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

Handle::Handle(hid_t id, const char* doing) : id_(check(id, doing)) {}

void Handle::close() noexcept {
  if (id_ >= 0) H5Idec_ref(std::exchange(id_, H5I_INVALID_HID));
}

void fail(const char* doing) {
  std::string cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &cause);
  H5Eclear2(H5E_DEFAULT);
  throw Error("HDF5 cannot " + std::string(doing) + (cause.empty() ? "" : ": " + cause));
}

Handle open_file_to_read(const std::string& path) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), "make a property list");
  check(H5Pset_file_locking(access.get(), false, true), "leave locking to us");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), "open the file"};
}

Handle create_dataset(hid_t parent, const std::string& name, hid_t type, const Shape& shape,
                      const DatasetOptions& options) {
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), "make a property list");
  const hid_t id = creation.get();
  check(H5Pset_attr_creation_order(id, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
        "track the order of attributes");
  check(H5Pset_obj_track_times(id, false), "leave out times");  // same study, same bytes
  if (!options.chunk.empty() && !shape.empty()) {
    check(H5Pset_chunk(id, static_cast<int>(shape.size()), sizes(options.chunk).data()),
          "set a chunk shape");
    if (options.gzip > 0) {
      check(H5Pset_shuffle(id), "set the shuffle filter");
      check(H5Pset_deflate(id, static_cast<unsigned>(options.gzip)), "set the gzip filter");
    }
  }
  if (options.fill) {
    check(H5Pset_fill_value(id, H5T_NATIVE_DOUBLE, &*options.fill), "set a fill value");
  }
  if (!options.allocate) check(H5Pset_fill_time(id, H5D_FILL_TIME_NEVER), "set the fill time");
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), "make a property list");
  if (!options.chunk.empty()) {
    // Chunks are written whole and once: a cache would only hold the last one of every variable.
    check(H5Pset_chunk_cache(access.get(), 1, 0, 1.0), "set the chunk cache");
  }
  const Handle space = space_of(shape, options.unlimited);
  Handle dataset(H5Dcreate2(parent, name.c_str(), type, space.get(), H5P_DEFAULT, id, access.get()),
                 "create a variable");
  if (options.fill && options.fill_is_missing) {
    write_attribute_data(dataset.get(), "_FillValue", type, H5T_NATIVE_DOUBLE, {1}, &*options.fill);
  }
  return dataset;
}

void extend(hid_t dataset, std::int64_t length) {
  const auto lengths = static_cast<hsize_t>(length);
  check(H5Dset_extent(dataset, &lengths), "extend a variable");
}

Shape shape_of(hid_t dataset) {
  const Handle space(H5Dget_space(dataset), "open a dataspace");
  std::vector<hsize_t> lengths(
      static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space.get()), "read a shape")));
  check(H5Sget_simple_extent_dims(space.get(), lengths.data(), nullptr), "read a shape");
  return {lengths.begin(), lengths.end()};
}

Shape chunk_of(hid_t dataset) {
  const Handle creation(H5Dget_create_plist(dataset), "read the properties of a variable");
  if (H5Pget_layout(creation.get()) != H5D_CHUNKED) return {};
  std::array<hsize_t, H5S_MAX_RANK> lengths{};
  const int rank =
      check(H5Pget_chunk(creation.get(), H5S_MAX_RANK, lengths.data()), "read a chunk");
  return {lengths.begin(), lengths.begin() + rank};
}

void write_range(hid_t dataset, hid_t memory_type, const Shape& shape, std::int64_t begin,
                 std::int64_t count, const void* data) {
  const std::size_t size = H5Tget_size(memory_type);
  for_boxes(dataset, shape, begin, count, [&](hid_t memory, hid_t file, std::int64_t offset) {
    const char* at = static_cast<const char*>(data) + static_cast<std::size_t>(offset) * size;
    check(H5Dwrite(dataset, memory_type, memory, file, H5P_DEFAULT, at), "write a variable");
  });
}

void write_chunk(hid_t dataset, const Shape& start, std::uint32_t skipped,
                 std::span<const std::byte> bytes) {
  check(H5Dwrite_chunk(dataset, H5P_DEFAULT, skipped, sizes(start).data(), bytes.size(),
                       bytes.data()),
        "write a variable");
}

void read_range(hid_t dataset, hid_t memory_type, const Shape& shape, std::int64_t begin,
                std::int64_t count, void* data) {
  const std::size_t size = H5Tget_size(memory_type);
  const auto at = [&](std::int64_t element) {
    return static_cast<char*>(data) + static_cast<std::size_t>(element - begin) * size;
  };
  const auto read = [&](std::int64_t from, std::int64_t to) {
    for_boxes(dataset, shape, from, to - from, [&](hid_t memory, hid_t file, std::int64_t offset) {
      check(H5Dread(dataset, memory_type, memory, file, H5P_DEFAULT, at(from + offset)),
            "read a variable");
    });
  };
  const std::optional<ChunkReader> chunks = ChunkReader::of(dataset, memory_type, shape);
  std::vector<char> other;
  const auto read_chunk = [&](std::int64_t from, std::int64_t to, std::int64_t chunk_begin) {
    const std::int64_t whole = chunks->elements();
    if (to - from == whole) return chunks->read(chunk_begin, at(from));
    if (2 * (to - from) < whole) return false;  // the library's cache helps who reads bit by bit
    other.resize(static_cast<std::size_t>(whole) * size);
    if (!chunks->read(chunk_begin, other.data())) return false;
    std::copy_n(other.data() + static_cast<std::size_t>(from - chunk_begin) * size,
                static_cast<std::size_t>(to - from) * size, at(from));
    return true;
  };
  std::int64_t todo = begin;  // read with the next box
  for (std::int64_t from = begin, to = begin; chunks && from < begin + count; from = to) {
    const Run chunk = chunks->around(from);
    to = std::min(begin + count, chunk.end);
    if (!read_chunk(from, to, chunk.begin)) continue;
    if (todo < from) read(todo, from);
    todo = to;
  }
  if (todo < begin + count) read(todo, begin + count);
}

void make_scale(hid_t dataset, const std::string& name) {
  check(H5DSset_scale(dataset, name.c_str()), "make a dimension scale");
}

void attach_scale(hid_t dataset, hid_t scale, std::size_t dimension) {
  check(H5DSattach_scale(dataset, scale, static_cast<unsigned>(dimension)),
        "attach a dimension scale");
}

void write_attribute(hid_t object, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), "make a text type");
  check(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), "size a text type");
  check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), "pad a text type");
  check(H5Tset_cset(type.get(), H5T_CSET_UTF8), "encode a text type");
  write_attribute_data(object, name, type.get(), type.get(), {}, text.c_str());
}

void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  write_attribute_data(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, {}, &value);
}

void write_attribute(hid_t object, const std::string& name, double value) {
  write_attribute_data(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, {}, &value);
}

void write_attribute(hid_t object, const std::string& name, std::span<const std::int8_t> values) {
  write_attribute_data(object, name, H5T_STD_I8LE, H5T_NATIVE_INT8,
                       {static_cast<std::int64_t>(values.size())}, values.data());
}

}  // namespace millstudy::io::hdf5
