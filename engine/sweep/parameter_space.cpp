// SPDX-License-Identifier: MIT
#include "sweep/parameter_space.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <utility>

#include "core/error.h"

namespace millstudy::sweep {

ParameterSpace::ParameterSpace(Design design, std::vector<std::int64_t> lengths)
    : design_(design), lengths_(std::move(lengths)) {
  if (lengths_.empty()) return;
  if (design_ != Design::grid) {
    if (std::adjacent_find(lengths_.begin(), lengths_.end(), std::not_equal_to<>()) !=
        lengths_.end()) {
      throw core::InputError(fmt::format(
          "sweep.axes have {} values: a zip needs axes of one length", fmt::join(lengths_, ", ")));
    }
    points_ = lengths_.front();
  } else {
    double product = 1.0;
    for (const std::int64_t length : lengths_) product *= static_cast<double>(length);
    if (product > static_cast<double>(kMostPoints)) {
      throw core::InputError(
          fmt::format("sweep.axes give {:.4g} points, more than {:.0e}; "
                      "give fewer values",
                      product, static_cast<double>(kMostPoints)));
    }
    for (const std::int64_t length : lengths_) points_ *= length;
  }
}

void ParameterSpace::indices(std::int64_t point, std::span<std::int64_t> out) const {
  if (design_ != Design::grid) {
    std::fill(out.begin(), out.end(), point);
    return;
  }
  for (std::size_t axis = lengths_.size(); axis-- > 0;) {
    out[axis] = point % lengths_[axis];
    point /= lengths_[axis];
  }
}

}  // namespace millstudy::sweep
