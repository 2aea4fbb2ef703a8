// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "study/study.h"

namespace millstudy::study {
namespace {

std::string count_words(const Count& count) {
  if (count.least == count.most) return fmt::format("list of {} numbers", count.least);
  if (count.most < Count{}.most) {
    return fmt::format("list of {} to {} numbers", count.least, count.most);
  }
  return "list of numbers";
}

std::string values(const Key& key) {
  switch (key.type) {
    case KeyType::choice:
      return fmt::format("{}", fmt::join(key.choices, ", "));
    case KeyType::choices:
      return fmt::format("list of {}", fmt::join(key.choices, ", "));
    case KeyType::table:
      return "table";
    case KeyType::flag:
      return "true, false";
    case KeyType::text:
      return "text";
    case KeyType::file:
      return "path of a file";
    case KeyType::integer:
      return "whole number " + key.range.words();
    case KeyType::number:
      return "number " + key.range.words();
    case KeyType::numbers:
      return count_words(key.count) + ' ' + key.range.words();
    case KeyType::number_or_numbers:
      return "number or " + count_words(key.count) + ' ' + key.range.words();
  }
  return "";
}

std::string fallback(const Key& key) {
  if (key.required()) return "required";
  if (const auto* only = std::get_if<RequiredFor>(&key.fallback)) {
    return fmt::format("required for {}", only->choice);
  }
  if (const auto* number = std::get_if<double>(&key.fallback)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string_view>(&key.fallback)) {
    return fmt::format("\"{}\"", *text);
  }
  return key.type == KeyType::flag ? "false" : "";
}

std::string meaning(const Key& key) {
  const OnlyFor& only = key.only_for;
  if (only.key.empty()) return std::string(key.help);
  return fmt::format("{} ({} {})", key.help, only.key.substr(only.key.rfind('.') + 1),
                     fmt::join(only.choices, ", "));
}

bool is_required(const Key& key) {
  return key.required() || std::holds_alternative<RequiredFor>(key.fallback);
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
      if (key.item > 0) continue;  // as the first
      if (markdown) {
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.path, key.unit, values(key),
                            fallback(key), meaning(key));
      } else {
        text += fmt::format(
            "  {:<30} {:<7} {}\n  {:<38} {}{}{}\n", key.path, key.unit, meaning(key), "",
            values(key), fallback(key).empty() ? "" : "; ",
            is_required(key) || fallback(key).empty() ? fallback(key) : "default " + fallback(key));
      }
    }
  }
  return text;
}

}  // namespace millstudy::study
