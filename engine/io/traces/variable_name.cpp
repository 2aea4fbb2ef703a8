// SPDX-License-Identifier: MIT
#include "io/traces/variable_name.h"

#include <charconv>
#include <string_view>

#include "io/traces/text_dialect.h"

namespace millstudy::io {
namespace {

std::optional<VariableName::Slice> parse_slice(std::string_view text, std::int64_t first) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return {};
  const std::string_view row = trimmed(text.substr(0, comma));
  const std::string_view column = trimmed(text.substr(comma + 1));
  const bool is_column = row == ":";
  if (!is_column && column != ":") return {};
  const std::string_view number = is_column ? column : row;
  std::int64_t index = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
  if (error != std::errc() || end != number.data() + number.size() || index < first) return {};
  return VariableName::Slice{is_column, index - first};
}

}  // namespace

VariableName parse_variable(const std::string& text) {
  for (const std::string_view brackets : {"()", "[]"}) {
    const std::size_t open = text.rfind(brackets[0]);
    if (open == std::string::npos || text.back() != brackets[1]) continue;
    const bool matlab = brackets[0] == '(';
    const std::string_view inside = std::string_view(text).substr(open + 1, text.size() - open - 2);
    const std::optional<VariableName::Slice> slice = parse_slice(inside, matlab ? 1 : 0);
    if (slice) return {text.substr(0, open), slice, matlab};
  }
  return {text, {}, false};
}

}  // namespace millstudy::io
