// SPDX-License-Identifier: MIT
// Text exports of Kistler's DynoWare: lines "Key:<separator>value", names, units, rows.
#include <cmath>
#include <fmt/core.h>

#include "io/traces/format.h"
#include "io/traces/text_table.h"

namespace millstudy::io {
namespace {

constexpr const char* kName = "DynoWare text";

bool recognise(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  while (!bytes.empty() && (bytes.front() == ' ' || bytes.front() == '"')) bytes.remove_prefix(1);
  return bytes.starts_with("DynoWare");
}

/// The text after "key:" and the separator; empty if there is none.
std::string_view value_of(const TextTable& table, std::string_view key) {
  LineReader reader(table.header);
  while (reader.next()) {
    std::string_view line = trimmed(reader.text());
    if (!line.starts_with(key)) continue;
    line.remove_prefix(key.size());
    line = trimmed(line);
    if (!line.starts_with(":")) continue;
    line.remove_prefix(1);
    line = trimmed(line);
    if (!line.empty() && line.front() == table.dialect.separator) line.remove_prefix(1);
    while (!line.empty() && line.back() == table.dialect.separator) line.remove_suffix(1);
    return trimmed(line);
  }
  return {};
}

std::optional<double> number(const TextTable& table, std::string_view key) {
  const std::string_view text = value_of(table, key);
  const std::optional<double> value = number_of(text, '.');
  return value ? value : number_of(text, ',');
}

void compare_with_header(const TextTable& table, const TraceSelection& selection,
                         identify::ChannelSet& set) {
  const std::optional<double> samples = number(table, "Samples per channel");
  const std::size_t read = set.channels.empty() ? 0 : set.channels.front().samples.size();
  if (samples && !selection.range && *samples != static_cast<double>(read)) {
    set.remarks.push_back(
        fmt::format("the header says {} samples, the file holds {}", *samples, read));
  }
  const std::optional<double> cycles = number(table, "Cycles");
  if (cycles && *cycles > 1.0) {
    set.remarks.push_back(fmt::format("the header says {} cycles: this is one of them", *cycles));
  }
}

TraceFile read(const Source& source, const TraceSelection& selection) {
  const TextTable table = find_table(source);
  TraceFile file{kName, read_table(source, table, selection)};
  identify::ChannelSet& set = file.channels;
  const std::optional<double> rate = number(table, "Sampling rate [Hz]");
  if (rate && std::isfinite(*rate) && *rate > 0.0) set.sampling_rate = *rate;
  const std::string date(value_of(table, "Date"));
  const std::string time(value_of(table, "Time"));
  set.recorded = date + (date.empty() || time.empty() ? "" : " ") + time;
  compare_with_header(table, selection, set);
  return file;
}

std::vector<std::string> variables(const Source& source) {
  return kTable.variables(source);
}

}  // namespace

const TraceFormat kDynoware = {kName, recognise, read, variables};

}  // namespace millstudy::io
