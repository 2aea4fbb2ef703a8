// SPDX-License-Identifier: MIT
// What keys do to a case.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "core/units.h"
#include "study/key.h"

namespace millstudy::study {
namespace {

double native(const Key& key, double number) {
  const Unit& unit = unit_named(key.unit);
  return number * unit.factor / unit.divisor;
}

double shown(const Key& key, double number) {
  const Unit& unit = unit_named(key.unit);
  return number * unit.divisor / unit.factor;
}

std::vector<double> native(const Key& key, std::vector<double> numbers) {
  for (double& number : numbers) number = native(key, number);
  return numbers;
}

// put() sets a field of the case.

void put(const Key& key, const Setting& setting, double* field) {
  *field = native(key, std::get<double>(setting));
}
void put(const Key& key, const Setting& setting, std::optional<double>* field) {
  *field = native(key, std::get<double>(setting));
}
void put(const Key&, const Setting& setting, int* field) {
  *field = static_cast<int>(std::get<double>(setting));
}
void put(const Key& key, const Setting& setting, std::vector<double>* field) {
  *field = native(key, std::get<std::vector<double>>(setting));
}
void put(const Key& key, const Setting& setting, NumberOrNumbers field) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&setting)) {
    *field.numbers = native(key, *numbers);
    *field.number = field.numbers->front();
  } else {
    field.numbers->clear();
    put(key, setting, field.number);
  }
}
void put(const Key& key, const Setting& setting, PartsOfTurn field) {
  constexpr double kTurn = 360.0;  // [deg]
  constexpr double kRounding = 1e-6;
  const auto& angles = std::get<std::vector<double>>(setting);
  const double sum = std::accumulate(angles.begin(), angles.end(), 0.0);
  *field.angles = native(key, angles);
  if (std::abs(sum - kTurn) > kRounding) return;  // no full turn: the checks of the kind say so
  std::transform(angles.begin(), angles.end(), field.angles->begin(),
                 [sum](double angle) { return angle / sum * core::kTurn; });
}
void put(const Key&, const Setting& setting, CurvePtr* field) {
  *field = std::get<CurvePtr>(setting);
}
void put(const Key&, const Setting& setting, ProfilePtr* field) {
  *field = std::get<ProfilePtr>(setting);
}
void put(const Key&, const Setting& setting, ResponsePtr* field) {
  *field = std::get<ResponsePtr>(setting);
}

/// Any enumeration.
template <class Choice>
void put(const Key& key, const Setting& setting, Choice* field) {
  const auto at = std::find(key.choices.begin(), key.choices.end(), std::get<std::string>(setting));
  *field = static_cast<Choice>(at - key.choices.begin());
}
void put(const Key& key, const Setting& setting, std::optional<Milling>* field) {
  put(key, setting, &field->emplace());
}

template <class T>
void copy(T* from, T* to) {
  *to = *from;
}
void copy(NumberOrNumbers from, NumberOrNumbers to) {
  copy(from.number, to.number);
  copy(from.numbers, to.numbers);
}
void copy(PartsOfTurn from, PartsOfTurn to) {
  copy(from.angles, to.angles);
}

}  // namespace

void apply(const Key& key, const Setting& setting, Case& target) {
  const Field target_field = key.field(target);
  if (std::holds_alternative<std::monostate>(setting)) {
    Case fresh;
    const Field fresh_field = key.field(fresh);
    std::visit([&]<class T>(T field) { copy(std::get<T>(fresh_field), field); }, target_field);
  } else {
    std::visit([&](auto field) { put(key, setting, field); }, target_field);
  }
}

std::optional<double> read(const Key& key, const Case& source) {
  return std::visit(
      [&]<class T>(T field) -> std::optional<double> {
        if constexpr (std::is_same_v<T, double*>) {
          return shown(key, *field);
        } else if constexpr (std::is_same_v<T, int*>) {
          return *field;
        } else if constexpr (std::is_same_v<T, std::optional<double>*>) {
          if (field->has_value()) return shown(key, **field);
        } else if constexpr (std::is_same_v<T, NumberOrNumbers>) {
          if (field.numbers->empty()) return shown(key, *field.number);
        }
        return std::nullopt;
      },
      key.field(const_cast<Case&>(source)));  // field() only says where; nothing is written
}

std::string to_string(const Setting& setting) {
  if (const double* number = std::get_if<double>(&setting)) return fmt::format("{}", *number);
  if (const bool* flag = std::get_if<bool>(&setting)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&setting)) return *text;
  if (const auto* numbers = std::get_if<std::vector<double>>(&setting)) {
    return fmt::format("{}", fmt::join(*numbers, " "));
  }
  if (const auto* curve = std::get_if<CurvePtr>(&setting)) return (*curve)->canonical;
  if (const auto* profile = std::get_if<ProfilePtr>(&setting)) {
    std::string text = "profile";
    for (const cutter::ProfilePoint& point : **profile) {
      text += fmt::format(" {} {}", point.z, point.r);
    }
    return text;
  }
  if (const auto* response = std::get_if<ResponsePtr>(&setting)) return (*response)->canonical;
  return "not given";
}

}  // namespace millstudy::study
