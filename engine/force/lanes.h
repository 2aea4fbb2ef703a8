// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>

namespace millstudy::force {

/// Eight doubles at once; the compiler splits them where the machine has shorter vectors.
///
/// And not `omp simd` loops: those leave up to seven angles of every range to a scalar remainder,
/// which is all of it where a ramp is six angles long, and whose bits are those of the vector loop
/// only by luck of how the compiler contracts products and sums. Here every angle goes through the
/// same instructions wherever its range is cut.
inline constexpr int kLanes = 8;

using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

inline constexpr Lanes kLaneIndex = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

/// Loads eight doubles from any address.
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

/// Adds the first `count` lanes (all from 8 on) to memory, of which all eight must be there; what
/// is there counts as zero if it is the first to be written.
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
