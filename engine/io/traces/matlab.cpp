// SPDX-License-Identifier: MIT
// MATLAB files before version 7.3, by matio.
#include <algorithm>
#include <fmt/core.h>
#include <matio.h>
#include <memory>
#include <numeric>

#include "core/error.h"
#include "io/traces/contained.h"
#include "io/traces/format.h"
#include "io/traces/range.h"
#include "io/traces/variable_name.h"

namespace millstudy::io {
namespace {

constexpr const char* kName = "MATLAB 5";
constexpr std::size_t kMostNames = 1000;
// zlib makes at most 1032 bytes of one.
constexpr std::size_t kMostExpansion = 1100;

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

/// "MATLAB 5.0 MAT-file"; 7.3 is HDF5. Others write any text there: version and endian mark decide.
bool recognise(std::string_view bytes) {
  if (bytes.size() < 128) return false;
  const std::string_view version = bytes.substr(124, 4);
  using namespace std::string_view_literals;
  return version == "\x00\x01IM"sv || version == "\x01\x00MI"sv;
}

void no_log(int /*level*/, char* /*message*/) {}

File open_file(const Source& source) {
  Mat_LogInitFunc("millstudy", no_log);
  File file(Mat_Open(source.path.c_str(), MAT_ACC_RDONLY));
  if (!file) throw core::InputError({source.path, 0}, "is a damaged MATLAB file");
  return file;
}

std::vector<std::string> names_of(mat_t* file) {
  std::vector<std::string> names;
  Mat_Rewind(file);
  while (names.size() < kMostNames) {
    const Variable variable(Mat_VarReadNextInfo(file));
    if (!variable) break;
    if (variable->name != nullptr) names.emplace_back(variable->name);
  }
  return names;
}

bool is_real_number(const matvar_t& variable) {
  return variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64 &&
         variable.isComplex == 0;
}

template <class T>
std::vector<double> convert(const void* data, std::size_t begin, std::size_t count,
                            std::size_t stride) {
  std::vector<double> values(count);
  const T* from = static_cast<const T*>(data) + begin;
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<double>(from[i * stride]);
  return values;
}

std::vector<double> convert(const matvar_t& variable, std::size_t begin, std::size_t count,
                            std::size_t stride) {
  const void* const data = variable.data;
  switch (variable.class_type) {
    case MAT_C_SINGLE:
      return convert<float>(data, begin, count, stride);
    case MAT_C_INT8:
      return convert<std::int8_t>(data, begin, count, stride);
    case MAT_C_UINT8:
      return convert<std::uint8_t>(data, begin, count, stride);
    case MAT_C_INT16:
      return convert<std::int16_t>(data, begin, count, stride);
    case MAT_C_UINT16:
      return convert<std::uint16_t>(data, begin, count, stride);
    case MAT_C_INT32:
      return convert<std::int32_t>(data, begin, count, stride);
    case MAT_C_UINT32:
      return convert<std::uint32_t>(data, begin, count, stride);
    case MAT_C_INT64:
      return convert<std::int64_t>(data, begin, count, stride);
    case MAT_C_UINT64:
      return convert<std::uint64_t>(data, begin, count, stride);
    default:
      return convert<double>(data, begin, count, stride);
  }
}

/// Reads variables of one open file.
class Reader {
 public:
  explicit Reader(const Source& source) : source_(source), file_(open_file(source)) {}

  std::vector<double> read(const std::string& text) {
    const VariableName wanted = parse_variable(text);
    const std::size_t dot = wanted.name.find('.');
    const std::string base = wanted.name.substr(0, dot);
    const Variable owner(Mat_VarReadInfo(file_.get(), base.c_str()));
    if (!owner) fail_missing(base);
    matvar_t* variable = owner.get();
    for (std::size_t at = dot; at != std::string::npos;) {
      const std::size_t next = wanted.name.find('.', at + 1);
      variable = field(variable, wanted.name.substr(at + 1, next - at - 1), text);
      at = next;
    }
    return values(*variable, wanted, text);
  }

 private:
  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw core::InputError({source_.path, 0}, fmt::format("variable {} {}", name, what));
  }
  [[noreturn]] void fail_missing(const std::string& name) const {
    std::string list;
    for (const std::string& known : names_of(file_.get())) {
      if (list.size() < 200) list += (list.empty() ? "" : ", ") + known;
    }
    throw core::InputError({source_.path, 0},
                           fmt::format("has no variable {}; it has {}", name, list));
  }

  matvar_t* field(matvar_t* variable, const std::string& name, const std::string& text) const {
    if (variable->class_type != MAT_C_STRUCT) fail(text, "is no field: what it is of is no struct");
    matvar_t* const found = Mat_VarGetStructFieldByName(variable, name.c_str(), 0);
    if (found == nullptr) fail(text, fmt::format("is not there: no field {}", name));
    return found;
  }

  std::vector<double> values(matvar_t& variable, const VariableName& wanted,
                             const std::string& text) {
    if (!is_real_number(variable)) fail(text, "is no array of real numbers");
    std::size_t total = 1;
    for (int i = 0; i < variable.rank; ++i) {
      const std::size_t length = variable.dims[i];
      if (length != 0 && total > kMostTraceValues / length) {
        fail(text, fmt::format("has more than {} values", kMostTraceValues));
      }
      total *= length;
    }
    if (total / kMostExpansion > source_.bytes.size()) fail(text, "is damaged: it is too large");
    const std::size_t rows = variable.rank > 0 ? variable.dims[0] : 0;
    const std::size_t columns = rows == 0 ? 0 : total / rows;
    if (!wanted.slice && rows != 1 && columns != 1) {
      fail(text, fmt::format("is a {} x {} array: ask for {}(1,:) or {}(:,1)", rows, columns, text,
                             text));
    }
    if (Mat_VarReadDataAll(file_.get(), &variable) != 0 || variable.data == nullptr) {
      fail(text, "cannot be read: the file is damaged");
    }
    if (variable.nbytes / std::max<std::size_t>(total, 1) < Mat_SizeOfClass(variable.class_type)) {
      fail(text, "cannot be read: the file is damaged");
    }
    if (!wanted.slice) return convert(variable, 0, total, 1);
    const auto index = static_cast<std::size_t>(wanted.slice->index);
    const std::size_t limit = wanted.slice->column ? columns : rows;
    if (index >= limit)
      fail(text, fmt::format("is not there: the array is {} x {}", rows, columns));
    // Columns stand one after another.
    return wanted.slice->column ? convert(variable, index * rows, rows, 1)
                                : convert(variable, index, columns, rows);
  }

  const Source& source_;
  File file_;
};

TraceFile read_file(const Source& source, const TraceSelection& selection) {
  if (selection.variables.empty()) {
    throw core::InputError({source.path, 0},
                           "is a MATLAB file: say which of its variables are the channels");
  }
  Reader reader(source);
  TraceFile file{kName, {}};
  std::size_t left = kMostTraceValues;
  for (const auto& [name, variable] : selection.variables) {
    std::vector<double> values = reader.read(variable);
    if (values.size() > left) {
      throw core::InputError({source.path, 0}, fmt::format("more than {} values: read fewer "
                                                           "variables",
                                                           kMostTraceValues));
    }
    left -= values.size();
    cut_to_range(values, selection.range);
    if (name == "time") {
      file.channels.time = std::move(values);
    } else {
      file.channels.channels.push_back({name, "", std::move(values)});
    }
  }
  return file;
}

TraceFile read(const Source& source, const TraceSelection& selection) {
  return read_contained(source, [&] { return read_file(source, selection); });
}

std::vector<std::string> variables(const Source& source) {
  const TraceFile file = read_contained(source, [&] {
    TraceFile names;
    for (std::string& name : names_of(open_file(source).get())) {
      names.channels.channels.push_back({std::move(name), "", {}});
    }
    return names;
  });
  std::vector<std::string> names;
  for (const identify::Channel& channel : file.channels.channels) names.push_back(channel.name);
  return names;
}

}  // namespace

const TraceFormat kMatlab5 = {kName, recognise, read, variables};

}  // namespace millstudy::io
