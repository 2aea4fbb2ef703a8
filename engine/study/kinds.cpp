// SPDX-License-Identifier: MIT
#include "study/kinds.h"

#include <array>

namespace millstudy::study {

std::span<const Kind* const> kinds() {
  static const std::array<const Kind*, 5> all = {
      &path_kind(), &force_kind(), &path_force_kind(), &stability_kind(), &finish_kind(),
  };
  return all;
}

}  // namespace millstudy::study
