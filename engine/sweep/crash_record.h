// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace millstudy::sweep {

/// The point that this thread computes now; -1: none. For the handler of a crash, which can reach
/// nothing else.
inline thread_local std::int64_t current_point = -1;

/// From here on a crash of the process (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) adds a line with
/// the point of the crashing thread to a file, and then ends the process as it would have ended.
/// Not under sanitizers, which tell more.
///
/// @param path  of the file; made by the first crash
void record_crashes(const std::string& path);

/// Called once on every thread that computes: an overflow of its stack is a crash like others.
void prepare_thread_for_crashes();

/// How often each point crashed, and the signal of the last time.
struct Crashes {
  int times = 0;
  int signal = 0;
};
/// From such a file; empty if there is none. What is no such line is passed over.
std::map<std::int64_t, Crashes> read_crashes(const std::string& path);

}  // namespace millstudy::sweep
