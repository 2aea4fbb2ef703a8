// SPDX-License-Identifier: MIT
#include "io/point_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <sstream>

#include "core/error.h"
#include "io/hdf5_text.h"

namespace millstudy::io {
namespace {

using hdf5::Handle;
using Kind = PointColumn::Kind;

constexpr std::int64_t kMostPoints = std::int64_t{1} << 40;
constexpr std::int64_t kMostReasons = 1 << 20;
constexpr std::array<const char*, 4> kStatusWords = {"ok", "failed", "skipped", "not_run"};

Handle open(hid_t file, const std::string& name) {
  return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), "open a variable"};
}

std::string text_attribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Handle attribute(H5Aopen(object, name, H5P_DEFAULT), "open an attribute");
  return hdf5::read_text_attribute(attribute.get());
}

/// Name of an object in its file, without the leading slash.
std::string name_of(hid_t object) {
  std::array<char, 1024> name{};
  H5Iget_name(object, name.data(), name.size());
  return name[0] == '/' ? name.data() + 1 : name.data();
}

/// Where in the file the first scale of each dimension is, if there is one. Read from the attribute
/// of the specification of dimension scales at once: the library's functions open every scale.
std::vector<haddr_t> scales_of(hid_t dataset, std::size_t rank) {
  constexpr const char* kName = "DIMENSION_LIST";
  std::vector<haddr_t> scales(rank, HADDR_UNDEF);
  if (rank == 0 || H5Aexists(dataset, kName) <= 0) return scales;
  const Handle attribute(H5Aopen(dataset, kName, H5P_DEFAULT), "open an attribute");
  const Handle space(H5Aget_space(attribute.get()), "read a shape");
  const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), "make a type");
  if (H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(rank)) return scales;
  std::vector<hvl_t> lists(rank);
  hdf5::check(H5Aread(attribute.get(), type.get(), lists.data()), "read dimensions");
  for (std::size_t d = 0; d < rank; ++d) {
    if (lists[d].len > 0) std::memcpy(&scales[d], lists[d].p, sizeof(hobj_ref_t));
  }
  H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, lists.data());
  return scales;
}

herr_t collect_name(hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Names in a file in the order they were made, where the file knows it.
std::vector<std::string> names_in(hid_t file) {
  std::vector<std::string> names;
  if (H5Literate(file, H5_INDEX_CRT_ORDER, H5_ITER_INC, nullptr, collect_name, &names) >= 0) {
    return names;
  }
  names.clear();
  hdf5::check(H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names),
              "list variables");
  return names;
}

bool is_dataset(hid_t file, const std::string& name) {
  H5O_info_t info;
  return H5Oget_info_by_name2(file, name.c_str(), &info, H5O_INFO_BASIC, H5P_DEFAULT) >= 0 &&
         info.type == H5O_TYPE_DATASET;
}

H5T_class_t class_of(hid_t dataset) {
  const Handle type(H5Dget_type(dataset), "read a type");
  return H5Tget_class(type.get());
}

PointColumn make_column(Handle dataset, const std::string& name) {
  PointColumn column;
  column.name = name;
  column.units = text_attribute(dataset.get(), "units");
  column.long_name = text_attribute(dataset.get(), "long_name");
  column.study_key = text_attribute(dataset.get(), "study_key");
  column.kind = class_of(dataset.get()) == H5T_STRING ? Kind::text : Kind::number;
  column.dataset = std::move(dataset);
  return column;
}

Cells read_cells(hid_t dataset, Kind kind, const Shape& shape, std::int64_t begin,
                 std::int64_t count) {
  if (kind == Kind::text) return hdf5::read_texts(dataset, shape, begin, count);
  std::vector<double> values(static_cast<std::size_t>(count));
  hdf5::read_range(dataset, H5T_NATIVE_DOUBLE, shape, begin, count, values.data());
  return values;
}

/// texts[number], if there is one.
template <class Texts>
std::string word(double number, const Texts& texts) {
  const bool known = number >= 0.0 && number < static_cast<double>(texts.size());
  return known ? std::string(texts[static_cast<std::size_t>(number)]) : "unknown";
}

template <class Texts>
std::vector<std::string> words(const Cells& cells, const Texts& texts) {
  std::vector<std::string> result;
  for (const double number : std::get<std::vector<double>>(cells)) {
    result.push_back(word(number, texts));
  }
  return result;
}

}  // namespace

PointTable::PointTable(const std::string& path) : path_(path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw core::InputError({path, 0}, "is no file that can be read");
  file_ = hdf5::open_file_to_read(path);
  if (!is_dataset(file_.get(), "status"))
    throw core::InputError({path, 0}, "is no result of a study: it has no status");
  const Handle status = open(file_.get(), "status");
  shape_ = hdf5::shape_of(status.get());
  if (Shape chunk = hdf5::chunk_of(status.get()); is_row_major(shape_, chunk)) chunk_ = chunk;
  scales_ = scales_of(status.get(), shape_.size());
  for (const haddr_t scale : scales_) {
    if (scale == HADDR_UNDEF)
      throw core::InputError({path, 0}, "has a dimension without a coordinate");
    const Handle object(H5Oopen_by_addr(file_.get(), scale), "open a dimension");
    dimensions_.push_back(name_of(object.get()));
  }
  for (const std::int64_t length : shape_) {
    if (length <= 0 || points_ > kMostPoints / length)
      throw core::InputError({path, 0}, "has an impossible shape");
    points_ *= length;
  }
  add_coordinates();
  add_variables();
}

void PointTable::add_coordinates() {
  std::int64_t stride = points_;
  for (std::size_t d = 0; d < shape_.size(); ++d) {
    stride /= shape_[d];
    PointColumn column = make_column(open(file_.get(), dimensions_[d]), dimensions_[d]);
    const Shape shape = hdf5::shape_of(column.dataset.get());
    if (shape != Shape{shape_[d]})
      throw core::InputError({path_, 0}, "has a coordinate of the wrong length");
    if (shape_.size() > 1 || shape_[d] < (1 << 16)) {
      column.values = read_cells(column.dataset.get(), column.kind, shape, 0, shape[0]);
      column.stride = stride;
    }
    columns_.push_back(std::move(column));
  }
  std::istringstream names(text_attribute(open(file_.get(), "status").get(), "coordinates"));
  for (std::string name; names >> name;) {
    Handle dataset = open(file_.get(), name);
    if (hdf5::shape_of(dataset.get()) != shape_)
      throw core::InputError({path_, 0}, "has an odd coordinate " + name);
    columns_.push_back(make_column(std::move(dataset), name));
  }
}

void PointTable::add_variables() {
  const auto known = [&](const std::string& name) {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const PointColumn& column) { return column.name == name; });
  };
  for (const std::string& name : names_in(file_.get())) {
    if (name == "status" || name == "failure_code" || known(name)) continue;
    if (name.starts_with("trace_") || !is_dataset(file_.get(), name)) continue;
    Handle dataset = open(file_.get(), name);
    const H5T_class_t type = class_of(dataset.get());
    if (type != H5T_FLOAT && type != H5T_INTEGER) continue;
    if (hdf5::shape_of(dataset.get()) != shape_) continue;
    // A scale has no scales itself.
    if (scales_of(dataset.get(), shape_.size()) != scales_) continue;
    columns_.push_back(make_column(std::move(dataset), name));
  }
  columns_.push_back(make_column(open(file_.get(), "status"), "status"));
  columns_.back().kind = Kind::status;
  if (!is_dataset(file_.get(), "failure_code") || !is_dataset(file_.get(), "failure")) return;
  Handle codes = open(file_.get(), "failure_code");
  const Handle table = open(file_.get(), "failure");
  const Shape length = hdf5::shape_of(table.get());
  if (hdf5::shape_of(codes.get()) != shape_ || length.size() != 1 || length[0] > kMostReasons) {
    throw core::InputError({path_, 0}, "has a damaged table of failures");
  }
  reasons_ = hdf5::read_texts(table.get(), length, 0, length[0]);
  if (!reasons_.empty()) reasons_[0].clear();
  columns_.push_back(make_column(std::move(codes), "failure"));
  columns_.back().kind = Kind::failure;
}

Handle PointTable::other(const std::string& name) const {
  return open(file_.get(), name);
}

void PointTable::read_numbers(const PointColumn& column, std::int64_t begin,
                              std::span<double> to) const {
  const hid_t dataset = column.dataset.get();
  const auto count = static_cast<std::int64_t>(to.size());
  const auto read = [&](auto* values) {
    const hid_t type = hdf5::memory_type<std::remove_pointer_t<decltype(values)>>();
    hdf5::read_range(dataset, type, shape_, begin, count, values);
  };
  const Handle type(H5Dget_type(dataset), "read a type");
  // As they are stored, integers go past the library.
  const auto read_as = [&]<class Stored>(std::vector<Stored> stored) {
    read(stored.data());
    std::copy(stored.begin(), stored.end(), to.begin());
  };
  if (H5Tequal(type.get(), H5T_NATIVE_INT8) > 0) {
    read_as(std::vector<std::int8_t>(to.size()));
  } else if (H5Tequal(type.get(), H5T_NATIVE_INT32) > 0) {
    read_as(std::vector<std::int32_t>(to.size()));
  } else {
    read(to.data());
  }
}

std::string PointTable::reason(double code) const {
  return word(code, reasons_);
}

Cells PointTable::read(const PointColumn& column, std::int64_t begin, std::int64_t count) const {
  if (column.stride > 0) {
    return std::visit(
        [&](const auto& values) -> Cells {
          std::decay_t<decltype(values)> cells;
          const auto length = static_cast<std::int64_t>(values.size());
          for (std::int64_t i = begin; i < begin + count; ++i) {
            cells.push_back(values[static_cast<std::size_t>(i / column.stride % length)]);
          }
          return cells;
        },
        column.values);
  }
  const Kind stored = column.kind == Kind::text ? Kind::text : Kind::number;
  Cells cells = read_cells(column.dataset.get(), stored, shape_, begin, count);
  if (column.kind == Kind::status) return words(cells, kStatusWords);
  if (column.kind == Kind::failure) return words(cells, reasons_);
  return cells;
}

}  // namespace millstudy::io
