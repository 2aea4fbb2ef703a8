// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "io/traces/source.h"
#include "io/traces/tdms_metadata.h"

namespace millstudy::io::tdms {

/// Scales of a channel from the stored value to the last one: polynomials one after another.
struct Scale {
  /// Coefficients by ascending power; a linear scale has intercept and slope.
  std::vector<std::vector<double>> polynomials;
};

/// The scales by the properties NI_Scale[i]_...; nullopt: the values are stored in their unit.
///
/// @throws core::InputError for scales other than Linear and Polynomial
std::optional<Scale> scale_of(const Source& source, const Channel& channel);

double apply(const Scale& scale, double value);

}  // namespace millstudy::io::tdms
