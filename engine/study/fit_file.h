// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cutter/cutter.h"
#include "identify/axis_map.h"
#include "identify/fit.h"
#include "study/kind.h"
#include "study/study.h"

namespace millstudy::study {

/// Where the samples of a record are, and how they become forces on the tool.
struct TraceSource {
  std::string file;   ///< relative to the fit file's folder until it is read
  core::Place place;  ///< of the file's name
  std::map<std::string, std::string> variables;
  std::map<std::string, std::string> units;
  std::map<std::string, double> sensitivity_N_per_V;
  std::array<std::string, 3> axes;  ///< "-Fy" or empty, for x, y, z
  core::Place axes_place;
  std::optional<double> sampling_rate;          ///< [Hz]
  std::optional<std::array<double, 2>> window;  ///< from, to [s]
  bool cutting_only = false;
  bool offset_from_air = false;
  std::optional<std::int64_t> point;
  std::optional<int> segment;
};

/// One record as a fit file gives it.
struct FitRecord {
  std::string name;
  TraceSource source;
  Case cut;                     ///< its cutter and [cut]
  std::optional<double> phase;  ///< of flute 0's tip at the first sample [rad]
  core::Place place;
};

enum class FitMethod { average, instantaneous };

/// A fit file that has been read, checked and found without fault.
struct FitFile {
  std::string name;
  std::string description;
  FitMethod method = FitMethod::instantaneous;
  bool choose_model = false;  ///< model = "auto"
  identify::FitSettings settings;
  cutter::Cutter cutter;
  std::vector<FitRecord> records;
};

/// Reads a fit file's tree; files it names are relative to the folder of root.place.file.
///
/// @param load  reads a TOML file (a cutter_file)
/// @throws core::InputError with every fault found
FitFile read_fit_file(const core::Value& root, const FileLoader& load);

/// What fit files hold, for the key reference; it is no kind of study.
const Kind& fit_keys();

}  // namespace millstudy::study
