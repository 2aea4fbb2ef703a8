// SPDX-License-Identifier: MIT
#include "io/text_file.h"

#include <cerrno>
#include <cstring>
#include <fmt/core.h>
#include <unistd.h>

#include "core/resource_error.h"
#include "io/atomic_file.h"

namespace millstudy::io {

void write_text_file(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  while (!text.empty()) {
    const ssize_t written = ::write(file.descriptor(), text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw core::ResourceError(
          fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  file.commit();
}

}  // namespace millstudy::io
