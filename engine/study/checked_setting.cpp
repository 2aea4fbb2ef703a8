// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "study/faults.h"
#include "study/key.h"

namespace millstudy::study {
namespace {

[[noreturn]] void refuse(const core::Value& value, std::string text) {
  throw core::InputError(value.place, std::move(text));
}

std::string quantity(double value, std::string_view unit) {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

/// @param name  of the number: the key, or an entry of its list
double checked_number(const Key& key, std::string_view name, const core::Value& value) {
  if (!value.is_number()) {
    refuse(value,
           fmt::format("{} must be a {}, not {}", name,
                       key.type == KeyType::integer ? "whole number" : "number", type_name(value)));
  }
  const double number = value.number();
  const std::string shown = fmt::format("{} = {}", name, quantity(number, key.unit));
  if (!std::isfinite(number)) refuse(value, shown + " must be a finite number");
  if (key.type == KeyType::integer && number != std::nearbyint(number)) {
    refuse(value, shown + " must be a whole number");
  }
  if (!key.range.contains(number)) refuse(value, shown + " must be " + key.range.broken_by(number));
  return number;
}

void check_count(const Key& key, const core::Value& list) {
  const std::size_t count = list.array().size();
  const auto numbers = [](std::size_t n) {
    return fmt::format("{} number{}", n, n == 1 ? "" : "s");
  };
  if (key.count.least == key.count.most && count != key.count.least) {
    refuse(list, fmt::format("{} must have {}, not {}", key.path, numbers(key.count.least), count));
  }
  if (count < key.count.least) {
    refuse(list, fmt::format("{} must have at least {}", key.path, numbers(key.count.least)));
  }
  if (count > key.count.most) {
    refuse(list, fmt::format("{} has {}, more than {}", key.path, numbers(count), key.count.most));
  }
}

std::vector<double> checked_numbers(const Key& key, const core::Value& list) {
  check_count(key, list);
  std::vector<double> numbers;
  Faults faults;
  for (std::size_t i = 0; i < list.array().size(); ++i) {
    faults.collect([&] {
      numbers.push_back(checked_number(key, fmt::format("{}[{}]", key.path, i), list.array()[i]));
    });
  }
  faults.throw_if_any();
  return numbers;
}

}  // namespace

Setting checked_setting(const Key& key, const core::Value& value) {
  if (key.takes_list() && value.is_array()) return checked_numbers(key, value);
  if (key.takes_list() && !(key.numeric() && value.is_number())) {
    refuse(value, fmt::format("{} must be a {}list of numbers, not {}", key.path,
                              key.numeric() ? "number or a " : "", type_name(value)));
  }
  if (key.numeric()) return checked_number(key, key.path, value);
  if (key.type == KeyType::flag) {
    if (const bool* flag = std::get_if<bool>(&value.data)) return *flag;
    refuse(value, fmt::format("{} must be true or false, not {}", key.path, type_name(value)));
  }
  if (!value.is_string()) {
    refuse(value, fmt::format("{} must be a string, not {}", key.path, type_name(value)));
  }
  const bool known =
      key.type != KeyType::choice ||
      std::find(key.choices.begin(), key.choices.end(), value.string()) != key.choices.end();
  if (!known) {
    refuse(value, fmt::format("{} = \"{}\" must be one of {}", key.path, value.string(),
                              fmt::join(key.choices, ", ")));
  }
  return value.string();
}

}  // namespace millstudy::study
