// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// What reading and writing a journal need of its file.
namespace millstudy::sweep {

/// So many bytes from a place on, or what the file has of them.
std::string read_at(int fd, std::uint64_t place, std::uint64_t size);
/// @return 0, or the errno of what went wrong
int write_at(int fd, std::uint64_t place, std::string_view bytes);
std::uint64_t size_of(int fd);
/// Who writes the journal, by its own words.
std::string owner_in(int fd);
/// True if the path still names the open file.
bool still_names(const std::string& path, int fd);
/// Throws core::InputError about the file.
[[noreturn]] void refuse_journal(const std::string& path, const std::string& why);

}  // namespace millstudy::sweep
