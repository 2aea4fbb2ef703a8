// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace millstudy::core {

/// CRC32C (Castagnoli) of bytes, as iSCSI and ext4 use it: of "123456789" it is 0xE3069283.
///
/// By the instruction of the processor where it is compiled for one that has it, else by a table.
/// @param before  of the bytes before these: pieces give the same as the whole
std::uint32_t crc32c(const void* bytes, std::size_t size, std::uint32_t before = 0);

}  // namespace millstudy::core
