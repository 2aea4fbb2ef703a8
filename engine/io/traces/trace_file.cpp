// SPDX-License-Identifier: MIT
#include "io/trace_file.h"

#include <algorithm>
#include <fmt/core.h>

#include "core/error.h"
#include "io/traces/format.h"

namespace millstudy::io {
namespace {

constexpr std::array kFormats = {&kTdms, &kMatlab5, &kHdf5, &kLabview, &kDynoware, &kTable};

/// What else people have, and what to do with it.
const char* advice_on(std::string_view bytes) {
  struct Known {
    std::string_view begin;
    const char* text;
  };
  using namespace std::string_view_literals;
  static constexpr Known kKnown[] = {
      {"PK\x03\x04"sv,
       "is a zip archive or an Excel workbook: unpack it, or save the sheet as CSV"},
      {"\xd0\xcf\x11\xe0"sv, "is an old Excel workbook: save the sheet as CSV"},
      {"\x1f\x8b"sv, "is compressed by gzip: unpack it"},
      {"TDSh"sv, "is the index of a TDMS file: give the .tdms file itself"},
      {"MATLAB 7.3"sv, "is a MATLAB 7.3 file that was cut off"},
  };
  for (const Known& known : kKnown) {
    if (bytes.starts_with(known.begin)) return known.text;
  }
  return "is none of the known formats: DynoWare text, LabVIEW .lvm, a table of numbers, MATLAB 5 "
         "or 7.3, HDF5, NI TDMS";
}

void check_selection(const Source& source, const TraceFormat& format,
                     const TraceSelection& selection) {
  const auto fail = [&](std::string text) {
    throw core::InputError({source.path, 0}, std::move(text));
  };
  if (selection.range && (selection.range->first < 0 || selection.range->count < 1)) {
    fail(fmt::format("samples {} + {}: the first must be >= 0, their number >= 1",
                     selection.range->first, selection.range->count));
  }
  if (selection.point && *selection.point < 0) {
    fail(fmt::format("point = {} must be >= 0", *selection.point));
  }
  if (selection.point && &format != &kHdf5) {
    fail(fmt::format("is a {} file: only results in HDF5 have points", format.name));
  }
  if (selection.segment && &format != &kLabview) {
    fail(fmt::format("is a {} file: only LabVIEW .lvm files have segments", format.name));
  }
}

/// What every format must have kept to.
void check_result(const Source& source, const TraceSelection& selection, const TraceFile& file) {
  const auto fail = [&](std::string text) {
    throw core::InputError({source.path, 0}, std::move(text));
  };
  const identify::ChannelSet& set = file.channels;
  if (set.channels.empty()) fail("has no channel besides the time");
  for (const identify::Channel& channel : set.channels) {
    const std::size_t samples = channel.samples.size();
    if (samples == 0) fail(fmt::format("channel {} has no samples", channel.name));
    if (selection.range && samples != static_cast<std::size_t>(selection.range->count)) {
      fail(fmt::format("channel {} does not have samples {} ... {}", channel.name,
                       selection.range->first,
                       selection.range->first + selection.range->count - 1));
    }
  }
}

}  // namespace

std::span<const TraceFormat* const> trace_formats() {
  return kFormats;
}

const TraceFormat& recognise_trace_format(const Source& source) {
  const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](const TraceFormat* format) {
    return format->recognise(source.bytes);
  });
  if (found != kFormats.end()) return **found;
  throw core::InputError({source.path, 0}, advice_on(source.bytes));
}

TraceFile read_trace(const Source& source, const TraceSelection& selection) {
  const TraceFormat& format = recognise_trace_format(source);
  check_selection(source, format, selection);
  TraceFile file = format.read(source, selection);
  file.channels.source = source.path;
  check_result(source, selection, file);
  return file;
}

TraceFile read_trace_file(const std::string& path, const TraceSelection& selection) {
  const MappedFile file(path);
  return read_trace(file.source(), selection);
}

std::vector<std::string> trace_variables(const std::string& path) {
  const MappedFile file(path);
  return recognise_trace_format(file.source()).variables(file.source());
}

}  // namespace millstudy::io
