// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace millstudy::io {

/// What is refused before the parser sees it: the line (from 1), and what is wrong there.
struct Stumble {
  int line = 0;
  std::string why;
};

/// First place of a UTF-8 TOML text that toml++ 3.3 should not be given, if there is one:
/// - a dotted key of more than `most_key_parts` parts. Each part is one more level of tables, and
///   trees are destroyed recursively: a key of 1e5 parts would overflow the stack in the parser's
///   own destructor.
/// - a character beyond ASCII outside texts and comments. TOML has no place for one, and it is
///   mostly one that looks like what is meant.
/// A byte order mark at the start is passed over.
std::optional<Stumble> find_stumble(std::string_view toml, int most_key_parts);

}  // namespace millstudy::io
