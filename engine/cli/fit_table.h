// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "identify/average_fit.h"
#include "identify/fit.h"
#include "study/fit_file.h"

namespace millstudy::cli {

/// What the program says about a fit.
struct FitTable {
  const study::FitFile& file;
  const std::vector<identify::Record>& records;
  const identify::FitResult* fit = nullptr;        ///< of method instantaneous
  const identify::AverageFit* average = nullptr;   ///< of method average
  std::vector<identify::Estimate> estimates = {};  ///< shared by all records
  double condition_number = 0.0;
  std::vector<std::string> words = {};  ///< warnings and advice
};

/// Coefficients with their errors, one line a record, warnings.
std::string fit_text(const FitTable& table);
/// The same as JSON.
std::string fit_json(const FitTable& table, const std::string& result,
                     const std::string& coefficients);
/// A file that coefficients_file of a study takes, with its origin and the range it was found in.
std::string coefficients_toml(const FitTable& table, const std::string& result);

}  // namespace millstudy::cli
