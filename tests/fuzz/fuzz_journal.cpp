// SPDX-License-Identifier: MIT
// libFuzzer target of the journal of a run: any bytes are read without harm, and what is taken for
// a block can be written and read again.
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>
#include <unistd.h>

#include "core/error.h"
#include "sweep/journal.h"

namespace {

using namespace millstudy;

void read_file(std::string_view bytes) {
  static const std::string path = "/dev/shm/millstudy-fuzz-journal-" + std::to_string(getpid());
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  static const int removed = std::atexit([] { unlink(path.c_str()); });
  static_cast<void>(removed);
  try {
    const auto contents = sweep::read_journal(path);
    if (contents && contents->end > bytes.size()) std::abort();
  } catch (const core::InputError&) {
  }
}

/// Payloads past the checksum, which no fuzzer guesses.
void decode(std::string_view bytes, bool traces) {
  sweep::JournalHeader header;
  header.points = header.count = 23;
  header.block_size = 5;
  header.columns = 2;
  header.traces = traces;
  for (const std::int64_t index : {0, 4}) {
    const auto summary = sweep::decode_summary(header, index, bytes);
    const auto block = sweep::decode_block(header, index, bytes);
    if (!block) continue;
    if (!summary || block->count != header.count_of(index)) std::abort();
    const std::string again = sweep::encode_frame(index, *block, summary->times);
    if (std::string_view(again).substr(sweep::kFrameHead) != bytes) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.empty()) return 0;
  switch (bytes[0] % 3) {
    case 0:
      read_file(bytes.substr(1));
      break;
    case 1:
      decode(bytes.substr(1), false);
      break;
    default:
      decode(bytes.substr(1), true);
  }
  return 0;
}
