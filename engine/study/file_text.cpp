// SPDX-License-Identifier: MIT
#include "study/file_text.h"

#include <algorithm>
#include <fmt/core.h>

namespace millstudy::study {

bool is_file_text(std::string_view name) {
  return std::find(kFileText.begin(), kFileText.end(), name) != kFileText.end();
}

std::vector<double> number_list(const core::Value& value, std::string_view name, Faults& faults) {
  std::vector<double> numbers;
  if (!value.is_array()) {
    faults.add(value.place,
               fmt::format("{} must be a list of numbers, not {}", name, type_name(value)));
    return numbers;
  }
  for (const core::Value& item : value.array()) {
    if (!item.is_number()) {
      faults.add(item.place, fmt::format("{}[{}] must be a number, not {}", name, numbers.size(),
                                         type_name(item)));
      return numbers;
    }
    numbers.push_back(item.number());
  }
  return numbers;
}

}  // namespace millstudy::study
