// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "study/faults.h"
#include "study/key.h"
#include "sweep/block.h"

namespace millstudy::study {

/// Which keys a study gives, and where; what is not here has its default.
struct Given {
  struct Entry {
    const Key* key = nullptr;
    core::Place place;
    bool swept = false;  ///< an axis gives it, so its value differs from point to point
    std::vector<std::string> choices = {};  ///< what a choice is, at any point of the study
  };
  std::map<std::string_view, Entry> entries;  ///< by dotted path

  bool has(std::string_view path) const { return entries.contains(path); }
  bool swept(std::string_view path) const;
  /// True if the key is given and this choice at one of the points.
  bool may_be(std::string_view path, std::string_view choice) const;
  bool any_swept(std::initializer_list<std::string_view> paths) const;
  /// True if any key of the section is swept.
  bool section_swept(std::string_view section) const;
  /// Where the first of these keys stands; the whole file where none does.
  core::Place place(std::initializer_list<std::string_view> paths) const;
  core::Place file;  ///< the study itself
};

/// What a study asks for besides what its kind always gives.
struct Outputs {
  bool traces = false;
  int harmonics = 0;            ///< of forces and torque, from the first
  int flutes = 0;               ///< that have columns of their own: the most of any point, or 0
  bool bending_moment = false;  ///< the stick-out is given
  bool depth_is_axis = false;   ///< every point has a depth of its own
};

/// Computes one point: fills one value per column, and the trace where one is asked for.
/// Called concurrently. @throws core::CaseError for a case that cannot be computed.
using EvaluatePoint =
    std::function<void(const Case& point, std::span<double> row, sweep::Trace* trace)>;

/// What a kind of study means. A new kind is one file that makes one of these, and one line in
/// kinds.cpp.
struct Kind {
  std::string_view name;
  std::string_view help;
  std::vector<std::span<const Key>> sections;
  std::vector<sweep::Column> (*columns)(const Outputs&) = nullptr;
  bool has_traces = false;
  /// Rules on which keys go together; checked even where values are at fault (those are not set).
  void (*check_keys)(const Given&, const Case& base, Faults&) = nullptr;
  /// Rules between values; those that involve a swept key are left to the points.
  void (*check)(const Given&, const Case& base, Faults&) = nullptr;
  /// What the user should hear of before a run; may be null.
  std::vector<core::Fault> (*notes)(const Given&, const Case& base) = nullptr;
  /// A fresh evaluator for one run; what points share is kept in it.
  EvaluatePoint (*make_evaluator)(const Outputs&) = nullptr;

  /// The key of that path, or nullptr.
  const Key* find_key(std::string_view path) const;
  /// True if keys begin with this path and a dot: cut, cutter, study.
  bool has_section(std::string_view path) const;
};

/// Dotted paths of all keys of a kind.
std::vector<std::string_view> key_paths(const Kind& kind);

/// All kinds, in the order of the reference.
std::span<const Kind* const> kinds();

/// Which keys go together, for the kinds that compute forces.
void check_force_keys(const Given& given, const Case& base, Faults& faults);
/// Rules between values, for the kinds that compute forces.
void check_force(const Given& given, const Case& base, Faults& faults);

// What these two consist of, by section.
void check_cutter_keys(const Given& given, Faults& faults);
void check_coefficient_keys(const Given& given, Faults& faults);
void check_cut_keys(const Given& given, const Case& base, Faults& faults);
void check_cutter(const Given& given, const Case& base, Faults& faults);
void check_coefficients(const Given& given, const Case& base, Faults& faults);
/// Rules of [cut].
void check_cut(const Given& given, const Case& base, Faults& faults);
/// Which keys of [cut] go together but for the feed, which stability need not know.
void check_engagement_keys(const Given& given, const Case& base, Faults& faults);
/// Rules of [[modes.x]], [[modes.y]] and [[modes.coupled]].
void check_modes_keys(const Given& given, Faults& faults);
/// Modes that are fitted to measured responses must stand for them.
void check_modes(const Given& given, const Case& base, Faults& faults);
/// The modes that were fitted to measured responses, one note for each response.
std::vector<core::Fault> fitted_modes(const Given& given, const Case& base);
/// What makes a cut nonlinear is for a simulation only.
/// @param method  the key that chooses
void check_linear_keys(const Given& given, const Case& base, std::string_view method,
                       Faults& faults);
/// Rules of [measurement].
void check_measurement(const Given& given, const Case& base, Faults& faults);
/// Rules of [numerics].
void check_numerics(const Given& given, const Case& base, Faults& faults);

}  // namespace millstudy::study
