// SPDX-License-Identifier: MIT
#include "io/write_behind.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <random>
#include <sys/mman.h>
#include <unistd.h>

#include "core/file_at.h"

namespace millstudy::io {
namespace {

/// A file in memory, without a name.
class Scratch {
 public:
  Scratch() : fd_(::memfd_create("scratch", MFD_CLOEXEC | MFD_ALLOW_SEALING)) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { ::close(fd_); }
  int fd() const { return fd_; }

 private:
  int fd_;
};

std::string noise(std::size_t size, std::mt19937& random) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; i += 1 + random() % 64) bytes[i] = static_cast<char>(random());
  return bytes;
}

TEST(WriteBehind, LeavesWhatWritingAtOnceLeaves) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 5; ++trial) {
    const Scratch file;
    std::string expected;
    {
      WriteBehind behind(file.fd());
      for (int i = 0; i < 300; ++i) {
        // Some pieces follow on, most overlap earlier ones: the later bytes must win.
        const std::size_t place = i % 3 == 0 ? expected.size() : random() % 100000;
        const std::string bytes = noise(random() % 3000, random);
        EXPECT_EQ(behind.write(place, bytes), 0);
        expected.resize(std::max(expected.size(), place + bytes.size()), '\0');
        expected.replace(place, bytes.size(), bytes);
        if (i % 50 == 0) {
          EXPECT_EQ(behind.wait(), 0);
          ASSERT_EQ(core::read_at(file.fd(), 0, expected.size()), expected);
        }
      }
    }
    ASSERT_EQ(core::read_at(file.fd(), 0, expected.size() + 1), expected);
  }
}

TEST(WriteBehind, TakesPiecesLargerThanItsMemory) {
  std::mt19937 random(2);
  const Scratch file;
  const std::string large = noise((5 << 20) + 17, random);
  WriteBehind behind(file.fd());
  EXPECT_EQ(behind.write(3, large), 0);
  EXPECT_EQ(behind.write(1, "ab"), 0);
  EXPECT_EQ(behind.wait(), 0);
  EXPECT_EQ(core::read_at(file.fd(), 0, large.size() + 4), std::string("\0ab", 3) + large);
}

TEST(WriteBehind, TellsOfTheFirstFailureAndWritesNothingAfterIt) {
  const Scratch file;
  ASSERT_EQ(::ftruncate(file.fd(), 10), 0);
  ASSERT_EQ(::fcntl(file.fd(), F_ADD_SEALS, F_SEAL_GROW), 0) << "memory without seals";
  WriteBehind behind(file.fd());
  EXPECT_EQ(behind.write(0, "good"), 0);
  EXPECT_EQ(behind.wait(), 0);
  behind.write(100, "beyond the end");
  EXPECT_EQ(behind.wait(), EPERM);
  EXPECT_EQ(behind.write(0, "late"), EPERM);
  EXPECT_EQ(behind.wait(), EPERM);
  EXPECT_EQ(core::read_at(file.fd(), 0, 10), std::string("good") + std::string(6, '\0'));
}

}  // namespace
}  // namespace millstudy::io
