// SPDX-License-Identifier: MIT
#include "sweep/crash_record.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <unistd.h>
#include <vector>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MILLSTUDY_SANITIZED 1
#endif

namespace millstudy::sweep {
namespace {

// A signal handler reaches globals only.
std::array<char, 4096> path_of_record{};

/// Digits of a number, written backwards from the end; no library call is allowed here.
char* digits(std::int64_t number, char* end) {
  do {
    *--end = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number > 0);
  return end;
}

extern "C" void on_crash(int signal) {
  if (current_point >= 0) {
    std::array<char, 64> line{};
    char* const end = line.data() + line.size();
    char* begin = end;
    *--begin = '\n';
    begin = digits(signal, begin);
    *--begin = ' ';
    begin = digits(current_point, begin);
    const int fd = ::open(path_of_record.data(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (fd >= 0) {
      const ssize_t put = ::write(fd, begin, static_cast<std::size_t>(end - begin));
      static_cast<void>(put);
      ::close(fd);
    }
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void record_crashes(const std::string& path) {
#ifndef MILLSTUDY_SANITIZED
  if (path.size() >= path_of_record.size()) return;
  std::memcpy(path_of_record.data(), path.c_str(), path.size() + 1);
  struct sigaction action = {};
  action.sa_handler = on_crash;
  action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    sigaction(signal, &action, nullptr);
  }
#else
  static_cast<void>(path);
  static_cast<void>(on_crash);
#endif
}

void prepare_thread_for_crashes() {
#ifndef MILLSTUDY_SANITIZED
  struct Stack {
    std::vector<char> bytes = std::vector<char>(64 << 10);
    Stack() {
      stack_t stack = {};
      stack.ss_sp = bytes.data();
      stack.ss_size = bytes.size();
      sigaltstack(&stack, nullptr);
    }
    ~Stack() {
      stack_t none = {};
      none.ss_flags = SS_DISABLE;
      sigaltstack(&none, nullptr);
    }
  };
  static thread_local const Stack stack;
  static_cast<void>(stack);
#endif
}

std::map<std::int64_t, Crashes> read_crashes(const std::string& path) {
  std::map<std::int64_t, Crashes> crashes;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && crashes.size() < 100'000;) {
    std::istringstream words(line);
    std::int64_t point = -1;
    int signal = 0;
    if (!(words >> point >> signal) || point < 0) continue;
    Crashes& of_point = crashes[point];
    ++of_point.times;
    of_point.signal = signal;
  }
  return crashes;
}

}  // namespace millstudy::sweep
