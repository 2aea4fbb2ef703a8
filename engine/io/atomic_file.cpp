// SPDX-License-Identifier: MIT
#include "io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "core/error.h"
#include "core/resource_error.h"

namespace millstudy::io {
namespace {

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

void check_target(const std::string& path) {
  struct stat status {};
  if (path.empty() || path.back() == '/')
    throw core::InputError({path, 0}, "is not the name of a file");
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw core::InputError({path, 0}, "is a folder, not a file");
    if (!S_ISREG(status.st_mode)) throw core::InputError({path, 0}, "is not a regular file");
  }
  const std::string folder = folder_of(path);
  if (::stat(folder.c_str(), &status) != 0) {
    throw core::InputError(
        {path, 0}, fmt::format("cannot be written: folder {}: {}", folder, std::strerror(errno)));
  }
  if (!S_ISDIR(status.st_mode)) {
    throw core::InputError({path, 0}, fmt::format("cannot be written: {} is not a folder", folder));
  }
}

/// True if the path still names the open file: it may have been renamed before we held its lock.
bool still_names(const std::string& path, int fd) {
  struct stat named {};
  struct stat opened {};
  return ::stat(path.c_str(), &named) == 0 && ::fstat(fd, &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

[[noreturn]] void out_of_resource(const std::string& path, int error) {
  throw core::ResourceError(fmt::format("{}: cannot be completed: {}", path, std::strerror(error)));
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), temporary_(path_ + ".tmp") {
  check_target(path_);
  fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (fd_ < 0)
    throw core::InputError({path_, 0}, fmt::format("cannot be written: {}", std::strerror(errno)));
  // A file system without locks (ENOLCK, EINVAL) is no reason to refuse.
  const bool taken = ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (taken || !still_names(temporary_, fd_)) {
    ::close(fd_);
    throw core::InputError({path_, 0}, "is being written by another process");
  }
  struct stat status {};
  if (::fstat(fd_, &status) == 0 && S_ISREG(status.st_mode)) return;
  ::close(fd_);
  throw core::InputError({temporary_, 0}, "is in the way: not a regular file");
}

AtomicFile::~AtomicFile() {
  if (fd_ < 0) return;
  ::unlink(temporary_.c_str());
  ::close(fd_);
}

void AtomicFile::commit() {
  if (::fsync(fd_) != 0) out_of_resource(path_, errno);
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) out_of_resource(path_, errno);
  ::close(std::exchange(fd_, -1));
  const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // a folder that may be written but not read: renamed all the same
  ::fsync(folder);         // EINVAL on file systems that need none
  ::close(folder);
}

}  // namespace millstudy::io
