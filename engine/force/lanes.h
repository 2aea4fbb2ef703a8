// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>
#if defined(__AVX__)
#include <immintrin.h>
#endif

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

// The compiler takes loops over lanes through memory, lane by lane.
[[gnu::always_inline]] inline Lanes square_root(Lanes lanes) {
#if defined(__AVX512F__)
  return _mm512_maskz_sqrt_pd(0xff, lanes);  // of the plain one g++ 12 warns without reason
#elif defined(__AVX__)
  return _mm256_sqrt_pd(lanes);
#else
  for (int i = 0; i < kLanes; ++i) lanes[i] = std::sqrt(lanes[i]);
  return lanes;
#endif
}

/// Of code for one value as for lanes.
inline double square_root(double value) {
  return std::sqrt(value);
}

/// True if a comparison holds in any lane.
template <class Mask>
[[gnu::always_inline]] inline bool any(const Mask& mask) {
#if defined(__AVX512DQ__)
  return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) != 0;
#elif defined(__AVX__) && !defined(__AVX512F__)
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
  long long found = 0;
  for (int i = 0; i < kLanes; ++i) found |= mask[i];
  return found != 0;
#endif
}

}  // namespace millstudy::force
