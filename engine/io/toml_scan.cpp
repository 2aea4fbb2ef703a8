// SPDX-License-Identifier: MIT
#include "io/toml_scan.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <fmt/core.h>

namespace millstudy::io {
namespace {

/// End of the string that starts at `at` with a quote: one past its closing quote.
std::size_t skip_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool multi_line = text.substr(at, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
  std::size_t i = at + (multi_line ? 3 : 1);
  for (; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\' && (multi_line || text.substr(i + 1, 1) != "\n")) {
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
         c == '\t' || c == '+';
}

bool is_ascii(char c) {
  return (static_cast<unsigned char>(c) & 0x80) == 0;
}

/// What to do about the character beyond ASCII that starts the text.
std::string about_character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::string character(text.substr(0, lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4));
  const auto is_one_of = [&](std::initializer_list<std::string_view> list) {
    return std::find(list.begin(), list.end(), character) != list.end();
  };
  if (is_one_of({"“", "”", "„", "«", "»", "‘", "’", "‚", "´"})) {
    return fmt::format("{} is no quote of TOML: text goes in straight \"quotes\"", character);
  }
  if (is_one_of({"°", "µ", "μ", "²", "³", "Ω"})) {
    return fmt::format("{}: no unit after a number: the key's name says it", character);
  }
  if (is_one_of({"−", "–", "—"})) return fmt::format("{} is no minus sign: write -", character);
  if (is_one_of({"\u00a0", "\u2007", "\u2009", "\u200b", "\u202f", "\u3000", "\ufeff"})) {
    return "a space that is not a plain one (copied from a page or a document?): type it again";
  }
  return fmt::format(
      "{} cannot stand there: names of keys are letters a to z, digits, _ and -; texts go in "
      "\"quotes\"",
      character);
}

}  // namespace

std::optional<Stumble> find_stumble(std::string_view toml, int most_key_parts) {
  int line = 1;
  int parts = 1;
  for (std::size_t i = toml.starts_with("\xef\xbb\xbf") ? 3 : 0; i < toml.size();) {
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
    if (!is_ascii(c)) return Stumble{line, about_character(toml.substr(i))};
    if (c == '.') {
      if (++parts > most_key_parts) {
        return Stumble{line, fmt::format("a dotted key of more than {} parts", most_key_parts)};
      }
    } else if (!is_key_character(c)) {
      parts = 1;
    }
    if (c == '\n') ++line;
    ++i;
  }
  return std::nullopt;
}

}  // namespace millstudy::io
