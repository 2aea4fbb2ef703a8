// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>

namespace millstudy::force {

/// As many doubles at once as a vector register holds: a longer vector would be split by the
/// compiler, and pass through memory at every comparison.
///
/// And not `omp simd` loops: those leave up to seven angles of every range to a scalar remainder,
/// which is all of it where a ramp is six angles long, and whose bits are those of the vector loop
/// only by luck of how the compiler contracts products and sums. Here every angle goes through the
/// same instructions wherever its range is cut.
///
/// No header of the library's users may depend on it: they may compile for another machine.
#if defined(__AVX512F__)
using Lanes = double __attribute__((vector_size(64)));
inline constexpr Lanes kLaneIndex = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
#elif defined(__AVX__)
using Lanes = double __attribute__((vector_size(32)));
inline constexpr Lanes kLaneIndex = {0.0, 1.0, 2.0, 3.0};
#else
using Lanes = double __attribute__((vector_size(16)));
inline constexpr Lanes kLaneIndex = {0.0, 1.0};
#endif
inline constexpr int kLanes = sizeof(Lanes) / sizeof(double);

/// Loads doubles from any address.
[[gnu::always_inline]] inline Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// The first `count` lanes of memory, the others zero.
[[gnu::always_inline]] inline Lanes load_part(const double* from, int count) {
  Lanes lanes{};
  for (int i = 0; i < count; ++i) lanes[i] = from[i];
  return lanes;
}

/// Adds the first `count` lanes (all from kLanes on) to memory, where there must be room for all;
/// what is there counts as zero if it is the first to be written.
[[gnu::always_inline]] inline void add_to(double* to, const Lanes& lanes, int count, bool first) {
  const Lanes counted = kLaneIndex < Lanes{} + static_cast<double>(count) ? lanes : Lanes{};
  const Lanes sum = (first ? Lanes{} : load(to)) + counted;
  std::memcpy(to, &sum, sizeof sum);
}

[[gnu::always_inline]] inline Lanes square_root(Lanes lanes) {
  for (int i = 0; i < kLanes; ++i) lanes[i] = std::sqrt(lanes[i]);
  return lanes;
}

}  // namespace millstudy::force
