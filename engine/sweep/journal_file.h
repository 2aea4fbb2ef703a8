// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

/// What reading and writing a journal ask of its file, besides bytes.
namespace millstudy::sweep {

std::uint64_t size_of(int fd);
/// Who writes the journal, by its own words.
std::string owner_in(int fd);
/// True if the path still names the open file.
bool still_names(const std::string& path, int fd);
/// Throws core::InputError about the file.
[[noreturn]] void refuse_journal(const std::string& path, const std::string& why);

}  // namespace millstudy::sweep
