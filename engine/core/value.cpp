// SPDX-License-Identifier: MIT
#include "core/value.h"

#include <array>

namespace millstudy::core {

bool Value::is_number() const {
  return std::holds_alternative<std::int64_t>(data) || std::holds_alternative<double>(data);
}

double Value::number() const {
  if (const auto* integer = std::get_if<std::int64_t>(&data)) return static_cast<double>(*integer);
  return std::get<double>(data);
}

const Value* Value::find(std::string_view key) const {
  if (!is_table()) return nullptr;
  for (const Member& member : table()) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

Value* Value::find(std::string_view key) {
  return const_cast<Value*>(static_cast<const Value*>(this)->find(key));
}

std::string_view type_name(const Value& value) {
  static constexpr std::array<std::string_view, 6> kNames = {
      "true or false", "a whole number", "a number", "a string", "a list", "a table"};
  return kNames[value.data.index()];
}

}  // namespace millstudy::core
