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

/// These first bytes of a file will be read soon: lets the disk begin, where it can be.
void expect_file(const std::string& path, std::uint64_t bytes);

}  // namespace millstudy::core
