// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace millstudy::io {

/// Line of the first dotted key of more than `most` parts in a TOML text, if there is one.
///
/// Every part of a dotted key is one more level of tables, and trees are destroyed recursively:
/// a key of 1e5 parts would overflow the stack in the parser's own destructor.
std::optional<int> find_deep_key(std::string_view toml, int most);

}  // namespace millstudy::io
