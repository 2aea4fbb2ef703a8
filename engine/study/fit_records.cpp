// SPDX-License-Identifier: MIT
// [trace] and [[record]]: measured traces, and the cut of each.
#include <algorithm>
#include <filesystem>
#include <map>

#include "core/units.h"
#include "study/fit_reader.h"

namespace millstudy::study {
namespace {

/// Puts the members of a table over those of another.
void put_over(core::Value& target, const core::Value& change) {
  for (const core::Member& member : change.table()) {
    if (core::Value* present = target.find(member.key)) {
      *present = member.value;
    } else {
      target.table().push_back(member);
    }
  }
}

void remove(core::Value& table, std::string_view key) {
  std::erase_if(table.table(), [&](const core::Member& member) { return member.key == key; });
}

/// Records of one file are told apart: slots.mat (1), slots.mat (2).
void number_equal_names(FitReader& read) {
  std::map<std::string, int> counts, numbers;
  for (const FitRecord& record : read.file.records) ++counts[record.name];
  for (FitRecord& record : read.file.records) {
    if (counts[record.name] < 2) continue;
    record.name += fmt::format(" ({})", ++numbers[record.name]);
  }
}

void read_source(const Key& key, const core::Value& value, TraceSource& source) {
  const std::string_view name = key.name();
  if (name == "axes") {
    const core::Value& table = as_table(key, value);
    source.axes = {};
    source.axes_place = value.place;
    for (const core::Member& member : table.table()) {
      const auto axis =
          std::find(kAxisNames.begin(), kAxisNames.end(), member.key) - kAxisNames.begin();
      if (axis == 3 || !member.value.is_string()) {
        throw core::InputError(member.value.place,
                               "trace.axes must be like { x = \"-Fy\", y = \"-Fx\", z = \"Fz\" }");
      }
      source.axes[axis] = member.value.string();
    }
    identify::parse_axis_map(source.axes, value.place);
    return;
  }
  if (key.type == KeyType::table) {
    for (const core::Member& member : as_table(key, value).table()) {
      if (name == "sensitivity_N_per_V") {
        const double x = finite_number(member.value, fmt::format("{}.{}", key.path, member.key));
        if (x == 0.0) {
          throw core::InputError(member.value.place,
                                 fmt::format("{}.{} must not be 0", key.path, member.key));
        }
        source.sensitivity_N_per_V[member.key] = x;
      } else if (member.value.is_string()) {
        (name == "units" ? source.units : source.variables)[member.key] = member.value.string();
      } else if (name == "variables" && member.value.is_number()) {
        source.variables[member.key] = fmt::format("{}", member.value.number());
      } else {
        throw core::InputError(member.value.place,
                               fmt::format("{}.{} must be a string, not {}", key.path, member.key,
                                           type_name(member.value)));
      }
    }
    return;
  }
  const Setting setting = checked_setting(key, value);
  if (name == "window_s") {
    const auto& window = std::get<std::vector<double>>(setting);
    if (!(window[0] < window[1])) {
      throw core::InputError(value.place, "trace.window_s must be [from, to] with from < to");
    }
    source.window = {window[0], window[1]};
    return;
  }
  if (const bool* flag = std::get_if<bool>(&setting)) {
    (name == "cutting_only" ? source.cutting_only : source.offset_from_air) = *flag;
    return;
  }
  const double x = std::get<double>(setting);
  if (name == "sampling_rate_Hz") source.sampling_rate = x;
  if (name == "point") source.point = static_cast<std::int64_t>(x);
  if (name == "segment") source.segment = static_cast<int>(x);
}

/// Cutter and cut are checked as those of a study of one point; a fault that all records share is
/// told once.
void read_cut(FitReader& read, const core::Value* change, FitRecord& record,
              std::vector<std::string>& told) {
  const core::Place place = read.whole();
  const auto text = [&](const char* t) { return core::Value{std::string(t), place}; };
  core::Value study{core::Value::Table{}, place}, coefficients{core::Value::Table{}, place};
  study.table() = {{"name", text("fit")}, {"kind", text("force")}};
  for (const std::string_view name : kCoefficientKeys) {
    coefficients.table().push_back({std::string(name), {0.0, place}});
  }
  core::Value tree{core::Value::Table{}, place};
  tree.table() = {{"schema_version", {std::int64_t{1}, place}},
                  {"study", std::move(study)},
                  {"coefficients", std::move(coefficients)}};
  for (const char* name : {"cutter_file", "cutter", "cut"}) {
    if (const core::Value* given = read.root.find(name)) tree.table().push_back({name, *given});
  }
  if (change) {
    core::Value* cut = tree.find("cut");
    if (!cut) {
      tree.table().push_back({"cut", {core::Value::Table{}, change->place}});
      cut = &tree.table().back().value;
    }
    if (cut->is_table()) {
      // The one way to give the feed takes the place of the other.
      if (change->find("feed_per_tooth_mm")) remove(*cut, "feed_rate_mm_per_min");
      if (change->find("feed_rate_mm_per_min")) remove(*cut, "feed_per_tooth_mm");
      put_over(*cut, *change);
    }
  }
  try {
    record.cut = resolve(tree, read.load).base;
  } catch (const core::InputError& error) {
    for (const core::Fault& fault : error.faults()) {
      const std::string line = to_string(fault);
      if (std::find(told.begin(), told.end(), line) != told.end()) continue;
      told.push_back(line);
      read.faults.add(fault.place, fault.text);
    }
  }
}

void read_record(FitReader& read, const core::Value& item, const TraceSource& defaults,
                 std::vector<std::string>& told) {
  FitRecord record;
  record.source = defaults;
  record.place = item.place;
  const core::Value* cut = nullptr;
  core::Value own = item;
  for (const std::span<const Key> keys : fit_keys().sections) {
    for (const Key& key : keys) {
      if (!key.path.starts_with("trace.")) continue;
      if (const core::Value* value = item.find(key.name())) {
        read.faults.collect([&] { read_source(key, *value, record.source); });
        remove(own, key.name());
      }
    }
  }
  read.for_each_key(own, "record", [&](const Key& key, const core::Value& value) {
    if (key.name() == "cut") {
      cut = item.find("cut");
      as_table(key, value);
      return;
    }
    const Setting setting = checked_setting(key, value);
    if (key.name() == "file") {
      record.source.file = std::get<std::string>(setting);
      record.source.place = value.place;
    }
    if (key.name() == "name") record.name = std::get<std::string>(setting);
    if (key.name() == "phase_deg") {
      record.phase = core::rad_from_deg(std::get<double>(setting));
    }
  });
  if (!item.find("file"))
    read.faults.add(item.place, "record.file is missing: the file of its trace");
  if (std::all_of(record.source.axes.begin(), record.source.axes.end(),
                  [](const std::string& axis) { return axis.empty(); }) &&
      !item.find("axes") && !(read.root.find("trace") && read.root.find("trace")->find("axes"))) {
    read.faults.add(item.place, missing(*fit_keys().find_key("trace.axes")));
  }
  if (record.name.empty()) {
    record.name = std::filesystem::path(record.source.file).filename().string();
  }
  read_cut(read, cut && cut->is_table() ? cut : nullptr, record, told);
  read.file.records.push_back(std::move(record));
  read.file.cutter = read.file.records.front().cut.cutter;
}

}  // namespace

void read_fit_records(FitReader& read) {
  const core::Value* records = read.root.find("record");
  if (!records || !records->is_array() || records->array().empty()) {
    return read.faults.add(records ? records->place : read.whole(),
                           "there is no [[record]]: one for each measured cut, with its file");
  }
  constexpr std::size_t kMost = 1000;
  if (records->array().size() > kMost) {
    return read.faults.add(records->place, fmt::format("more than {} records", kMost));
  }
  TraceSource defaults;
  if (const core::Value* trace = read.section("trace")) {
    read.for_each_key(*trace, "trace", [&](const Key& key, const core::Value& value) {
      read_source(key, value, defaults);
    });
  }
  std::vector<std::string> told;
  for (const core::Value& item : records->array()) {
    if (!item.is_table()) {
      read.faults.add(item.place, fmt::format("a record must be a table, not {}", type_name(item)));
      continue;
    }
    read_record(read, item, defaults, told);
  }
  number_equal_names(read);
  if (read.file.settings.phase == identify::Estimated::no) {
    for (const FitRecord& record : read.file.records) {
      if (!record.phase) {
        read.faults.add(record.place,
                        "record.phase_deg is missing: fit.estimate does not hold phase");
      }
      read.file.settings.known_phase.push_back(record.phase.value_or(0.0));
    }
  }
}

}  // namespace millstudy::study
