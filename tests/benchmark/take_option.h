// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <cstring>

namespace millstudy::baseline {

/// Takes an option of a program's own, "--speeds=", out of its command line.
/// @return its value, or `otherwise` if it is not given
inline double take_option(int& count, char** arguments, const char* name, double otherwise) {
  int kept = 1;
  for (int i = 1; i < count; ++i) {
    if (std::strncmp(arguments[i], name, std::strlen(name)) == 0) {
      otherwise = std::atof(arguments[i] + std::strlen(name));
    } else {
      arguments[kept++] = arguments[i];
    }
  }
  count = kept;
  return otherwise;
}

}  // namespace millstudy::baseline
