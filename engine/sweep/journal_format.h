// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sweep/block.h"

/// Bytes of a journal. All numbers are little endian.
///
///     0    "MILLJRNL"
///     8    u32 version, u32 length of the header
///     16   240 bytes: who computes now, as text; not covered by any checksum
///     256  header, u32 CRC32C of bytes 0 .. 15 and the header
///     then frames: u32 marker, u32 CRC32C of all that follows, u64 length, u64 block, payload
namespace millstudy::sweep {

inline constexpr std::string_view kJournalMagic = "MILLJRNL";
inline constexpr std::uint32_t kJournalVersion = 1;
inline constexpr std::size_t kOwnerPlace = 16;
inline constexpr std::size_t kOwnerSize = 240;
inline constexpr std::size_t kHeaderPlace = kOwnerPlace + kOwnerSize;
inline constexpr std::size_t kFrameHead = 24;
inline constexpr std::uint32_t kFrameMarker = 0x4B4C424DU;  // "MBLK"

/// What a journal is of, and how its points are cut into blocks.
struct JournalHeader {
  std::string study_hash;
  std::string isa;          ///< instruction set of the program
  std::string build;        ///< its version and revision
  std::string study;        ///< text of the study file
  std::int64_t points = 0;  ///< of the study
  std::int64_t first = 0;   ///< of the points that are computed here
  std::int64_t count = 0;
  std::int64_t block_size = 1;
  std::int64_t columns = 0;
  bool traces = false;
  bool keep_old = false;  ///< a result that is there is moved aside at the end

  std::int64_t blocks() const { return (count + block_size - 1) / block_size; }
  std::int64_t first_of(std::int64_t block) const { return first + block * block_size; }
  std::int64_t count_of(std::int64_t block) const {
    return std::min(block_size, first + count - first_of(block));
  }
};

/// How a block was computed.
struct BlockTimes {
  double seconds = 0.0;  ///< on its thread
  double elapsed = 0.0;  ///< since the start of the session, when it was done
  std::uint32_t session = 0;
};

/// From the magic to the checksum; the owner is left empty.
std::string encode_header(const JournalHeader& header);
/// @param bytes  from the beginning of the file
/// @return nullopt if these are not a whole header of this version, with its checksum; its length
/// is that of encode_header()
std::optional<JournalHeader> decode_header(std::string_view bytes);

/// A frame from marker to payload.
std::string encode_frame(std::int64_t index, const Block& block, const BlockTimes& times);

struct FrameHead {
  std::uint32_t checksum;
  std::uint64_t length;  ///< of the payload
  std::uint64_t block;
};
/// @param bytes  kFrameHead bytes; nullopt without the marker
std::optional<FrameHead> decode_head(std::string_view bytes);
bool is_whole(const FrameHead& head, std::string_view payload);

/// What a payload says without its values.
struct FrameSummary {
  BlockTimes times;
  std::int64_t ok = 0;
  std::int64_t failed = 0;
  std::int64_t skipped = 0;
  std::int64_t not_run = 0;
};
/// nullopt if the payload does not fit the header.
std::optional<FrameSummary> decode_summary(const JournalHeader& header, std::int64_t index,
                                           std::string_view payload);
std::optional<Block> decode_block(const JournalHeader& header, std::int64_t index,
                                  std::string_view payload);

}  // namespace millstudy::sweep
