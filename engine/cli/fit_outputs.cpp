// SPDX-License-Identifier: MIT
#include "cli/fit_outputs.h"

#include <filesystem>
#include <fmt/core.h>

#include "core/error.h"
#include "io/atomic_file.h"

namespace millstudy::cli {
namespace {

namespace fs = std::filesystem;

/// Whether two paths lead to one file, which need not exist yet.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code failed;
  if (fs::equivalent(a, b, failed)) return true;
  const fs::path left = fs::weakly_canonical(fs::absolute(a), failed);
  const fs::path right = fs::weakly_canonical(fs::absolute(b), failed);
  return !left.empty() && left == right;
}

}  // namespace

FitOutputs fit_outputs(const FitOptions& options, const study::FitFile& file,
                       const std::string& folder) {
  FitOutputs out;
  out.result = options.output.empty() ? file.name + ".h5" : options.output;
  out.coefficients = options.coefficients.empty()
                         ? fs::path(out.result).replace_extension(".coefficients.toml").string()
                         : options.coefficients;
  if (same_file(out.result, out.coefficients)) {
    throw core::InputError({out.result, 0},
                           "result and coefficients cannot be one file: give -o another");
  }
  for (const auto& [path, option] :
       {std::pair{out.result, "-o"}, std::pair{out.coefficients, "--coefficients"}}) {
    if (same_file(path, options.file)) {
      throw core::InputError(
          {path, 0}, fmt::format("is the fit file itself: give another file with {}", option));
    }
    for (const study::FitRecord& record : file.records) {
      if (!same_file(path, (fs::path(folder) / record.source.file).string())) continue;
      throw core::InputError({path, 0},
                             fmt::format("holds the trace of record {}: give another file with {}",
                                         record.name, option));
    }
    const io::AtomicFile probe(path);
  }
  return out;
}

}  // namespace millstudy::cli
