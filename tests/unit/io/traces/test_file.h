// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

namespace millstudy::io {

/// A file in the folder of temporary files that is removed with this.
class TestFile {
 public:
  explicit TestFile(std::string_view content = {}) {
    static std::atomic<int> number{0};
    path_ = std::filesystem::temp_directory_path() /
            ("millstudy-trace-" + std::to_string(getpid()) + '-' + std::to_string(number++));
    std::ofstream(path_, std::ios::binary) << content;
  }
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  ~TestFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace millstudy::io
