// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

#include "study/canonical_text.h"
#include "study/choice_rules.h"
#include "study/curve_file.h"
#include "study/file_axes.h"
#include "study/outputs.h"
#include "study/quantity.h"
#include "study/section_file.h"
#include "study/study.h"
#include "study/suggest.h"
#include "study/sweep_section.h"
#include "study/validity.h"

namespace millstudy::study {
namespace {

/// The choice that a setting is, for Given; of other keys none.
std::vector<std::string> choices_of(const Key& key, const Setting& setting) {
  if (key.type != KeyType::choice) return {};
  return {std::get<std::string>(setting)};
}

/// One study from its tree. Every step collects its faults; only what cannot go on throws.
class Resolver {
 public:
  Resolver(const core::Value& root, const FileLoader& load)
      : tree_(root),
        load_([&load, folder = std::filesystem::path(root.place.file).parent_path()](
                  const std::string& name) { return load((folder / name).string()); }) {
    given_.file = {root.place.file, 0};
  }

  Study run() {
    find_kind();
    lift_file_key("cutter_file", "cutter");
    lift_file_key("coefficients_file", "coefficients");
    lift_file_key("modes_file", "modes");
    faults_.collect([&] { number_lists(tree_, "", *study_.kind); });
    read_table(tree_, "");
    const FileSettings read_file = [this](const Key& key, const core::Value& path) {
      return settings_of_file(key, path, *study_.kind, load_);
    };
    if (const core::Value* sweep = tree_.find("sweep")) {
      read_sweep(*sweep, read_file, study_, given_, faults_);
      settle_file_axes(study_, given_, is_own_, faults_);
    }
    find_missing();
    make_base();
    check_keys();
    faults_.throw_if_any();
    study_.kind->check(given_, study_.base, faults_);
    check_limits();
    check_name();
    study_.outputs = asked_outputs(study_, settings_, given_);
    check_outputs(study_, given_, faults_);
    faults_.throw_if_any();
    study_.columns = study_.kind->columns(study_.outputs);
    study_.warnings = left_validity(study_, given_);
    if (study_.kind->notes) {
      for (core::Fault& note : study_.kind->notes(given_, study_.base)) {
        study_.notes.push_back(std::move(note));
      }
    }
    study_.canonical = canonical_text(study_, settings_, given_);
    study_.settings = settings_text(study_, settings_, given_);
    return std::move(study_);
  }

 private:
  /// Without a version and a kind no key can be judged: these faults are reported alone.
  void find_kind() {
    if (!tree_.is_table()) throw core::InputError(given_.file, "a study must be a table");
    const core::Value* version = tree_.find("schema_version");
    if (version && version->is_number() && version->number() != 1.0) {
      throw core::InputError(
          version->place,
          fmt::format("schema_version = {} is not known: this program reads 1", version->number()));
    }
    const core::Value* section = tree_.find("study");
    const core::Value* kind = section ? section->find("kind") : nullptr;
    std::vector<std::string_view> names;
    for (const Kind* known : kinds()) names.push_back(known->name);
    if (!kind) {
      throw core::InputError(
          section ? section->place : given_.file,
          fmt::format("study.kind is missing: one of {}", fmt::join(names, ", ")));
    }
    if (!kind->is_string()) {
      throw core::InputError(kind->place,
                             fmt::format("study.kind must be a string, not {}", type_name(*kind)));
    }
    for (const Kind* known : kinds()) {
      if (known->name == kind->string()) study_.kind = known;
    }
    if (!study_.kind) {
      throw core::InputError(
          kind->place, fmt::format("study.kind = \"{}\" must be one of {}{}", kind->string(),
                                   fmt::join(names, ", "), suggestion(kind->string(), names)));
    }
    known_ = key_paths(*study_.kind);
  }

  /// `cutter_file = ...` before any section means [cutter] cutter_file = ...
  void lift_file_key(std::string_view name, std::string_view section_name) {
    core::Value::Table& root = tree_.table();
    const auto at = std::find_if(root.begin(), root.end(),
                                 [&](const core::Member& member) { return member.key == name; });
    if (at == root.end()) return;
    core::Member file = std::move(*at);
    root.erase(at);
    core::Value* section = tree_.find(section_name);
    if (!section) {
      root.push_back({std::string(section_name), {core::Value::Table{}, file.value.place}});
      section = &root.back().value;
    }
    if (section->is_table()) section->table().push_back(std::move(file));
  }

  /// The section as the key table spells it, which outlives this study's text.
  std::string_view section_named(std::string_view path) const {
    for (const std::string_view key : known_) {
      if (key.starts_with(path)) return key.substr(0, path.size());
    }
    return {};
  }

  void read_table(const core::Value& table, const std::string& prefix) {
    for (const auto& [name, value] : table.table()) {
      const std::string path = prefix.empty() ? name : prefix + '.' + name;
      if (path == "sweep") continue;
      if (path == "path.curve" && study_.kind->find_key("path.curve_file")) {
        read_inline_curve(value);
      } else if (const Key* key = study_.kind->find_key(path)) {
        read_key(*key, value);
      } else if (study_.kind->has_section(path)) {
        if (value.is_table()) {
          read_table(value, path);
        } else {
          faults_.add(value.place,
                      fmt::format("{} must be a table, not {}", path, type_name(value)));
          reported_.push_back(section_named(path));
        }
      } else {
        refuse_unknown(path, value);
      }
    }
  }

  void refuse_unknown(const std::string& path, const core::Value& value) {
    for (const Kind* other : kinds()) {
      const std::vector<std::string_view> keys = key_paths(*other);
      const bool known = std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
        return key == path || (value.is_table() && key.starts_with(path + '.'));
      });
      if (known) {
        return faults_.add(value.place, fmt::format("{} is not used by kind {}: leave it out", path,
                                                    study_.kind->name));
      }
    }
    const std::string_view meant = meant_by(path, value.is_table());
    faults_.add(value.place, fmt::format("{} is not a {} of kind {}{}{}", path,
                                         value.is_table() ? "section" : "key", study_.kind->name,
                                         meant.empty() ? "" : "; did you mean ",
                                         meant.empty() ? "" : fmt::format("{}?", meant)));
    if (!meant.empty()) reported_.push_back(meant);
  }

  /// The key or section that is nearest to an unknown one: the same name elsewhere, or a
  /// misspelling.
  std::string_view meant_by(std::string_view path, bool section) const {
    std::vector<std::string_view> words = known_;
    if (section) {
      for (std::string_view& word : words) word = word.substr(0, word.rfind('.'));
    } else {
      for (const std::string_view known : known_) {
        if (path.substr(path.rfind('.') + 1) == study_.kind->find_key(known)->name()) return known;
      }
    }
    return nearest(path, words);
  }

  void read_key(const Key& key, const core::Value& value) {
    if (given_.has(key.path)) {
      return faults_.add(value.place, fmt::format("{} is given twice", key.path));
    }
    given_.entries[key.path] = {&key, value.place, false};
    const bool fine = faults_.collect([&] {
      if (key.type == KeyType::file) {
        std::vector<Assignment> assignments = settings_of_file(key, value, *study_.kind, load_);
        check_not_idle(key, assignments, is_own_, value.place);
        for (Assignment& assignment : assignments) keep(std::move(assignment), key, value);
      } else {
        Setting setting = checked_setting(key, value);
        given_.entries[key.path].choices = choices_of(key, setting);
        settings_.insert_or_assign(key.path, std::move(setting));
      }
    });
    if (!fine && key.type == KeyType::file)
      reported_.push_back(key.path.substr(0, key.path.find('.')));
  }

  /// What a file says yields to what the study says itself.
  void keep(Assignment assignment, const Key& file, const core::Value& value) {
    const Key& key = *assignment.key;
    const std::string_view path = key.path;
    if (&key != &file && is_own(key)) return;
    given_.entries.try_emplace(
        path, Given::Entry{&key, value.place, false, choices_of(key, assignment.setting)});
    settings_.insert_or_assign(path, std::move(assignment.setting));
  }

  void read_inline_curve(const core::Value& value) {
    const Key* key = study_.kind->find_key("path.curve_file");
    if (tree_.find("path")->find("curve_file")) {
      return faults_.add(value.place, "path.curve contradicts path.curve_file: give one of them");
    }
    given_.entries[key->path] = {key, value.place, false};
    faults_.collect([&] { settings_.insert_or_assign(key->path, read_curve(value)); });
  }

  void find_missing() {
    for (const std::span<const Key> section : study_.kind->sections) {
      for (const Key& key : section) {
        if (is_needed(key, *study_.kind, given_) && !given_.has(key.path) &&
            !is_reported(key.path)) {
          faults_.add(given_.file, missing(key));
        }
      }
    }
  }

  /// Rules on keys; one that stands there under a wrong name counts as given, and a section that is
  /// no section is judged by nothing.
  void check_keys() {
    check_uses(*study_.kind, given_, faults_);
    Given meant = given_;
    for (const std::string_view path : reported_) {
      const Key* key = study_.kind->find_key(path);
      if (!key) return;
      meant.entries.try_emplace(key->path, Given::Entry{key, given_.file, false});
    }
    study_.kind->check_keys(meant, study_.base, faults_);
  }

  /// A key under a wrong name, or in a file with faults, is not reported as missing too.
  bool is_reported(std::string_view path) const {
    return std::any_of(reported_.begin(), reported_.end(), [&](std::string_view meant) {
      return path == meant || (path.starts_with(meant) && path[meant.size()] == '.');
    });
  }

  /// True if the study gives the key in its own section: then no file decides it.
  bool is_own(const Key& key) const {
    const core::Value* at = &tree_;
    for (std::string_view rest = key.path; at && !rest.empty();) {
      const std::size_t dot = rest.find('.');
      at = at->find(rest.substr(0, dot));
      rest = dot == std::string_view::npos ? std::string_view() : rest.substr(dot + 1);
    }
    return at != nullptr;
  }

  /// A limit on a key that no point has would skip them all.
  void check_limits() {
    for (const Limit& limit : study_.limits) {
      const Key* key = study_.kind->find_key(limit.quantity);
      if (key && may_be_list(*key)) {
        faults_.add(
            limit.place,
            fmt::format("sweep.where: quantity = \"{}\" is a list in this study", key->path));
      }
      if (!key || given_.has(key->path) || !std::holds_alternative<Optional>(key->fallback))
        continue;
      const std::vector<std::string_view> derived = quantity_names(*study_.kind);
      const bool computed = std::find(derived.begin(), derived.end(), key->name()) != derived.end();
      faults_.add(
          limit.place,
          fmt::format("sweep.where: quantity = \"{}\" is not given in this study{}", key->path,
                      computed ? fmt::format(": use {}, which is computed", key->name()) : ""));
    }
  }

  bool may_be_list(const Key& key) const {
    const std::vector<Setting> all = all_settings(key, study_, settings_, given_);
    return std::any_of(all.begin(), all.end(), [](const Setting& setting) {
      return std::holds_alternative<std::vector<double>>(setting);
    });
  }

  void make_base() {
    for (const std::span<const Key> section : study_.kind->sections) {
      for (const Key& key : section) {
        Setting fallback = default_setting(key);
        if (!std::holds_alternative<std::monostate>(fallback)) {
          settings_.try_emplace(key.path, std::move(fallback));
        }
        const auto setting = settings_.find(key.path);
        if (setting != settings_.end() && key.field) apply(key, setting->second, study_.base);
      }
    }
    study_.name = text_setting("study.name");
    study_.description = text_setting("study.description");
    const auto limit = settings_.find("study.point_time_limit_s");
    if (limit != settings_.end()) study_.point_time_limit = std::get<double>(limit->second);
  }

  /// Empty where the key is missing or at fault; that is reported elsewhere.
  std::string text_setting(std::string_view path) const {
    const auto setting = settings_.find(path);
    return setting == settings_.end() ? "" : std::get<std::string>(setting->second);
  }

  void check_name() {
    const std::string& name = study_.name;
    const bool fine = !name.empty() && name.size() <= 100 && name.front() != '.' &&
                      std::all_of(name.begin(), name.end(), [](char c) {
                        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' ||
                               c == '-' || c == '.' || c == '+';
                      });
    if (fine) return;
    faults_.add(given_.place({"study.name"}),
                fmt::format("study.name = \"{}\" names the result file: use 1 to 100 letters, "
                            "digits, _ - + and dots inside",
                            name));
  }

  core::Value tree_;
  FileLoader load_;  // by a name relative to the folder of the study
  IsOwn is_own_ = [this](const Key& key) { return is_own(key); };
  Faults faults_;
  Given given_;
  Study study_;
  std::vector<std::string_view> known_;
  std::vector<std::string_view> reported_;  // keys and sections whose fault is known
  SettingMap settings_;
};

}  // namespace

Study resolve(const core::Value& root, const FileLoader& load) {
  return Resolver(root, load).run();
}

}  // namespace millstudy::study
