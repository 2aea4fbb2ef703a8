// SPDX-License-Identifier: MIT
// Datasets of HDF5 files: results with time histories, MATLAB 7.3 files, any others.
#include <algorithm>
#include <fmt/core.h>

#include "core/error.h"
#include "io/hdf5.h"
#include "io/traces/contained.h"
#include "io/traces/format.h"
#include "io/traces/variable_name.h"

namespace millstudy::io {
namespace {

constexpr const char* kName = "HDF5";
constexpr std::size_t kMostNames = 1000;
constexpr std::size_t kLongestText = 64;

/// The signature stands at byte 0, or after a block of 512, 1024, ... bytes of the user's.
bool recognise(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr auto kSignature = "\x89HDF\r\n\x1a\n"sv;
  for (std::size_t at = 0; at < bytes.size(); at = at == 0 ? 512 : 2 * at) {
    if (bytes.substr(at).starts_with(kSignature)) return true;
  }
  return false;
}

/// H5Ovisit callback: collects the names of datasets.
herr_t collect(hid_t /*object*/, const char* name, const H5O_info_t* info, void* to) {
  auto& names = *static_cast<std::vector<std::string>*>(to);
  if (info->type == H5O_TYPE_DATASET) names.emplace_back(name);
  return names.size() < kMostNames ? 0 : 1;
}

std::vector<std::string> names_of(hid_t file) {
  std::vector<std::string> names;
  hdf5::check(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_NATIVE, collect, &names, H5O_INFO_BASIC),
              "list the datasets");
  return names;
}

/// Where in a dataset the samples are: a run along one dimension.
struct Run {
  std::size_t dimension = 0;
  std::vector<hsize_t> start;
  std::int64_t count = 0;
};

/// Reads datasets of one open file.
class Reader {
 public:
  Reader(const Source& source, const TraceSelection& selection)
      : source_(source),
        selection_(selection),
        file_(hdf5::open_file_to_read(source.path)),
        ragged_(exists("trace_start") && exists("trace_count")) {}

  identify::Channel read(const std::string& name, const std::string& text, std::size_t most) {
    const VariableName wanted = parse_variable(text);
    const hdf5::Handle dataset = open_dataset(wanted.name);
    check_numbers(dataset.get(), text);
    const Run run = find_run(dataset.get(), wanted, text);
    if (static_cast<std::uint64_t>(run.count) > most) {
      fail(fmt::format("more than {} values: read fewer variables, or a part of them",
                       kMostTraceValues));
    }
    return {name, unit_of(dataset.get()), read_run(dataset.get(), run)};
  }

  bool exists(const std::string& path) const {
    const hdf5::QuietErrors quiet;
    const hid_t object = H5Oopen(file_.get(), path.c_str(), H5P_DEFAULT);
    if (object < 0) return false;
    H5Oclose(object);
    return true;
  }
  bool ragged() const { return ragged_; }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw core::InputError({source_.path, 0}, what);
  }

  /// The path as it is, or the fields of a MATLAB struct, "a.b".
  hdf5::Handle open_dataset(const std::string& name) const {
    std::string path = name;
    if (!exists(path)) std::replace(path.begin(), path.end(), '.', '/');
    if (!exists(path)) {
      std::string list;
      for (const std::string& known : names_of(file_.get())) {
        if (list.size() < 200) list += (list.empty() ? "" : ", ") + known;
      }
      fail(fmt::format("has no dataset {}; it has {}", name, list));
    }
    const hdf5::QuietErrors quiet;
    const hid_t dataset = H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT);
    if (dataset < 0) fail(fmt::format("{} is no dataset", name));
    return {dataset, "open a dataset"};
  }

  void check_numbers(hid_t dataset, const std::string& text) const {
    const hdf5::Handle type(H5Dget_type(dataset), "open a type");
    const H5T_class_t kind = H5Tget_class(type.get());
    // MATLAB keeps texts as whole numbers, and the shape of what is empty in place of its values.
    if ((kind != H5T_INTEGER && kind != H5T_FLOAT) || text_of(dataset, "MATLAB_class") == "char") {
      fail(fmt::format("{} holds no numbers", text));
    }
    if (H5Aexists(dataset, "MATLAB_empty") > 0) fail(fmt::format("{} is empty", text));
  }

  Run find_run(hid_t dataset, const VariableName& wanted, const std::string& text) const {
    const Shape shape = hdf5::shape_of(dataset);
    Run run;
    run.start.assign(shape.size(), 0);
    if (wanted.slice) {
      if (shape.size() != 2) fail(fmt::format("{} has {} dimensions, not 2", text, shape.size()));
      // A column runs along the first dimension; MATLAB's first is the last here.
      const bool along_first = wanted.slice->column != wanted.matlab;
      run.dimension = along_first ? 0 : 1;
      const std::size_t across = 1 - run.dimension;
      if (wanted.slice->index >= shape[across]) {
        fail(fmt::format("{} is not there: the dataset is {} x {} (in HDF5's order)", text,
                         shape[0], shape[1]));
      }
      run.start[across] = static_cast<hsize_t>(wanted.slice->index);
    } else {
      std::size_t longer = 0;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        if (shape[i] != 1) ++longer;
        if (shape[i] != 1 || longer == 0) run.dimension = i;
      }
      if (shape.empty()) fail(fmt::format("{} is a single number", text));
      if (longer > 1) {
        fail(fmt::format("{} has {} dimensions: ask for {}[:,0] or {}[0,:]", text, longer, text,
                         text));
      }
    }
    run.count = shape[run.dimension];
    if (ragged_ && wanted.name.find("trace_") != std::string::npos) cut_to_point(run);
    if (selection_.range) {
      const std::int64_t first = std::min(selection_.range->first, run.count);
      run.start[run.dimension] += static_cast<hsize_t>(first);
      run.count = std::min(selection_.range->count, run.count - first);
    }
    return run;
  }

  /// The samples of one point of a result: CF contiguous ragged arrays.
  void cut_to_point(Run& run) const {
    const std::int64_t points = element_count(shape_of("trace_start"));
    if (!selection_.point && points != 1) {
      fail(fmt::format("holds the histories of {} points: say which, counted from 0", points));
    }
    const std::int64_t point = selection_.point.value_or(0);
    if (point >= points) fail(fmt::format("point = {} must be < {}", point, points));
    const std::int64_t start = whole_number("trace_start", point);
    const std::int64_t count = whole_number("trace_count", point);
    if (count == 0) fail(fmt::format("point {} has no samples: it failed or was skipped", point));
    if (start < 0 || count < 0 || start > run.count || count > run.count - start) {
      fail(fmt::format("is damaged: point {} has samples {} + {} of {}", point, start, count,
                       run.count));
    }
    run.start[run.dimension] = static_cast<hsize_t>(start);
    run.count = count;
  }

  Shape shape_of(const char* name) const {
    return hdf5::shape_of(hdf5::Handle(H5Dopen2(file_.get(), name, H5P_DEFAULT), "open it").get());
  }
  std::int64_t whole_number(const char* name, std::int64_t index) const {
    const hdf5::Handle dataset(H5Dopen2(file_.get(), name, H5P_DEFAULT), "open a dataset");
    const Shape shape = hdf5::shape_of(dataset.get());
    if (index >= element_count(shape)) fail(fmt::format("is damaged: {} is too short", name));
    std::int64_t value = 0;
    hdf5::read_range(dataset.get(), H5T_NATIVE_INT64, shape, index, 1, &value);
    return value;
  }

  static std::vector<double> read_run(hid_t dataset, const Run& run) {
    std::vector<double> values(static_cast<std::size_t>(run.count));
    if (values.empty()) return values;
    const hdf5::Handle space(H5Dget_space(dataset), "open a dataspace");
    std::vector<hsize_t> count(run.start.size(), 1);
    count[run.dimension] = values.size();
    hdf5::check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, run.start.data(), nullptr,
                                    count.data(), nullptr),
                "select samples");
    const hdf5::Handle memory(H5Screate_simple(1, &count[run.dimension], nullptr),
                              "make a dataspace");
    hdf5::check(
        H5Dread(dataset, H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()),
        "read samples");
    return values;
  }

  /// The attribute "units" (CF) or "unit".
  static std::string unit_of(hid_t dataset) {
    const std::string units = text_of(dataset, "units");
    return units.empty() ? text_of(dataset, "unit") : units;
  }

  /// A short text; empty where it is not there, long, or no text.
  static std::string text_of(hid_t dataset, const char* name) {
    if (H5Aexists(dataset, name) <= 0) return "";
    const hdf5::Handle attribute(H5Aopen(dataset, name, H5P_DEFAULT), "open an attribute");
    const hdf5::Handle type(H5Aget_type(attribute.get()), "open a type");
    const hdf5::Handle space(H5Aget_space(attribute.get()), "open a dataspace");
    if (H5Tget_class(type.get()) != H5T_STRING) return "";
    if (H5Sget_simple_extent_npoints(space.get()) != 1) return "";
    if (H5Tis_variable_str(type.get()) > 0) {
      char* text = nullptr;
      hdf5::check(H5Aread(attribute.get(), type.get(), &text), "read an attribute");
      const std::string copy = text == nullptr ? "" : text;
      H5free_memory(text);
      return copy.size() > kLongestText ? "" : copy;
    }
    std::string text(H5Tget_size(type.get()), '\0');
    if (text.size() > kLongestText) return "";
    hdf5::check(H5Aread(attribute.get(), type.get(), text.data()), "read an attribute");
    return text.substr(0, text.find('\0'));
  }

  const Source& source_;
  const TraceSelection& selection_;
  hdf5::Handle file_;
  bool ragged_;
};

TraceFile read_file(const Source& source, const TraceSelection& selection) {
  const hdf5::QuietErrors quiet;
  Reader reader(source, selection);
  if (selection.point && !reader.ragged()) {
    throw core::InputError({source.path, 0},
                           "has no points: there are no trace_start, trace_count");
  }
  const bool matlab = source.bytes.starts_with("MATLAB 7.3");
  TraceFile file{matlab ? "MATLAB 7.3" : kName, {}};
  std::map<std::string, std::string> wanted = selection.variables;
  if (wanted.empty() && reader.ragged()) {
    wanted = {{"Fx", "trace_force_x"}, {"Fy", "trace_force_y"}, {"Fz", "trace_force_z"}};
  }
  if (wanted.empty()) {
    throw core::InputError({source.path, 0},
                           "is an HDF5 file: say which of its datasets are the channels");
  }
  const bool traces = std::any_of(wanted.begin(), wanted.end(), [](const auto& entry) {
    return entry.second.starts_with("trace_force_");
  });
  if (traces && reader.ragged() && reader.exists("trace_time"))
    wanted.emplace("time", "trace_time");
  std::size_t left = kMostTraceValues;
  for (const auto& [name, variable] : wanted) {
    identify::Channel channel = reader.read(name, variable, left);
    left -= channel.samples.size();
    if (name == "time") {
      file.channels.time = std::move(channel.samples);
    } else {
      file.channels.channels.push_back(std::move(channel));
    }
  }
  return file;
}

/// Calls of the library that fail say what is wrong with the file.
template <class Function>
auto explained(const Source& source, const Function& function) {
  try {
    return function();
  } catch (const hdf5::Error& error) {
    throw core::InputError({source.path, 0}, error.what());
  }
}

TraceFile read(const Source& source, const TraceSelection& selection) {
  return read_contained(
      source, [&] { return explained(source, [&] { return read_file(source, selection); }); });
}

std::vector<std::string> variables(const Source& source) {
  const TraceFile file = read_contained(source, [&] {
    return explained(source, [&] {
      const hdf5::QuietErrors quiet;
      TraceFile names;
      for (std::string& name : names_of(hdf5::open_file_to_read(source.path).get())) {
        names.channels.channels.push_back({std::move(name), "", {}});
      }
      return names;
    });
  });
  std::vector<std::string> names;
  for (const identify::Channel& channel : file.channels.channels) names.push_back(channel.name);
  return names;
}

}  // namespace

const TraceFormat kHdf5 = {kName, recognise, read, variables};

}  // namespace millstudy::io
