// SPDX-License-Identifier: MIT
#include "study/section_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <functional>

#include "study/curve_file.h"
#include "study/file_text.h"
#include "study/profile_file.h"
#include "study/response_file.h"
#include "study/suggest.h"

namespace millstudy::study {
namespace {

/// What coefficients were measured with; for people.
bool is_origin(std::string_view section, std::string_view name) {
  return section == "coefficients" && (name == "workpiece" || name == "tool");
}

core::Value load_named(const Key& key, const std::string& name, const core::Place& place,
                       const FileLoader& load) {
  try {
    core::Value content = load(name);
    if (content.find("study")) {
      throw core::InputError(
          content.place,
          fmt::format("is a study, not a {} file", key.name().substr(0, key.name().rfind('_'))));
    }
    return content;
  } catch (const core::InputError& error) {
    std::vector<core::Fault> faults = error.faults();
    for (core::Fault& fault : faults) {
      if (fault.place.line == 0) fault = {place, fmt::format("{}: {}", key.path, to_string(fault))};
    }
    throw core::InputError(std::move(faults));
  }
}

/// What a file that stands for a section may give: the keys of the section, without the section.
std::vector<std::string_view> names_in_file(std::string_view section, const Kind& kind) {
  std::vector<std::string_view> names;
  for (const std::string_view path : key_paths(kind)) {
    const Key* key = kind.find_key(path);
    if (key->field && path.substr(0, path.find('.')) == section) names.push_back(key->name());
  }
  return names;
}

/// What the file of a key that it sets alone holds.
Setting read_object(const Key& key, const core::Value& content) {
  Case target;
  if (std::holds_alternative<ProfilePtr*>(key.field(target))) return read_profile(content);
  if (std::holds_alternative<ResponsePtr*>(key.field(target))) return read_response(content);
  return read_curve(content);
}

bool is_number(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// What is at fault is told once: the rest of the study then sees a list as if it were right.
void number_list(core::Value& list, const std::string& path, const Kind& kind) {
  const core::InputError no_list(list.place,
                                 fmt::format("{0} must be a list of tables: [[{0}]]", path));
  if (!list.is_array()) {
    if (list.is_table()) {
      // A command line may name an entry that is not there: what is wrong about it is told below.
      const bool numbered = !list.table().empty() && is_number(list.table().front().key);
      if (numbered) return;
      list.data = core::Value::Table{{"0", list}};
    } else {
      list.data = core::Value::Table{};
    }
    throw no_list;
  }
  core::Value::Table numbered;
  Faults faults;
  for (const core::Value& item : list.array()) {
    const std::string name = std::to_string(numbered.size());
    if (!item.is_table()) {
      faults.add(item.place, no_list.faults().front().text);
    } else if (!kind.has_section(fmt::format("{}.{}", path, name))) {
      faults.add(item.place, fmt::format("{} has more than {} entries", path, name));
    } else {
      numbered.push_back({name, item});
    }
  }
  list.data = std::move(numbered);
  faults.throw_if_any();
}

/// A file that a file names: relative to the folder of that one.
core::Value beside(const std::string& file, const core::Value& name) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return {(folder / name.string()).string(), name.place};
}

}  // namespace

void number_lists(core::Value& table, const std::string& prefix, const Kind& kind) {
  if (!table.is_table()) return;
  Faults faults;
  for (core::Member& member : table.table()) {
    const std::string path = prefix.empty() ? member.key : fmt::format("{}.{}", prefix, member.key);
    if (kind.has_section(fmt::format("{}.0", path))) {
      faults.collect([&] { number_list(member.value, path, kind); });
    } else if (kind.has_section(path)) {
      faults.collect([&] { number_lists(member.value, path, kind); });
    }
  }
  faults.throw_if_any();
}

std::vector<Assignment> settings_of_file(const Key& key, const core::Value& value, const Kind& kind,
                                         const FileLoader& load) {
  const auto path = std::get<std::string>(checked_setting(key, value));
  core::Value content = load_named(key, path, value.place, load);
  if (key.field) return {{&key, read_object(key, content)}};
  const std::string section(key.path.substr(0, key.path.find('.')));
  number_lists(content, section, kind);
  std::vector<Assignment> assignments;
  Faults faults;
  const std::function<void(const core::Value&, const std::string&)> read =
      [&](const core::Value& table, const std::string& prefix) {
        for (const core::Member& entry : table.table()) {
          const std::string& name = entry.key;
          const core::Value& member = entry.value;
          const std::string full = fmt::format("{}.{}", prefix, name);
          const Key* inner = kind.find_key(full);
          if (inner && inner->field) {
            faults.collect([&] {
              Setting setting = checked_setting(*inner, member);
              if (inner->type == KeyType::file) {
                assignments.push_back(
                    settings_of_file(*inner, beside(path, member), kind, load).front());
              } else {
                assignments.push_back({inner, std::move(setting)});
              }
            });
          } else if (member.is_table() && kind.has_section(full)) {
            read(member, full);
          } else if (prefix != section || (!is_file_text(name) && !is_origin(section, name))) {
            faults.add(member.place, fmt::format("{} is not a key of a {} file{}", name, section,
                                                 suggestion(name, names_in_file(section, kind))));
          }
        }
      };
  read(content, section);
  faults.throw_if_any();
  return assignments;
}

}  // namespace millstudy::study
