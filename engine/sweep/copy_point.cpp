// SPDX-License-Identifier: MIT
#include "sweep/copy_point.h"

#include <utility>

namespace millstudy::sweep {

void copy_point(Block& from, std::int64_t k, Block& to, std::int64_t i) {
  to.status[i] = from.status[k];
  to.failures[i] = std::move(from.failures[k]);
  const std::size_t columns = from.values.size() / static_cast<std::size_t>(from.count);
  for (std::size_t c = 0; c < columns; ++c) to.value(c, i) = from.value(c, k);
  if (!from.traces.empty() && !to.traces.empty()) to.traces[i] = std::move(from.traces[k]);
}

}  // namespace millstudy::sweep
