// SPDX-License-Identifier: MIT
// LabVIEW measurement files (.lvm), versions 1 and 2: a header, then segments, each with a header.
// Specification: ni.com, "Specification for the LabVIEW Measurement File (.lvm)".
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "core/error.h"
#include "io/traces/format.h"
#include "io/traces/range.h"
#include "io/traces/text_rows.h"
#include "io/traces/text_table.h"

namespace millstudy::io {
namespace {

constexpr const char* kName = "LabVIEW measurement file";
constexpr std::string_view kEndOfHeader = "***End_of_Header***";
constexpr std::string_view kSegmentBegins = "Channels";

enum class Times { kNone, kOne, kEach };  // X_Columns No, One, Multi

/// The header of the file.
struct FileHeader {
  TextDialect dialect{'\t', '.'};
  Times times = Times::kOne;
  std::string recorded;
};

/// One segment: its header and where its columns are.
struct Segment {
  std::vector<TextColumn> channels;
  std::vector<std::size_t> field;       ///< of each channel on a row
  std::vector<std::size_t> time_field;  ///< of each channel's X; empty without X
  std::size_t fields = 0;               ///< without the comment
  double start = 0.0;                   ///< X0
  std::optional<double> step;           ///< Delta_X
  std::optional<double> samples;        ///< as the header says
};

bool recognise(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return bytes.starts_with("LabVIEW Measurement");
}

std::vector<std::string_view> fields_of(const LineReader& reader, const TextDialect& dialect) {
  return split(reader.text(), dialect.separator);
}

std::string_view second(const std::vector<std::string_view>& fields) {
  return fields.size() > 1 ? fields[1] : std::string_view();
}

FileHeader read_file_header(const Source& source, LineReader& reader) {
  FileHeader header;
  while (reader.next()) {
    const std::string_view line = trimmed(reader.text());
    if (line.starts_with(kEndOfHeader)) return header;
    // "Separator<separator>Tab": the line itself shows which one it is.
    if (line.starts_with("Separator") && line.size() > 9) {
      const char shown = reader.text()[reader.text().find("Separator") + 9];
      const bool known = shown == '\t' || shown == ',' || shown == ';';
      if (line.ends_with("Comma")) header.dialect.separator = ',';
      if (line.ends_with("Semicolon")) header.dialect.separator = ';';
      if (known) header.dialect.separator = shown;
    }
    const std::vector<std::string_view> fields = fields_of(reader, header.dialect);
    if (fields.empty()) continue;
    if (fields[0] == "Decimal_Separator") {
      header.dialect.decimal = second(fields) == "," ? ',' : '.';
    } else if (fields[0] == "X_Columns") {
      header.times = second(fields) == "No"      ? Times::kNone
                     : second(fields) == "Multi" ? Times::kEach
                                                 : Times::kOne;
    } else if (fields[0] == "Date" || fields[0] == "Time") {
      header.recorded += (header.recorded.empty() ? "" : " ") + std::string(second(fields));
    }
  }
  throw core::InputError({source.path, reader.number()}, "the file ends within its header");
}

/// Places of the columns from the line of names, "X_Value A B Comment".
void place_columns(std::vector<std::string_view> names, const FileHeader& header,
                   std::string_view first_row, Segment& segment) {
  if (!names.empty() && names.back() == "Comment") names.pop_back();
  std::size_t time = 0;
  std::vector<std::string_view> named;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == "X_Value") {
      time = i;
      continue;
    }
    segment.field.push_back(i);
    if (header.times != Times::kNone) segment.time_field.push_back(time);
    named.push_back(names[i]);
  }
  segment.fields = names.size();
  segment.channels.resize(std::max(segment.channels.size(), named.size()));
  for (std::size_t i = 0; i < named.size(); ++i) segment.channels[i].name = named[i];
  segment.channels.resize(named.size());
  // Without X the rows begin with its empty field, or do not.
  const bool x_named = !names.empty() && names.front() == "X_Value";
  if (header.times == Times::kNone && x_named && !first_row.empty() &&
      first_row.front() != header.dialect.separator) {
    for (std::size_t& field : segment.field) --field;
    --segment.fields;
  }
}

/// Reads the header of a segment. The reader is left before the first row.
Segment read_segment_header(const Source& source, LineReader& reader, const FileHeader& header) {
  Segment segment;
  std::vector<std::string_view> units;
  const auto number = [&](std::string_view text) {
    return number_of(text, header.dialect.decimal);
  };
  do {
    const std::vector<std::string_view> fields = fields_of(reader, header.dialect);
    if (fields.empty()) continue;
    if (fields[0].starts_with(kEndOfHeader)) {
      if (!reader.next()) break;
      LineReader ahead(reader.rest());
      while (ahead.next() && is_blank_row(ahead.text(), header.dialect.separator)) {
      }
      place_columns(fields_of(reader, header.dialect), header, ahead.text(), segment);
      if (segment.channels.empty()) break;
      for (std::size_t i = 0; i < std::min(units.size(), segment.channels.size()); ++i) {
        segment.channels[i].unit = units[i];
      }
      return segment;
    }
    if (fields[0] == "Y_Unit_Label") units.assign(fields.begin() + 1, fields.end());
    if (fields[0] == "X0") segment.start = number(second(fields)).value_or(0.0);
    if (fields[0] == "Delta_X") segment.step = number(second(fields));
    if (fields[0] == "Samples") segment.samples = number(second(fields));
  } while (reader.next());
  throw core::InputError({source.path, reader.number()},
                         "the file ends within the header of a segment, or that names no channel");
}

/// Reads the segments into one channel set.
class SegmentReader {
 public:
  SegmentReader(const Source& source, const TraceSelection& selection, FileHeader header)
      : source_(source), selection_(selection), header_(std::move(header)), faults_(source.path) {
    set_.source = source.path;
    set_.recorded = header_.recorded;
  }

  void read(LineReader& reader, const Segment& segment, int number) {
    const ColumnChoice choice = choose_columns(source_, segment.channels, selection_);
    if (set_.channels.empty()) {
      for (std::size_t i = 0; i < choice.names.size(); ++i) {
        set_.channels.push_back({choice.names[i], segment.channels[choice.columns[i]].unit, {}});
      }
    }
    const RowLayout layout = layout_of(segment, choice);
    Rows rows = read_rows(source_.path, reader, layout, {}, faults_);
    faults_.throw_if_any();
    if (segment.samples && *segment.samples != static_cast<double>(rows.size())) {
      set_.remarks.push_back(fmt::format("the header of segment {} says {} samples, it holds {}",
                                         number, *segment.samples, rows.size()));
    }
    add(segment, choice, layout, rows);
    for (std::string& remark : rows.remarks) set_.remarks.push_back(std::move(remark));
  }

  /// After the last segment.
  identify::ChannelSet take() {
    if (evenly_) {
      set_.time.clear();
      if (step_ && std::isfinite(*step_) && *step_ > 0.0) set_.sampling_rate = 1.0 / *step_;
    }
    return std::move(set_);
  }

 private:
  RowLayout layout_of(const Segment& segment, const ColumnChoice& choice) const {
    RowLayout layout;
    layout.dialect = header_.dialect;
    layout.fields = segment.fields;
    layout.more_fields = true;
    layout.ends = {"***", kSegmentBegins};
    for (const std::size_t channel : choice.columns) {
      layout.columns.push_back(segment.field[channel]);
      if (!segment.time_field.empty()) layout.columns.push_back(segment.time_field[channel]);
    }
    std::sort(layout.columns.begin(), layout.columns.end());
    layout.columns.erase(std::unique(layout.columns.begin(), layout.columns.end()),
                         layout.columns.end());
    for (const std::size_t field : layout.columns) {
      const auto at = std::find(segment.field.begin(), segment.field.end(), field);
      layout.names.push_back(at == segment.field.end()
                                 ? "X_Value"
                                 : segment.channels[at - segment.field.begin()].name);
    }
    return layout;
  }

  void add(const Segment& segment, const ColumnChoice& choice, const RowLayout& layout,
           const Rows& rows) {
    const std::size_t before = set_.channels.empty() ? 0 : set_.channels.front().samples.size();
    const auto values = [&](std::size_t field) -> const std::vector<double>& {
      const auto at = std::lower_bound(layout.columns.begin(), layout.columns.end(), field);
      return rows.values[static_cast<std::size_t>(at - layout.columns.begin())];
    };
    if (choice.columns.size() != set_.channels.size()) {
      throw core::InputError({source_.path, 0}, "segments have different channels: read one");
    }
    if ((before + rows.size()) * (set_.channels.size() + 1) > kMostTraceValues) {
      throw core::InputError(
          {source_.path, 0},
          fmt::format("more than {} values: read fewer channels or one segment", kMostTraceValues));
    }
    for (std::size_t i = 0; i < choice.columns.size(); ++i) {
      const std::vector<double>& from = values(segment.field[choice.columns[i]]);
      std::vector<double>& to = set_.channels[i].samples;
      to.insert(to.end(), from.begin(), from.end());
    }
    for (const identify::ChannelSet::Lines& run : rows.lines) {
      set_.lines.push_back({before + run.begin, run.line});
    }
    add_times(segment, choice, before, rows, values);
  }

  template <class Values>
  void add_times(const Segment& segment, const ColumnChoice& choice, std::size_t before,
                 const Rows& rows, const Values& values) {
    if (!segment.time_field.empty() && !choice.columns.empty()) {
      const std::vector<double>& first = values(segment.time_field[choice.columns.front()]);
      for (const std::size_t channel : choice.columns) {
        if (values(segment.time_field[channel]) == first) continue;
        throw core::InputError({source_.path, 0},
                               fmt::format("channels {} and {} have different "
                                           "times: they cannot be one trace",
                                           segment.channels[choice.columns.front()].name,
                                           segment.channels[channel].name));
      }
      evenly_ = false;
      set_.time.insert(set_.time.end(), first.begin(), first.end());
      if (segment.step && *segment.step > 0.0 && !set_.sampling_rate) {
        set_.sampling_rate = 1.0 / *segment.step;
      }
      return;
    }
    // No X: times are X0 + i Delta_X, kept as a column only where segments leave a gap.
    if (before == 0) {
      set_.start = segment.start;
      step_ = segment.step;
      return;
    }
    const double step = segment.step.value_or(0.0);
    const double expected = set_.start + static_cast<double>(before) * step_.value_or(0.0);
    if (evenly_ && step == step_.value_or(0.0) &&
        std::abs(segment.start - expected) <= 1e-3 * std::abs(step)) {
      return;
    }
    if (evenly_) {
      for (std::size_t i = 0; i < before; ++i) {
        set_.time.push_back(set_.start + static_cast<double>(i) * step_.value_or(0.0));
      }
      evenly_ = false;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      set_.time.push_back(segment.start + static_cast<double>(i) * step);
    }
  }

  const Source& source_;
  const TraceSelection& selection_;
  FileHeader header_;
  TraceFaults faults_;
  identify::ChannelSet set_;
  bool evenly_ = true;  ///< no time column is needed so far
  std::optional<double> step_;
};

/// Moves to the first line of the header of a segment, from the current line on. The tags of a
/// header may come in any order, but LabVIEW writes Channels first.
bool find_segment(LineReader& reader, const TextDialect& dialect, bool first) {
  bool special = false;
  do {
    const std::string_view line = trimmed(reader.text());
    if (line.starts_with("***Start_Special")) special = true;
    if (line.starts_with("***End_Special")) {
      special = false;
    } else if (!special && !is_blank_row(line, dialect.separator) &&
               (first || line.starts_with(kSegmentBegins))) {
      return true;
    }
  } while (reader.next());
  return false;
}

TraceFile read(const Source& source, const TraceSelection& selection) {
  LineReader reader(source.bytes);
  const FileHeader header = read_file_header(source, reader);
  SegmentReader segments(source, selection, header);
  int number = 0;
  while ((number > 0 || reader.next()) && find_segment(reader, header.dialect, number == 0)) {
    const Segment segment = read_segment_header(source, reader, header);
    ++number;
    if (!selection.segment || *selection.segment == number) segments.read(reader, segment, number);
  }
  if (number == 0) throw core::InputError({source.path, 0}, "has no segment");
  if (selection.segment && (*selection.segment > number || *selection.segment < 1)) {
    throw core::InputError({source.path, 0}, fmt::format("has {} segments, there is no segment {}",
                                                         number, *selection.segment));
  }
  TraceFile file{kName, segments.take()};
  cut_to_range(file.channels, selection.range);
  return file;
}

std::vector<std::string> variables(const Source& source) {
  LineReader reader(source.bytes);
  const FileHeader header = read_file_header(source, reader);
  std::vector<std::string> names;
  if (!reader.next()) return names;
  for (const TextColumn& channel : read_segment_header(source, reader, header).channels) {
    names.push_back(channel.name);
  }
  return names;
}

}  // namespace

const TraceFormat kLabview = {kName, recognise, read, variables};

}  // namespace millstudy::io
