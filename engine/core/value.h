// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/error.h"

namespace millstudy::core {

struct Member;

/// A tree of values as read from a file: each knows its file and line.
///
/// Tables keep the order of the file, because the order of sweep axes is the order of dimensions.
/// The tree is format-free: io makes it from TOML, a test from literals.
struct Value {
  using Array = std::vector<Value>;
  using Table = std::vector<Member>;

  std::variant<bool, std::int64_t, double, std::string, Array, Table>
      data;  ///< false where nothing is given
  Place place;

  bool is_number() const;
  bool is_string() const { return std::holds_alternative<std::string>(data); }
  bool is_array() const { return std::holds_alternative<Array>(data); }
  bool is_table() const { return std::holds_alternative<Table>(data); }

  /// An integer or a real as double; call only when is_number().
  double number() const;
  const std::string& string() const { return std::get<std::string>(data); }
  const Array& array() const { return std::get<Array>(data); }
  const Table& table() const { return std::get<Table>(data); }
  Table& table() { return std::get<Table>(data); }

  /// The member of that name, or nullptr; also nullptr when this is no table.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
};

struct Member {
  std::string key;
  Value value;
};

/// What a person calls it: "a number", "a string", "a table", ...
std::string_view type_name(const Value& value);

}  // namespace millstudy::core
