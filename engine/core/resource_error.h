// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace millstudy::core {

/// The machine ran out of something (disk space, quota, a working disk): the input is good, and the
/// same command can succeed later. The program exits with 4.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace millstudy::core
