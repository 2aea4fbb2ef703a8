// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/value.h"
#include "study/kind.h"
#include "sweep/layout.h"
#include "sweep/parameter_space.h"
#include "sweep/runner.h"

namespace millstudy::study {

struct Assignment {
  const Key* key = nullptr;
  Setting setting;
};

/// One axis of the sweep: the values of a number, or labelled sets of settings (a choice or a list
/// sets one key, a file may set several).
struct Axis {
  std::string path;  ///< dotted, as in the study
  const Key* key = nullptr;
  std::vector<double> numbers;                    ///< in the unit of the key; or
  std::vector<std::string> labels;                ///< one per value, with
  std::vector<std::vector<Assignment>> settings;  ///< what each label sets
  std::string sampled;  ///< what the values were drawn from, and how; empty: they are as given

  bool numeric() const { return labels.empty(); }
  std::size_t size() const { return numeric() ? numbers.size() : labels.size(); }
};

/// A label of an axis and all that it sets, the contents of its file too: "[up cut.milling = up]".
std::string label_text(const Axis& axis, std::size_t i);

/// A limit on a quantity: points outside are skipped. Bounds are inclusive.
struct Limit {
  std::string quantity;
  std::function<std::optional<double>(const Case&)> value;
  std::optional<double> min;
  std::optional<double> max;
  core::Place place;
};

/// A study that has been read, checked and found without fault.
struct Study {
  std::string name;
  std::string description;
  double point_time_limit = 0.0;  ///< [s]; 0: none
  const Kind* kind = nullptr;
  Case base;
  Outputs outputs;
  std::vector<sweep::Column> columns;  ///< those of the kind for these outputs
  std::vector<Axis> axes;
  std::vector<Limit> limits;
  sweep::ParameterSpace space{sweep::Design::grid, {}};
  /// The resolved study as text: what study_hash is the hash of. Defaults, overrides and the
  /// contents of files are in it; name, description and comments are not.
  std::string canonical;
  /// The same without the values of the axes: studies that have it in common have the same results
  /// at points with the same parameters.
  std::string settings;
  /// What it does at the user's own risk; the program tells, and goes on.
  std::vector<core::Fault> warnings;
  std::vector<core::Fault> notes;  ///< what was made of it that the user should hear of
};

/// Reads a file that a study names; throws core::InputError.
using FileLoader = std::function<core::Value(const std::string& path)>;

/// Checks a study and resolves it: defaults, files, axes, limits.
///
/// @param root  the study file's tree; files it names are relative to the folder of root.place.file
/// @throws core::InputError with every fault found
Study resolve(const core::Value& root, const FileLoader& load);

/// Names, units and values of everything the result will hold.
sweep::Layout layout(const Study& study);

/// The settings of one point.
Case case_at(const Study& study, std::int64_t point);

/// The evaluator of the study's blocks: skips what is outside the limits, turns what a point
/// throws into its failure, and shares work between points.
///
/// @param stop  once it is set, the points of a block that have not begun stay not_run
sweep::EvaluateBlock block_evaluator(const Study& study, const std::atomic<bool>* stop = nullptr);

/// The reference of every key of a kind, as text or as a Markdown table.
std::string key_reference(const Kind& kind, bool markdown);

}  // namespace millstudy::study
