// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>

#include "core/error.h"

/// Calls what reads an input: it may be refused with faults that can be told, and not otherwise.
template <class Call>
void allow_input_errors(const Call& call) {
  try {
    call();
  } catch (const millstudy::core::InputError& error) {
    if (error.faults().empty()) std::abort();
    for (const millstudy::core::Fault& fault : error.faults()) {
      if (to_string(fault).empty()) std::abort();
    }
  }
}
