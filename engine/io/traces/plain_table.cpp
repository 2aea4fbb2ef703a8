// SPDX-License-Identifier: MIT
// Any text with rows of numbers: comma, semicolon, tab or blanks between them.
#include <algorithm>

#include "io/traces/format.h"
#include "io/traces/text_table.h"

namespace millstudy::io {
namespace {

constexpr std::size_t kBytesLookedAt = 4096;

bool is_text(std::string_view bytes) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) return true;  // to be refused
  const std::string_view head = bytes.substr(0, kBytesLookedAt);
  return std::none_of(head.begin(), head.end(), [](unsigned char c) {
    return c < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v';
  });
}

TraceFile read(const Source& source, const TraceSelection& selection) {
  return {"table of numbers", read_table(source, find_table(source), selection)};
}

std::vector<std::string> variables(const Source& source) {
  std::vector<std::string> names;
  for (const TextColumn& column : find_table(source).columns) names.push_back(column.name);
  return names;
}

}  // namespace

const TraceFormat kTable = {"table of numbers", is_text, read, variables};

}  // namespace millstudy::io
