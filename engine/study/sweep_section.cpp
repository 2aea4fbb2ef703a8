// SPDX-License-Identifier: MIT
#include "study/sweep_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "study/quantity.h"
#include "study/suggest.h"
#include "study/sweep_design.h"

namespace millstudy::study {
namespace {

constexpr double kLongestAxis = 1e6;

class SweepReader {
 public:
  SweepReader(const FileSettings& read_file, Study& study, Given& given, Faults& faults)
      : read_file_(read_file), study_(study), given_(given), faults_(faults) {}

  void read(const core::Value& section) {
    if (!section.is_table()) return faults_.add(section.place, "sweep must be a table");
    const core::Value* axes = section.find("axes");
    design_ = read_design(section, axes ? count_axes(*axes, "") : 0, study_.notes, faults_);
    for (const auto& [key, value] : section.table()) {
      if (key == "design" || key == "samples" || key == "seed") {
        continue;
      } else if (key == "axes") {
        read_axes(value, "");
      } else if (key == "where") {
        read_limits(value);
      } else {
        constexpr std::array<std::string_view, 5> kKnown = {"design", "samples", "seed", "axes",
                                                            "where"};
        faults_.add(value.place, fmt::format("sweep.{} is not a key of a study{}", key,
                                             suggestion(key, kKnown)));
      }
    }
    if (!section.find("axes")) {
      return faults_.add(section.place,
                         "sweep.axes is missing: say what to sweep, or leave "
                         "[sweep] out for a single point");
    }
    if (!faults_.empty()) return;
    if (study_.axes.empty()) {
      return faults_.add(section.find("axes")->place, "sweep.axes has no axis");
    }
    make_space(section.find("axes")->place);
  }

 private:
  /// Of the values of a list each point takes one.
  template <class T>
  void take_sampled(std::vector<T>& values) const {
    if (values.empty()) return;
    std::vector<T> taken;
    for (const double u : design_.places(study_.axes.size())) {
      taken.push_back(values[static_cast<std::size_t>(u * static_cast<double>(values.size()))]);
    }
    values = std::move(taken);
  }

  void sample_range(const Key& key, const core::Value& range, double from, double to, bool log,
                    Axis& axis) const {
    if (const core::Value* count = range.find("count")) {
      fail(*count, fmt::format("sweep.axes: {}: count is not for a sampled design: sweep.samples "
                               "says how many",
                               key.path));
    }
    if (from >= to) {
      fail(range, fmt::format("sweep.axes: {}: from = {} must be < to = {}", key.path, from, to));
    }
    axis.sampled = fmt::format("{} from {} to {}{}", design_.how(study_.axes.size()), from, to,
                               log ? " in logarithms" : "");
    for (const double u : design_.places(study_.axes.size())) {
      if (key.type == KeyType::integer) {
        axis.numbers.push_back(from + std::floor(u * (to - from + 1.0)));
      } else {
        axis.numbers.push_back(log ? from * std::pow(to / from, u) : from + (to - from) * u);
      }
    }
  }

  /// Axes may be written "cut.axial_depth_mm" = ... or cut.axial_depth_mm = ..., a nested table.
  void read_axes(const core::Value& table, const std::string& prefix) {
    if (!table.is_table()) return faults_.add(table.place, "sweep.axes must be a table of keys");
    for (const auto& [name, value] : table.table()) {
      const std::string path = prefix.empty() ? name : prefix + '.' + name;
      if (const Key* key = study_.kind->find_key(path)) {
        read_axis(*key, value);
      } else if (value.is_table() && study_.kind->has_section(path)) {
        read_axes(value, path);
      } else {
        faults_.add(value.place, fmt::format("sweep.axes: {} is not a key of kind {}{}", path,
                                             study_.kind->name, suggestion(path, sweepable_)));
      }
    }
  }

  std::size_t count_axes(const core::Value& table, const std::string& prefix) const {
    if (!table.is_table()) return 0;
    std::size_t count = 0;
    for (const auto& [name, value] : table.table()) {
      const std::string path = prefix.empty() ? name : prefix + '.' + name;
      if (study_.kind->find_key(path)) {
        ++count;
      } else {
        count += count_axes(value, path);
      }
    }
    return count;
  }

  void read_axis(const Key& key, const core::Value& value) {
    if (!key.sweepable()) {
      return faults_.add(value.place, fmt::format("sweep.axes: {} cannot be swept", key.path));
    }
    if (std::any_of(study_.axes.begin(), study_.axes.end(),
                    [&](const Axis& axis) { return axis.key == &key; })) {
      return faults_.add(value.place, fmt::format("sweep.axes: {} is given twice", key.path));
    }
    Axis axis{std::string(key.path), &key, {}, {}, {}, {}};
    const bool fine = faults_.collect([&] {
      if (value.is_table()) {
        read_range(key, value, axis);
      } else if (value.is_array()) {
        read_list(key, value, axis);
      } else {
        fail(value, fmt::format("sweep.axes: {} must be a list, or {{ from, to, count }}, not {}",
                                key.path, type_name(value)));
      }
    });
    given_.entries[key.path] = {&key, value.place, true, {}};
    if (key.type == KeyType::choice) given_.entries[key.path].choices = axis.labels;
    if (fine) study_.axes.push_back(std::move(axis));
  }

  [[noreturn]] static void fail(const core::Value& value, std::string text) {
    throw core::InputError(value.place, std::move(text));
  }

  static void check_length(const Key& key, const core::Value& value, double count) {
    if (count > kLongestAxis) {
      fail(value, fmt::format("sweep.axes: {} has {:.4g} values, more than {:.0f}", key.path, count,
                              kLongestAxis));
    }
  }

  void read_list(const Key& key, const core::Value& list, Axis& axis) {
    if (list.array().empty()) fail(list, fmt::format("sweep.axes: {} has no values", key.path));
    check_length(key, list, static_cast<double>(list.array().size()));
    check_lists(key, list);
    Faults faults;
    for (const core::Value& item : list.array()) {
      faults.collect([&] { add_value(key, item, axis); });
    }
    faults.throw_if_any();
    if (!design_.is_sampled()) return;
    axis.sampled =
        fmt::format("{} of {}", design_.how(study_.axes.size()), fmt::join(axis.numbers, " "));
    for (std::size_t i = 0; i < axis.labels.size(); ++i) axis.sampled += ' ' + label_text(axis, i);
    take_sampled(axis.numbers);
    take_sampled(axis.labels);
    take_sampled(axis.settings);
  }

  /// What a key with a list takes: lists, or numbers where it is one of them.
  static void check_lists(const Key& key, const core::Value& values) {
    if (!key.takes_list()) return;
    const auto lists = std::count_if(values.array().begin(), values.array().end(),
                                     [](const core::Value& item) { return item.is_array(); });
    if (lists == std::ssize(values.array()) || (key.numeric() && lists == 0)) return;
    fail(
        values,
        key.numeric()
            ? fmt::format("sweep.axes: {} mixes numbers and lists: give one or the other", key.path)
            : fmt::format("sweep.axes: {0} must be a list of lists: [[...], [...]]", key.path));
  }

  void add_value(const Key& key, const core::Value& item, Axis& axis) {
    Setting setting = checked_setting(key, item);
    if (std::holds_alternative<double>(setting)) {
      axis.numbers.push_back(std::get<double>(setting));
      return;
    }
    axis.labels.push_back(to_string(setting));
    axis.settings.push_back(key.type == KeyType::file
                                ? read_file_(key, item)
                                : std::vector<Assignment>{{&key, std::move(setting)}});
  }

  /// A whole number that spacing has moved by rounding is that number; anything else stays.
  static double without_rounding(double number) {
    const double whole = std::nearbyint(number);
    return std::abs(number - whole) <= 1e-12 * std::abs(whole) ? whole : number;
  }

  static double range_member(const Key& key, const core::Value& range, std::string_view name) {
    const core::Value* value = range.find(name);
    if (!value || !value->is_number() || !std::isfinite(value->number())) {
      fail(value ? *value : range, fmt::format("sweep.axes: {}: {} {}", key.path, name,
                                               value ? "must be a finite number" : "is missing"));
    }
    return value->number();
  }

  static bool logarithmic(const Key& key, const core::Value& range) {
    const core::Value* spacing = range.find("spacing");
    if (!spacing) return false;
    if (spacing->is_string() && spacing->string() == "linear") return false;
    if (spacing->is_string() && spacing->string() == "log") return true;
    fail(*spacing, fmt::format("sweep.axes: {}: spacing must be linear or log", key.path));
  }

  void read_range(const Key& key, const core::Value& range, Axis& axis) {
    constexpr std::array<std::string_view, 4> kKnown = {"from", "to", "count", "spacing"};
    for (const auto& [name, value] : range.table()) {
      if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end()) {
        fail(value, fmt::format("sweep.axes: {}: {} is not one of from, to, count, spacing{}",
                                key.path, name, suggestion(name, kKnown)));
      }
    }
    if (!key.numeric()) {
      fail(range, fmt::format("sweep.axes: {} is {}", key.path,
                              key.takes_list() ? "a list; give a list of lists: [[...], [...]]"
                                               : "not a number; give a list"));
    }
    const double from = range_member(key, range, "from");
    const double to = range_member(key, range, "to");
    const double count = design_.is_sampled() ? 2.0 : range_member(key, range, "count");
    const bool log = logarithmic(key, range);
    if (count != std::nearbyint(count) || count < 1.0) {
      fail(*range.find("count"),
           fmt::format("sweep.axes: {}: count = {} must be a whole number >= 1", key.path, count));
    }
    if (!design_.is_sampled()) check_length(key, *range.find("count"), count);
    if (count == 1.0 && from != to) {
      fail(*range.find("count"),
           fmt::format("sweep.axes: {}: count = 1 leaves out to = {}: give 2 or more", key.path,
                       to));
    }
    if (log && (from <= 0.0 || to <= 0.0)) {
      fail(range, fmt::format("sweep.axes: {}: log spacing needs from and to > 0", key.path));
    }
    Faults ends;
    ends.collect([&] { checked_setting(key, *range.find("from")); });
    ends.collect([&] { checked_setting(key, *range.find("to")); });
    ends.throw_if_any();
    if (design_.is_sampled()) return sample_range(key, range, from, to, log, axis);
    const double last = count - 1.0;
    for (double i = 0.0; i <= last; ++i) {
      // Multiplied before it is divided: 600 to 3000 in 25 steps gives 700, not 699.9999999999999.
      double number = i == 0.0    ? from
                      : i == last ? to
                      : log       ? from * std::pow(to / from, i / last)
                                  : from + (to - from) * i / last;
      if (key.type == KeyType::integer) number = without_rounding(number);
      add_value(key, {number, range.place}, axis);
    }
  }

  void read_limits(const core::Value& list) {
    if (!list.is_array()) {
      return faults_.add(list.place, "sweep.where must be a list of tables: [[sweep.where]]");
    }
    for (const core::Value& item : list.array()) {
      faults_.collect([&] { study_.limits.push_back(read_limit(item)); });
    }
  }

  Limit read_limit(const core::Value& table) const {
    if (!table.is_table()) fail(table, "sweep.where must be a list of tables: [[sweep.where]]");
    Limit limit;
    limit.place = table.place;
    for (const auto& [name, value] : table.table()) {
      if (name == "quantity") {
        if (!value.is_string()) fail(value, "sweep.where: quantity must be a string");
        limit.quantity = value.string();
        limit.value = quantity_named(limit.quantity, *study_.kind);
        if (!limit.value) {
          fail(value, unknown_quantity(limit.quantity));
        }
      } else if (name == "min" || name == "max") {
        if (!value.is_number() || std::isnan(value.number())) {
          fail(value, fmt::format("sweep.where: {} must be a number", name));
        }
        (name == "min" ? limit.min : limit.max) = value.number();
      } else {
        constexpr std::array<std::string_view, 3> kKnown = {"quantity", "min", "max"};
        fail(value, fmt::format("sweep.where: {} is not one of quantity, min, max{}", name,
                                suggestion(name, kKnown)));
      }
    }
    if (!limit.value) fail(table, "sweep.where has no quantity");
    if (!limit.min && !limit.max) fail(table, "sweep.where has neither min nor max");
    if (limit.min && limit.max && *limit.min > *limit.max) {
      fail(table, fmt::format("sweep.where: {}: min = {} must be <= max = {}", limit.quantity,
                              *limit.min, *limit.max));
    }
    return limit;
  }

  std::string unknown_quantity(std::string_view name) const {
    const std::vector<std::string_view> derived = quantity_names(*study_.kind);
    std::vector<std::string_view> known = derived;
    known.insert(known.end(), sweepable_.begin(), sweepable_.end());
    return fmt::format(
        "sweep.where: quantity = \"{}\" is neither a numeric key of kind {} nor one of {}{}", name,
        study_.kind->name, fmt::join(derived, ", "), suggestion(name, known));
  }

  /// In a grid a value that comes twice is a slip (1,5 for 1.5, say), and no coordinate.
  void check_repeats() {
    for (const Axis& axis : study_.axes) {
      const core::Place& place = given_.entries.at(axis.key->path).place;
      std::vector<double> numbers = axis.numbers;
      std::vector<std::string> labels = axis.labels;
      std::sort(numbers.begin(), numbers.end());
      std::sort(labels.begin(), labels.end());
      const auto number = std::adjacent_find(numbers.begin(), numbers.end());
      const auto label = std::adjacent_find(labels.begin(), labels.end());
      if (number != numbers.end()) {
        faults_.add(place, fmt::format("sweep.axes: {} has {} twice", axis.path, *number));
      } else if (label != labels.end()) {
        faults_.add(place, fmt::format("sweep.axes: {} has \"{}\" twice", axis.path, *label));
      }
    }
  }

  void make_space(const core::Place& place) {
    if (design_.design == sweep::Design::grid) check_repeats();
    std::vector<std::int64_t> lengths;
    for (const Axis& axis : study_.axes) lengths.push_back(static_cast<std::int64_t>(axis.size()));
    try {
      study_.space = sweep::ParameterSpace(design_.design, std::move(lengths));
    } catch (const core::InputError& error) {
      faults_.add(place, error.what());
    }
  }

  SweepDesign design_;
  const FileSettings& read_file_;
  Study& study_;
  Given& given_;
  Faults& faults_;
  std::vector<std::string_view> sweepable_ = key_paths(*study_.kind);
};

}  // namespace

void read_sweep(const core::Value& section, const FileSettings& read_file, Study& study,
                Given& given, Faults& faults) {
  Faults own;  // so that an earlier fault elsewhere does not hide the ones in here
  SweepReader(read_file, study, given, own).read(section);
  faults.collect([&] { own.throw_if_any(); });
}

}  // namespace millstudy::study
