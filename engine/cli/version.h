// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace millstudy::cli {

/// What made a result: recorded in every result file.
struct Build {
  std::string version;
  std::string git_revision;  ///< "unknown" outside a git checkout
  bool git_dirty = false;    ///< built from a changed tree
  std::string compiler;
  std::string isa;  ///< instruction set extensions that floating-point results may depend on
};

Build build();

/// "millstudy 0.1.0 (2ed5dbe)", with "changed" if the tree was
std::string version_text();

}  // namespace millstudy::cli
