// SPDX-License-Identifier: MIT
#include "io/toml_depth.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace millstudy::io {
namespace {

/// End of the string that starts at `at` with a quote: one past its closing quote.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool multi_line = text.substr(at, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
  std::size_t i = at + (multi_line ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (!multi_line && (text[i] == quote || text[i] == '\n')) {
      return text[i] == quote ? i + 1 : i;
    } else if (multi_line && text.substr(i, 3) == text.substr(at, 3)) {
      i += 3;
      while (i < text.size() && text[i] == quote) ++i;  // up to two quotes belong to the text
      return i;
    }
  }
  return text.size();
}

bool is_key_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == ' ' ||
         c == '\t' || c == '+' || (static_cast<unsigned char>(c) & 0x80) != 0;
}

}  // namespace

std::optional<int> find_deep_key(std::string_view toml, int most) {
  int line = 1;
  int parts = 1;
  for (std::size_t i = 0; i < toml.size();) {
    const char c = toml[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = std::min(skip_string(toml, i), toml.size());
      line += static_cast<int>(std::count(toml.begin() + static_cast<std::ptrdiff_t>(i),
                                          toml.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
      continue;
    }
    if (c == '#') {
      i = std::min(toml.find('\n', i), toml.size());
      continue;
    }
    if (c == '.') {
      if (++parts > most) return line;
    } else if (!is_key_character(c)) {
      parts = 1;
    }
    if (c == '\n') ++line;
    ++i;
  }
  return std::nullopt;
}

}  // namespace millstudy::io
