// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace millstudy::core {

/// Where something stands in an input: file and line; line 0 is the whole file, an empty file is
/// the command line.
struct Place {
  std::string file;
  int line = 0;
};

/// "studies/slot.toml:14", "studies/slot.toml" or "" as far as known.
std::string to_string(const Place& place);

/// One thing wrong with an input, in one line that says what, where and what to do.
struct Fault {
  Place place;
  std::string text;
};

/// "place: text", one line: control characters are replaced and the length is bounded.
std::string to_string(const Fault& fault);

/// Bad input: carries every fault found, never only the first. The program prints one line per
/// fault and exits with 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  InputError(Place place, std::string text);
  explicit InputError(std::string text) : InputError(Place{}, std::move(text)) {}
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A case that cannot be computed (the input was well-formed, this combination is not possible).
/// what() becomes the reason in the row of its point; it names no value that differs from point to
/// point, so that equal failures are counted together.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace millstudy::core
