// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "identify/average_fit.h"
#include "identify/fit.h"
#include "sweep/layout.h"

namespace millstudy::io {

/// What a fit result file holds, whichever the method.
struct FitReport {
  std::vector<identify::Estimate> estimates;  ///< those that all records share
  std::vector<double> covariance;             ///< shape (n, n) of them
  std::vector<double> correlation;
  double condition_number = 0.0;
  const std::vector<identify::Record>* records = nullptr;
  /// Of method instantaneous; else nullptr.
  const identify::FitResult* fit = nullptr;
  /// Of method average; else nullptr.
  const identify::AverageFit* average = nullptr;
  std::vector<sweep::Attribute> attributes;
};

/// Writes a fit result (docs/fit_file.md, "The result"), complete or not at all.
///
/// @throws core::InputError if the file cannot be written there; core::ResourceError when the disk
/// is
///         full or fails
void write_fit_result(const std::string& path, const FitReport& report);

}  // namespace millstudy::io
