// SPDX-License-Identifier: MIT
#include "study/fit_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "core/units.h"
#include "study/suggest.h"

namespace millstudy::study {
namespace {

constexpr std::array<std::string_view, 6> kCoefficients = {"Ktc_N_per_mm2", "Krc_N_per_mm2",
                                                           "Kac_N_per_mm2", "Kte_N_per_mm",
                                                           "Kre_N_per_mm",  "Kae_N_per_mm"};
constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};

bool has(const std::vector<std::string>& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

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

/// One fit file from its tree. Every step collects its faults.
class Reader {
 public:
  Reader(const core::Value& root, const FileLoader& load) : root_(root), load_(load) {}

  FitFile run() {
    if (!root_.is_table()) throw core::InputError(root_.place, "a fit file must be a table");
    check_sections();
    faults_.collect([&] {
      for_each_key(root_, "", [&](const Key& key, const core::Value& value) {
        if (key.path == "schema_version") checked_setting(key, value);
      });
    });
    if (!root_.find("schema_version")) miss("schema_version");
    read_fit();
    read_modes();
    read_records();
    faults_.throw_if_any();
    return std::move(file_);
  }

 private:
  core::Place whole() const { return {root_.place.file, 0}; }

  void miss(std::string_view path) { faults_.add(whole(), missing(*fit_keys().find_key(path))); }

  void check_sections() {
    static constexpr std::array<std::string_view, 9> known = {
        "schema_version", "fit",         "trace", "record", "dynamometer",
        "cutter",         "cutter_file", "cut",   "study"};
    for (const core::Member& member : root_.table()) {
      if (member.key == "study") {
        faults_.add(member.value.place,
                    "this is a study: millstudy run computes it; a fit file has [fit]");
      } else if (std::find(known.begin(), known.end(), member.key) == known.end()) {
        faults_.add(member.value.place, fmt::format("{} is not a section of a fit file{}",
                                                    member.key, suggestion(member.key, known)));
      }
    }
  }

  /// Visits the members of a table that are keys; says which are not. Tables among the sections of
  /// the root are left alone.
  template <class Visit>
  void for_each_key(const core::Value& table, std::string_view section, const Visit& visit) {
    std::vector<std::string_view> names;
    for (const std::span<const Key> keys : fit_keys().sections) {
      for (const Key& key : keys) {
        const bool inside = section.empty() ? key.path.find('.') == std::string_view::npos
                                            : key.path.starts_with(section) &&
                                                  key.path.substr(section.size()).starts_with('.');
        if (inside) names.push_back(key.path.substr(section.empty() ? 0 : section.size() + 1));
      }
    }
    for (const core::Member& member : table.table()) {
      const std::string path =
          section.empty() ? member.key : fmt::format("{}.{}", section, member.key);
      if (const Key* key = fit_keys().find_key(path)) {
        faults_.collect([&] { visit(*key, member.value); });
      } else if (!section.empty()) {
        faults_.add(member.value.place, fmt::format("{} is not a key of a fit file{}", path,
                                                    suggestion(member.key, names)));
      }
    }
  }

  const core::Value* section(std::string_view name) {
    const core::Value* found = root_.find(name);
    if (found && !found->is_table()) {
      faults_.add(found->place, fmt::format("{} must be a table, not {}", name, type_name(*found)));
      return nullptr;
    }
    return found;
  }

  static const core::Value& as_table(const Key& key, const core::Value& value) {
    if (!value.is_table()) {
      throw core::InputError(value.place,
                             fmt::format("{} must be a table, not {}", key.path, type_name(value)));
    }
    return value;
  }

  static std::vector<std::string> words(const Key& key, const core::Value& value) {
    if (!value.is_array()) {
      throw core::InputError(value.place,
                             fmt::format("{} must be a list of {}, not {}", key.path,
                                         fmt::join(key.choices, ", "), type_name(value)));
    }
    std::vector<std::string> out;
    for (const core::Value& item : value.array()) {
      if (!item.is_string() ||
          std::find(key.choices.begin(), key.choices.end(), item.string()) == key.choices.end()) {
        throw core::InputError(item.place,
                               fmt::format("{} holds {}; it is a list of {}", key.path,
                                           item.is_string() ? fmt::format("\"{}\"", item.string())
                                                            : std::string(type_name(item)),
                                           fmt::join(key.choices, ", ")));
      }
      out.push_back(item.string());
    }
    return out;
  }

  // --- [fit]

  void read_fit() {
    const core::Value* fit = section("fit");
    if (!fit) {
      if (!root_.find("fit"))
        faults_.add(whole(), "[fit] is missing: the method and what is estimated");
      return;
    }
    std::vector<std::string> estimate = {"phase", "spindle_speed", "runout", "offset"}, shared;
    int knots = 60;
    identify::FitSettings& s = file_.settings;
    const core::Value* estimate_value = fit;
    for_each_key(*fit, "fit", [&](const Key& key, const core::Value& value) {
      const std::string_view name = key.name();
      if (key.type == KeyType::table) return read_known(name == "fixed", as_table(key, value));
      if (key.type == KeyType::choices) {
        const std::vector<std::string> list = words(key, value);
        if (name == "estimate") estimate = list, estimate_value = &value;
        if (name == "shared") shared = list;
        if (name == "axes") {
          for (int axis = 0; axis < 3; ++axis) s.axes[axis] = has(list, kAxes[axis]);
        }
        return;
      }
      const Setting setting = checked_setting(key, value);
      const auto* number = std::get_if<double>(&setting);
      const auto* text = std::get_if<std::string>(&setting);
      if (name == "name") file_.name = *text, name_place_ = value.place;
      if (name == "description") file_.description = *text;
      if (name == "method" && *text == "average") file_.method = FitMethod::average;
      if (name == "model") {
        file_.choose_model = *text == "auto";
        if (*text == "per_height") s.model = identify::Model::per_height;
        if (*text == "exponential") s.model = identify::Model::exponential;
      }
      if (name == "weights") s.weigh_records_alike = *text == "records";
      if (name == "loss" && *text == "huber") s.loss = identify::Loss::huber;
      if (name == "loss" && *text == "cauchy") s.loss = identify::Loss::cauchy;
      if (name == "loss_scale_N") s.loss_scale = *number;
      if (name == "phase_drift_knots") knots = static_cast<int>(*number);
      if (name == "runout_limit_mm") s.runout_limit = *number;
      if (name == "reference_chip_thickness_mm") s.reference_chip_thickness = *number;
      if (name == "below_Hz") s.below = *number;
      if (name == "tolerance") s.tolerance = *number;
      if (name == "bootstrap") s.bootstrap = static_cast<int>(*number);
      if (name == "seed") s.seed = static_cast<int>(*number);
      if (name == "max_iterations") s.max_iterations = static_cast<int>(*number);
    });
    if (!fit->find("name")) miss("fit.name");
    check_name();
    check_average(*fit);
    if (s.loss != identify::Loss::none && !(s.loss_scale > 0.0) && !fit->find("loss_scale_N")) {
      faults_.add(fit->find("loss")->place,
                  "fit.loss needs fit.loss_scale_N, the residual from which it counts less");
    }
    const auto treated = [&](std::string_view word) {
      return !has(estimate, word) ? identify::Estimated::no
             : has(shared, word)  ? identify::Estimated::shared
                                  : identify::Estimated::per_record;
    };
    for (const std::string& word : shared) {
      if (!has(estimate, word)) {
        faults_.add(fit->find("shared")->place,
                    fmt::format("fit.shared holds {}, which fit.estimate does not", word));
      }
    }
    s.phase = treated("phase");
    s.spindle_speed = treated("spindle_speed");
    s.runout = treated("runout");
    s.offset = treated("offset");
    s.drift = treated("drift");
    s.phase_drift_knots = has(estimate, "phase_drift") ? knots : 0;
    s.estimate_dynamometer = has(estimate, "dynamometer");
    estimate_place_ = estimate_value->place;
  }

  /// A regression of means has no use for these, and would give another answer than was asked for.
  void check_average(const core::Value& fit) {
    if (file_.method != FitMethod::average) return;
    for (const char* name : {"model", "axes", "weights", "loss", "below_Hz", "fixed", "prior"}) {
      if (const core::Value* given = fit.find(name)) {
        faults_.add(given->place,
                    fmt::format("fit.{} is for method = \"instantaneous\" only", name));
      }
    }
  }

  void check_name() {
    const std::string& name = file_.name;
    const bool fine = !name.empty() && name.size() <= 100 && name.front() != '.' &&
                      std::all_of(name.begin(), name.end(), [](char c) {
                        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' ||
                               c == '-' || c == '.' || c == '+';
                      });
    if (fine || name_place_.line == 0) return;
    faults_.add(
        name_place_,
        fmt::format("fit.name = \"{}\" names the result file: use 1 to 100 letters, digits, "
                    "_ - + and dots inside",
                    name));
  }

  double number(const core::Value& value, const std::string& what) {
    if (!value.is_number() || !std::isfinite(value.number())) {
      throw core::InputError(value.place, fmt::format("{} must be a number", what));
    }
    return value.number();
  }

  void read_known(bool fixed, const core::Value& table) {
    const std::string prefix = fixed ? "fit.fixed." : "fit.prior.";
    for (const core::Member& member : table.table()) {
      faults_.collect([&] {
        const auto at = std::find(kCoefficients.begin(), kCoefficients.end(), member.key);
        if (at == kCoefficients.end()) {
          throw core::InputError(
              member.value.place,
              fmt::format("{}{} is not one of {}{}", prefix, member.key,
                          fmt::join(kCoefficients, ", "), suggestion(member.key, kCoefficients)));
        }
        identify::Known& known = file_.settings.known[at - kCoefficients.begin()];
        if (fixed) {
          known.fixed = number(member.value, prefix + member.key);
          return;
        }
        const core::Value* mean = member.value.find("mean");
        const core::Value* deviation = member.value.find("deviation");
        if (!mean || !deviation || member.value.table().size() != 2) {
          throw core::InputError(
              member.value.place,
              fmt::format("{}{} must be {{ mean = ..., deviation = ... }}", prefix, member.key));
        }
        known.mean = number(*mean, prefix + member.key + ".mean");
        known.deviation = number(*deviation, prefix + member.key + ".deviation");
        if (!(*known.deviation > 0.0)) {
          throw core::InputError(deviation->place,
                                 fmt::format("{}{}.deviation must be > 0", prefix, member.key));
        }
      });
    }
  }

  // --- [[dynamometer.x]]

  void read_modes() {
    const core::Value* dynamometer = section("dynamometer");
    bool any = false;
    if (dynamometer) {
      for (const core::Member& member : dynamometer->table()) {
        const auto axis = std::find(kAxes.begin(), kAxes.end(), member.key) - kAxes.begin();
        if (axis == 3 || !member.value.is_array()) {
          faults_.add(member.value.place,
                      "dynamometer has lists of modes: [[dynamometer.x]], y and z");
          continue;
        }
        for (const core::Value& item : member.value.array()) {
          read_mode(item, static_cast<int>(axis));
          any = true;
        }
      }
    }
    if (file_.settings.estimate_dynamometer && !any) {
      faults_.add(estimate_place_,
                  "fit.estimate holds dynamometer, which needs modes to begin with: "
                  "[[dynamometer.x]] with frequency_Hz, damping_ratio and gain");
    }
  }

  void read_mode(const core::Value& item, int axis) {
    if (!item.is_table()) {
      return faults_.add(item.place,
                         fmt::format("a mode must be a table, not {}", type_name(item)));
    }
    dynamics::DynamometerMode mode;
    mode.gain = 1.0;
    const std::string section = fmt::format("dynamometer.{}", kAxes[axis]);
    for_each_key(item, section, [&](const Key& key, const core::Value& value) {
      const double x = std::get<double>(checked_setting(key, value));
      if (key.name() == "frequency_Hz") mode.mode.natural_frequency = 2.0 * core::kPi * x;
      if (key.name() == "damping_ratio") mode.mode.damping_ratio = x;
      if (key.name() == "gain") mode.gain = x;
    });
    for (const char* name : {"frequency_Hz", "damping_ratio"}) {
      if (!item.find(name)) {
        faults_.add(item.place, fmt::format("dynamometer.{}.{} is missing", kAxes[axis], name));
      }
    }
    file_.settings.dynamometer[axis].push_back(mode);
  }

  // --- [trace], [[record]]

  void read_records() {
    const core::Value* records = root_.find("record");
    if (!records || !records->is_array() || records->array().empty()) {
      return faults_.add(records ? records->place : whole(),
                         "there is no [[record]]: one for each measured cut, with its file");
    }
    constexpr std::size_t kMost = 1000;
    if (records->array().size() > kMost) {
      return faults_.add(records->place, fmt::format("more than {} records", kMost));
    }
    TraceSource defaults;
    if (const core::Value* trace = section("trace")) {
      for_each_key(*trace, "trace", [&](const Key& key, const core::Value& value) {
        read_source(key, value, defaults);
      });
    }
    std::vector<std::string> told;
    for (const core::Value& item : records->array()) {
      if (!item.is_table()) {
        faults_.add(item.place, fmt::format("a record must be a table, not {}", type_name(item)));
        continue;
      }
      read_record(item, defaults, told);
    }
    number_equal_names();
    if (file_.settings.phase == identify::Estimated::no) {
      for (const FitRecord& record : file_.records) {
        if (!record.phase) {
          faults_.add(record.place,
                      "record.phase_deg is missing: fit.estimate does not hold phase");
        }
        file_.settings.known_phase.push_back(record.phase.value_or(0.0));
      }
    }
  }

  /// Records of one file are told apart: slots.mat (1), slots.mat (2).
  void number_equal_names() {
    std::map<std::string, int> counts, numbers;
    for (const FitRecord& record : file_.records) ++counts[record.name];
    for (FitRecord& record : file_.records) {
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
        const auto axis = std::find(kAxes.begin(), kAxes.end(), member.key) - kAxes.begin();
        if (axis == 3 || !member.value.is_string()) {
          throw core::InputError(
              member.value.place,
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
          const double x = number(member.value, fmt::format("{}.{}", key.path, member.key));
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

  void read_record(const core::Value& item, const TraceSource& defaults,
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
          faults_.collect([&] { read_source(key, *value, record.source); });
          remove(own, key.name());
        }
      }
    }
    for_each_key(own, "record", [&](const Key& key, const core::Value& value) {
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
      faults_.add(item.place, "record.file is missing: the file of its trace");
    if (std::all_of(record.source.axes.begin(), record.source.axes.end(),
                    [](const std::string& axis) { return axis.empty(); }) &&
        !item.find("axes") && !(root_.find("trace") && root_.find("trace")->find("axes"))) {
      faults_.add(item.place, missing(*fit_keys().find_key("trace.axes")));
    }
    if (record.name.empty()) {
      record.name = std::filesystem::path(record.source.file).filename().string();
    }
    read_cut(cut && cut->is_table() ? cut : nullptr, record, told);
    file_.records.push_back(std::move(record));
    file_.cutter = file_.records.front().cut.cutter;
  }

  /// Cutter and cut are checked as those of a study of one point; a fault that all records share is
  /// told once.
  void read_cut(const core::Value* change, FitRecord& record, std::vector<std::string>& told) {
    const core::Place place = whole();
    const auto text = [&](const char* t) { return core::Value{std::string(t), place}; };
    core::Value study{core::Value::Table{}, place}, coefficients{core::Value::Table{}, place};
    study.table() = {{"name", text("fit")}, {"kind", text("force")}};
    for (const std::string_view name : kCoefficients) {
      coefficients.table().push_back({std::string(name), {0.0, place}});
    }
    core::Value tree{core::Value::Table{}, place};
    tree.table() = {{"schema_version", {std::int64_t{1}, place}},
                    {"study", std::move(study)},
                    {"coefficients", std::move(coefficients)}};
    for (const char* name : {"cutter_file", "cutter", "cut"}) {
      if (const core::Value* given = root_.find(name)) tree.table().push_back({name, *given});
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
      record.cut = resolve(tree, load_).base;
    } catch (const core::InputError& error) {
      for (const core::Fault& fault : error.faults()) {
        const std::string line = to_string(fault);
        if (std::find(told.begin(), told.end(), line) != told.end()) continue;
        told.push_back(line);
        faults_.add(fault.place, fault.text);
      }
    }
  }

  const core::Value& root_;
  const FileLoader& load_;
  Faults faults_;
  FitFile file_;
  core::Place name_place_;
  core::Place estimate_place_;
};

}  // namespace

FitFile read_fit_file(const core::Value& root, const FileLoader& load) {
  return Reader(root, load).run();
}

}  // namespace millstudy::study
