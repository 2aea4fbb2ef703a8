// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/commands.h"
#include "study/fit_file.h"

namespace millstudy::cli {

/// Where a fit writes.
struct FitOutputs {
  std::string result;        ///< fit.h5
  std::string coefficients;  ///< the file for studies
};

/// The files that a fit writes, as asked for or by its name; tried before anything is computed.
///
/// @param folder  that of the fit file, to which the files of records are relative
/// @throws core::InputError where one of them is a file that the fit reads, both are the same or
///         one cannot be written there
FitOutputs fit_outputs(const FitOptions& options, const study::FitFile& file,
                       const std::string& folder);

}  // namespace millstudy::cli
