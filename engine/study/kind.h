// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <span>
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
  };
  std::map<std::string_view, Entry> entries;  ///< by dotted path

  bool has(std::string_view path) const { return entries.contains(path); }
  bool swept(std::string_view path) const;
  bool any_swept(std::initializer_list<std::string_view> paths) const;
  /// Where the first of these keys stands; the whole file where none does.
  core::Place place(std::initializer_list<std::string_view> paths) const;
  core::Place file;  ///< the study itself
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
  std::vector<sweep::Column> columns;
  bool has_traces = false;
  /// Rules on which keys go together; checked even where values are at fault (those are not set).
  void (*check_keys)(const Given&, const Case& base, Faults&) = nullptr;
  /// Rules between values; those that involve a swept key are left to the points.
  void (*check)(const Given&, const Case& base, Faults&) = nullptr;
  /// A fresh evaluator for one run; what points share is kept in it.
  EvaluatePoint (*make_evaluator)() = nullptr;

  /// The key of that path, or nullptr.
  const Key* find_key(std::string_view path) const;
  /// True if keys begin with this path and a dot: cut, cutter, study.
  bool has_section(std::string_view path) const;
};

/// Dotted paths of all keys of a kind.
std::vector<std::string_view> key_paths(const Kind& kind);

/// All kinds, in the order of the reference.
std::span<const Kind* const> kinds();

/// Which keys of [cut] go together, for the kinds that compute forces.
void check_cut_keys(const Given& given, const Case& base, Faults& faults);
/// Rules between values of [cut].
void check_cut(const Given& given, const Case& base, Faults& faults);
/// Rules of [numerics].
void check_numerics(const Given& given, const Case& base, Faults& faults);

}  // namespace millstudy::study
