// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "identify/fit.h"

namespace millstudy::identify {

/// What the average of one record says.
struct RecordAverage {
  double revolutions = 0.0;           ///< whole ones that were averaged
  std::array<double, 3> mean{};       ///< measured [N]; NaN where not measured
  std::array<double, 3> predicted{};  ///< by the coefficients found [N]
};

/// The outcome of average_fit().
struct AverageFit {
  force::Coefficients coefficients;
  std::vector<Estimate> estimates;  ///< Ktc Krc Kac Kte Kre Kae, in this order
  std::vector<double> covariance;   ///< shape (6, 6)
  std::vector<double> correlation;  ///< shape (6, 6)
  double condition_number = 0.0;
  std::array<double, 3> r_squared{};  ///< of the mean forces along x, y, z over the records
  std::vector<RecordAverage> records;
  std::vector<std::string> warnings;
};

/// Budak, Altintas and Armarego: coefficients by linear regression of mean forces, over records
/// that differ in feed (or depth, immersion), for any cutter and engagement without runout.
///
/// Means over whole revolutions by the actual spindle speed, the last samples being left out.
/// @throws core::InputError where there are too few records or axes to tell the coefficients apart
AverageFit average_fit(const cutter::Cutter& cutter, const std::vector<Record>& records);

}  // namespace millstudy::identify
