// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sweep/layout.h"

namespace millstudy::sweep {

/// The attribute of that name and form, if there is one.
template <class Form>
std::optional<Form> attribute(const Layout& layout, std::string_view name) {
  for (const auto& [key, value] : layout.attributes) {
    const auto* found = std::get_if<Form>(&value);
    if (key == name && found) return *found;
  }
  return std::nullopt;
}

inline std::string text_attribute(const Layout& layout, std::string_view name) {
  return attribute<std::string>(layout, name).value_or("");
}

}  // namespace millstudy::sweep
