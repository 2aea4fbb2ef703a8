// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/error.h"

namespace millstudy {

/// What the InputError of a call says; empty if it throws none.
template <class Call>
std::string error_text(const Call& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace millstudy
