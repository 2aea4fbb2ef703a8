// SPDX-License-Identifier: MIT
#include "io/result_reader.h"

#include <filesystem>
#include <fmt/core.h>
#include <system_error>

#include "core/error.h"
#include "io/hdf5_text.h"

namespace millstudy::io {
namespace {

using hdf5::Handle;

/// H5Aiterate callback: collects names; values are read afterwards, outside the C library.
herr_t collect_name(hid_t /*object*/, const char* name, const H5A_info_t* /*info*/, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

template <class T>
T read_number(hid_t attribute, hid_t type) {
  T value{};
  hdf5::check(H5Aread(attribute, type, &value), "read an attribute");
  return value;
}

void read_attribute(hid_t file, const std::string& name, ResultSummary& summary) {
  const Handle attribute(H5Aopen(file, name.c_str(), H5P_DEFAULT), "open an attribute");
  const Handle type(H5Aget_type(attribute.get()), "read a type");
  const Handle space(H5Aget_space(attribute.get()), "read a shape");
  if (H5Sget_simple_extent_npoints(space.get()) != 1) return;
  switch (H5Tget_class(type.get())) {
    case H5T_STRING:
      summary.attributes[name] = hdf5::read_text_attribute(attribute.get());
      break;
    case H5T_INTEGER:
      summary.attributes[name] = read_number<std::int64_t>(attribute.get(), H5T_NATIVE_INT64);
      break;
    case H5T_FLOAT:
      summary.attributes[name] = read_number<double>(attribute.get(), H5T_NATIVE_DOUBLE);
      break;
    default:
      break;
  }
}

template <class T>
std::optional<T> get(const ResultSummary& summary, const std::string& name) {
  const auto found = summary.attributes.find(name);
  if (found == summary.attributes.end()) return std::nullopt;
  const T* value = std::get_if<T>(&found->second);
  return value == nullptr ? std::nullopt : std::optional<T>(*value);
}

}  // namespace

std::optional<std::string> ResultSummary::text(const std::string& name) const {
  return get<std::string>(*this, name);
}

std::optional<std::int64_t> ResultSummary::integer(const std::string& name) const {
  return get<std::int64_t>(*this, name);
}

std::optional<double> ResultSummary::real(const std::string& name) const {
  return get<double>(*this, name);
}

std::optional<ResultSummary> read_result_summary(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return std::nullopt;
  if (!std::filesystem::is_regular_file(status)) {
    throw core::InputError({{core::Place{path, 0}, "is not a regular file"}});
  }
  const hdf5::QuietErrors quiet;
  try {
    const Handle file = hdf5::open_file_to_read(path);
    std::vector<std::string> names;
    hdf5::check(H5Aiterate2(file.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names),
                "list attributes");
    ResultSummary summary;
    for (const std::string& name : names) read_attribute(file.get(), name, summary);
    return summary;
  } catch (const hdf5::Error& failure) {
    throw core::InputError(
        {{core::Place{path, 0}, fmt::format("is no readable result file: {}", failure.what())}});
  }
}

}  // namespace millstudy::io
