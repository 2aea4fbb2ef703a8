// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace millstudy::cli {

/// Exit codes of the program.
inline constexpr int kDone = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kPointsFailed = 3;
inline constexpr int kInterrupted = 4;

struct StudyOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< key=value
  int threads = 0;                     ///< 0: all
  bool json = false;
};

struct RunSettings {
  std::string output;  ///< empty: <study.name>.h5
  bool fresh = false;
  bool quiet = false;
  std::int64_t block_size = 0;
  bool failed = false;  ///< compute failed points again
  bool extend = false;  ///< use points of a result with other values on its axes
  int shard = 0;        ///< which of so many parts of the study, from 1; 0: all of it
  int shards = 0;
  std::uint64_t memory = 0;        ///< most bytes to use; 0: as it comes
  std::int64_t max_failures = -1;  ///< end early beyond so many; -1: never
  double disk_patience = 600.0;    ///< how long to wait for room on the disk [s]
};

struct FitOptions {
  std::string file;
  std::string output;        ///< empty: <fit.name>.h5
  std::string coefficients;  ///< empty: beside the output, .coefficients.toml
  int threads = 0;           ///< 0: all
  bool quiet = false;
  bool json = false;
};

struct ExportOptions {
  std::string result;
  std::string output;
  std::int64_t point = -1;  ///< whose trace is written; -1: the table of all points
};

struct SensitivityOptions {
  std::string result;
  std::vector<std::string> variables;  ///< empty: all
  std::string output;                  ///< .csv; empty: none
  bool json = false;
};

// Each verb prints its result to stdout and returns the exit code; bad input is thrown.
int plan(const StudyOptions& options);
int run(const StudyOptions& options, const RunSettings& settings);
int fit(const FitOptions& options);
int status(const std::string& result, bool json);
int merge(const std::string& output, const std::vector<std::string>& parts);
int sensitivity(const SensitivityOptions& options);
int export_result(const ExportOptions& options);
int print_keys(const std::string& kind, bool markdown);

}  // namespace millstudy::cli
