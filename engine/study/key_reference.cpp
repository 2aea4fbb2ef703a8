// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "study/study.h"

namespace millstudy::study {
namespace {

std::string values(const Key& key) {
  switch (key.type) {
    case KeyType::choice:
      return fmt::format("{}", fmt::join(key.choices, ", "));
    case KeyType::flag:
      return "true, false";
    case KeyType::text:
      return "text";
    case KeyType::file:
      return "path of a TOML file";
    case KeyType::integer:
      return "whole number " + key.range.words();
    case KeyType::number:
      return "number " + key.range.words();
  }
  return "";
}

std::string fallback(const Key& key) {
  if (key.required()) return "required";
  if (const auto* number = std::get_if<double>(&key.fallback)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string_view>(&key.fallback)) {
    return fmt::format("\"{}\"", *text);
  }
  return key.type == KeyType::flag ? "false" : "";
}

}  // namespace

std::string key_reference(const Kind& kind, bool markdown) {
  std::string text;
  if (markdown) {
    text = fmt::format(
        "### kind = \"{}\"\n\n{}.\n\n| key | unit | values | default | meaning |\n"
        "| --- | --- | --- | --- | --- |\n",
        kind.name, kind.help);
  } else {
    text = fmt::format("kind = \"{}\": {}\n\n", kind.name, kind.help);
  }
  for (const std::span<const Key> section : kind.sections) {
    for (const Key& key : section) {
      if (markdown) {
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.path, key.unit, values(key),
                            fallback(key), key.help);
      } else {
        text += fmt::format(
            "  {:<30} {:<7} {}\n  {:<38} {}{}{}\n", key.path, key.unit, key.help, "", values(key),
            fallback(key).empty() ? "" : "; ",
            key.required() || fallback(key).empty() ? fallback(key) : "default " + fallback(key));
      }
    }
  }
  return text;
}

}  // namespace millstudy::study
