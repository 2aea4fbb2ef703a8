// SPDX-License-Identifier: MIT
#pragma once

// What the files of the key table share; nobody else includes this.
#include "study/key.h"

namespace millstudy::study::table {

inline constexpr auto kNumber = KeyType::number;
inline constexpr auto kInteger = KeyType::integer;
inline constexpr auto kNumbers = KeyType::numbers;
inline constexpr auto kNumberOrNumbers = KeyType::number_or_numbers;
inline constexpr auto kChoice = KeyType::choice;
inline constexpr auto kText = KeyType::text;
inline constexpr auto kFlag = KeyType::flag;
inline constexpr auto kFile = KeyType::file;

/// From above 0.
constexpr Range up_to(double high) {
  return {0.0, high, true, false};
}

constexpr Range within(double most) {
  return {-most, most};
}

}  // namespace millstudy::study::table

// What a key sets: MILLSTUDY_SETS(cut.axial_depth) is that member of the case.
#define MILLSTUDY_SETS(member) [](Case& c) -> Field { return &c.member; }
