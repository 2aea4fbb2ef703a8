// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include "cli/commands.h"
#include "core/error.h"
#include "study/fit_file.h"
#include "study/study.h"

namespace millstudy::cli {

int print_keys(const std::string& kind, bool markdown) {
  bool found = false;
  std::vector<const study::Kind*> kinds(study::kinds().begin(), study::kinds().end());
  if (kind == "fit") kinds.push_back(&study::fit_keys());
  for (const study::Kind* known : kinds) {
    if (!kind.empty() && kind != known->name) continue;
    if (found) fmt::print("\n");
    fmt::print("{}", study::key_reference(*known, markdown));
    found = true;
  }
  if (!found) {
    std::string names;
    for (const study::Kind* known : kinds) {
      names += (names.empty() ? "" : ", ") + std::string(known->name);
    }
    throw core::InputError(fmt::format("there is no kind \"{}\": one of {}, fit", kind, names));
  }
  return kDone;
}

}  // namespace millstudy::cli
