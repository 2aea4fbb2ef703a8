// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace millstudy::core {

/// So many bytes of an open file from a place on, or what the file has of them.
std::string read_at(int fd, std::uint64_t place, std::uint64_t size);

/// @return 0, or the errno of what went wrong
int write_at(int fd, std::uint64_t place, std::string_view bytes);

}  // namespace millstudy::core
