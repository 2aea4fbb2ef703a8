// SPDX-License-Identifier: MIT
#include "cli/open_study.h"

#include <algorithm>
#include <charconv>
#include <fmt/core.h>

#include "core/error.h"
#include "io/response_file.h"
#include "io/sha256.h"
#include "io/toml_reader.h"

namespace millstudy::cli {
namespace {

/// A value as TOML, or, where it is not TOML, as the string it is: --set cut.milling=slot.
core::Value parse_override(const std::string& text) {
  const std::string name = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw core::InputError({name, 0}, "must be key=value");
  }
  try {
    return io::parse_toml(text, name);
  } catch (const core::InputError&) {
    std::string quoted;
    for (const char c : text.substr(equals + 1)) {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
    try {
      return io::parse_toml(text.substr(0, equals) + "= \"" + quoted + '"', name);
    } catch (const core::InputError&) {
      throw core::InputError({name, 0},
                             fmt::format("\"{}\" is not a dotted key such as cut.axial_depth_mm",
                                         text.substr(0, equals)));
    }
  }
}

/// The whole override is the place: its lines mean nothing.
void forget_lines(core::Value& value) {
  value.place.line = 0;
  if (value.is_table()) {
    for (core::Member& member : value.table()) forget_lines(member.value);
  }
  if (auto* array = std::get_if<core::Value::Array>(&value.data)) {
    for (core::Value& item : *array) forget_lines(item);
  }
}

/// The entry of a list of tables that a part of a dotted key means: modes.x.0, or a new one
/// after the last; null for what is no such place.
core::Value* entry_of(core::Value& target, const std::string& key) {
  auto* list = std::get_if<core::Value::Array>(&target.data);
  std::size_t at = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), at);
  const bool whole = error == std::errc() && end == key.data() + key.size();
  if (!list || !whole || at > list->size()) return nullptr;
  if (at == list->size()) list->push_back({core::Value::Table{}, target.place});
  return &(*list)[at];
}

/// Puts what the override says over what the file says; tables are merged, all else is replaced.
void merge(core::Value& target, core::Value&& change) {
  if (target.is_array() && change.is_table() && change.table().size() == 1) {
    core::Member& member = change.table().front();
    if (core::Value* entry = entry_of(target, member.key)) {
      return merge(*entry, std::move(member.value));
    }
  }
  if (!target.is_table() || !change.is_table()) {
    target = std::move(change);
    return;
  }
  for (core::Member& member : change.table()) {
    if (core::Value* present = target.find(member.key)) {
      const bool range = present->is_table() && member.value.is_table() &&
                         (present->find("from") || member.value.find("from"));
      if (range) {
        *present = std::move(member.value);
      } else {
        merge(*present, std::move(member.value));
      }
    } else {
      target.table().push_back(std::move(member));
    }
  }
}

/// An axis decides the values of its key; a --set on the key itself would do nothing.
void refuse_swept(const study::Study& study, const core::Value& change, const std::string& prefix,
                  const std::string& text) {
  if (!change.is_table()) return;
  for (const core::Member& member : change.table()) {
    const std::string path = prefix.empty() ? member.key : prefix + '.' + member.key;
    const bool swept = std::any_of(study.axes.begin(), study.axes.end(),
                                   [&](const study::Axis& axis) { return axis.path == path; });
    if (swept) {
      throw core::InputError({"--set " + text, 0},
                             fmt::format("{0} is an axis of the sweep; set the axis instead: --set "
                                         "'sweep.axes.\"{0}\"=[...]'",
                                         path));
    }
    refuse_swept(study, member.value, path, text);
  }
}

/// A file that a study names: TOML, or a measured frequency response.
core::Value read_named(const std::string& path) {
  return io::is_response_file(path) ? io::read_response_file(path) : io::read_toml(path);
}

}  // namespace

OpenStudy open_study(const StudyOptions& options) {
  std::string file_text = io::read_text(options.file);
  core::Value root = io::parse_toml(file_text, options.file);
  std::vector<core::Value> changes;
  for (const std::string& text : options.overrides) {
    core::Value change = parse_override(text);
    forget_lines(change);
    changes.push_back(change);
    merge(root, std::move(change));
  }
  OpenStudy open{study::resolve(root, read_named), std::move(file_text), ""};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    refuse_swept(open.study, changes[i], "", options.overrides[i]);
  }
  open.hash = io::sha256_hex(open.study.canonical);
  return open;
}

void print_warnings(const study::Study& study) {
  for (const core::Fault& warning : study.warnings) {
    fmt::print(stderr, "warning: {}\n", to_string(warning));
  }
  for (const core::Fault& note : study.notes) {
    fmt::print(stderr, "note: {}\n", to_string(note));
  }
}

}  // namespace millstudy::cli
