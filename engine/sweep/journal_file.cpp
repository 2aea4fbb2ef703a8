// SPDX-License-Identifier: MIT
#include "sweep/journal_file.h"

#include <sys/stat.h>

#include "core/error.h"
#include "core/file_at.h"
#include "sweep/journal_format.h"

namespace millstudy::sweep {

std::uint64_t size_of(int fd) {
  struct stat status {};
  return ::fstat(fd, &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::string owner_in(int fd) {
  const std::string bytes = core::read_at(fd, kOwnerPlace, kOwnerSize);
  return bytes.substr(0, bytes.find('\0'));
}

bool still_names(const std::string& path, int fd) {
  struct stat named {};
  struct stat opened {};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(fd, &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

void refuse_journal(const std::string& path, const std::string& why) {
  throw core::InputError({path, 0}, why);
}

}  // namespace millstudy::sweep
