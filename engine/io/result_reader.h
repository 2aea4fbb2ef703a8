// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>

namespace millstudy::io {

/// Root attributes of a result file, by name. Those of other forms (lists, ...) are left out.
struct ResultSummary {
  std::map<std::string, std::variant<std::string, std::int64_t, double>> attributes;

  /// The attribute of that name and form, if there is one.
  std::optional<std::string> text(const std::string& name) const;
  std::optional<std::int64_t> integer(const std::string& name) const;
  std::optional<double> real(const std::string& name) const;
};

/// What a result file says about itself; nothing if there is no such file.
///
/// @throws core::InputError if it is not a readable HDF5 file
std::optional<ResultSummary> read_result_summary(const std::string& path);

}  // namespace millstudy::io
