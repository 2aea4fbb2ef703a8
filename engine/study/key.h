// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/value.h"
#include "study/case.h"
#include "study/setting.h"

namespace millstudy::study {

enum class KeyType {
  number,
  integer,
  numbers,
  number_or_numbers,
  choice,
  choices,  ///< a list of them
  flag,
  text,
  file,
  table,  ///< whoever reads it knows what it holds
};

/// Allowed numbers: from low to high, each end inclusive unless it is open.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool low_open = false;
  bool high_open = false;

  bool contains(double value) const;
  /// The limit that a value outside breaks: "> 0" or "<= 1000000".
  std::string broken_by(double value) const;
  /// Both limits, for the key reference: "> 0, <= 1000000"; empty where there is none.
  std::string words() const;
};

/// What a key has when nobody gives it.
struct Required {};
struct Optional {};
/// Required where another key, a choice, is this; elsewhere the key has what a fresh case has.
struct RequiredFor {
  std::string_view key;
  std::string_view choice;
};
using Default = std::variant<Required, Optional, RequiredFor, double, std::string_view>;

/// Of use only where another key, a choice, is one of these; of no key: always.
struct OnlyFor {
  std::string_view key = {};
  std::vector<std::string_view> choices = {};
};

/// How many numbers a list may have.
struct Count {
  std::size_t least = 1;
  std::size_t most = 1000;
};

/// One number for all, or a list with one for each; the number is then the first of them.
struct NumberOrNumbers {
  double* number;
  std::vector<double>* numbers;
};

/// Angles that make up a full turn: a list that does so to a millionth of a degree is scaled to do
/// so to rounding.
struct PartsOfTurn {
  std::vector<double>* angles;
};

/// The place in a case that a key sets. A choice sets an enumeration whose values are declared in
/// the order of the key's choices.
using Field =
    std::variant<double*, std::optional<double>*, int*, std::vector<double>*, NumberOrNumbers,
                 PartsOfTurn, CurvePtr*, ProfilePtr*, ResponsePtr*, path::Method*, cutter::Shape*,
                 cutter::Lead*, cutter::EdgeMeasure*, force::Rule*, std::optional<Milling>*,
                 process::Stock*, CoefficientModel*, StabilityMethod*, FinishMethod*, FinishWall*>;

/// One key of a study: the only place that says what it is called, what it may be and what it
/// sets. Validation, the key reference, sweep axes and the case of a point all come from here.
struct Key {
  std::string_view path;  ///< dotted: cut.axial_depth_mm
  KeyType type = KeyType::number;
  std::string_view unit;  ///< one of units(): mm, deg, rpm; empty where there is none
  Range range;
  Default fallback = Required{};
  std::string_view help;  ///< one line: its name, then what else there is to say after : or ;
  std::function<Field(Case&)> field = nullptr;
  std::vector<std::string_view> choices = {};  ///< of a choice
  OnlyFor only_for = {};
  Count count = {};  ///< of a list
  int item = 0;      ///< of a list of tables: which of them the key is of

  /// Last part of the path: axial_depth_mm.
  std::string_view name() const { return path.substr(path.rfind('.') + 1); }
  /// For axes of plots: the name that help begins with.
  std::string_view label() const { return help.substr(0, help.find_first_of(":;")); }
  /// General keys set nothing and stay the same over a sweep.
  bool sweepable() const { return field != nullptr || type == KeyType::file; }
  bool required() const { return std::holds_alternative<Required>(fallback); }
  /// It can be one number: axes of it have a range, limits can be put on it.
  bool numeric() const {
    return type == KeyType::number || type == KeyType::integer ||
           type == KeyType::number_or_numbers;
  }
  bool takes_list() const { return type == KeyType::numbers || type == KeyType::number_or_numbers; }
};

/// A unit that keys and columns may have: what the engine calls native is factor / divisor of it.
struct Unit {
  std::string_view name;     ///< as people write it: N/mm2
  std::string_view udunits;  ///< as result files write it: N mm-2
  double factor = 1.0;
  double divisor = 1.0;
};

/// The unit of that name; every key and quantity uses one of the table.
const Unit& unit_named(std::string_view name);

/// What a study says that lacks the key: "cut.axial_depth_mm [mm] is missing: axial depth of cut".
std::string missing(const Key& key);

/// Keys by section, as studies use them.
std::span<const Key> general_keys();      ///< schema_version, [study]; set nothing
std::span<const Key> output_keys();       ///< [output], for kinds with traces; sets nothing
std::span<const Key> path_keys();         ///< [path]
std::span<const Key> path_feed_keys();    ///< [cut], all that kind path takes of it
std::span<const Key> cutter_keys();       ///< [cutter]
std::span<const Key> coefficient_keys();  ///< [coefficients]
std::span<const Key> cut_keys();          ///< [cut]
std::span<const Key> stock_keys();        ///< [cut], for kinds with a path
std::span<const Key> numerics_keys();     ///< [numerics]
std::span<const Key> measurement_keys();  ///< [measurement], for kind force
std::span<const Key> modes_keys();        ///< [[modes.x]], [[modes.y]], [[modes.coupled]]
std::span<const Key> stability_keys();    ///< [stability]
std::span<const Key> finish_keys();       ///< [finish]

/// The setting that a value of a file stands for.
/// @throws core::InputError at the value's place, of a list with every fault: wrong type, not
/// finite, out of range, not a choice. A file key yields the path as written; resolve() reads it.
Setting checked_setting(const Key& key, const core::Value& value);

/// What the key has where it is not given.
Setting default_setting(const Key& key);

/// Puts a checked setting into the case, in native units.
void apply(const Key& key, const Setting& setting, Case& target);

/// The value of a numeric key in the key's unit; nullopt where the case has none, or a list.
std::optional<double> read(const Key& key, const Case& source);

/// How a setting is written in messages, labels and, with all its numbers, the study hash.
std::string to_string(const Setting& setting);

}  // namespace millstudy::study
