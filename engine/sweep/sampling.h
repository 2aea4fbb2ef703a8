// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

/// Samples of the unit cube, one dimension at a time: pure functions of the number of samples, the
/// dimension and the seed, the same on every machine.
namespace millstudy::sweep {

/// Dimensions for which sobol() has direction numbers.
inline constexpr int kSobolDimensions = 40;

/// Latin hypercube (M.D. McKay, R.J. Beckman, W.J. Conover, Technometrics 21 (1979) 239-245): of
/// samples equal parts of 0 .. 1 each holds one value, at a random place, in random order.
///
/// @return shape (samples), each > 0 and < 1
std::vector<double> latin_hypercube(std::int64_t samples, int dimension, std::uint64_t seed);

/// The first points of the sequence of I.M. Sobol' with the direction numbers of S. Joe and F.Y.
/// Kuo (SIAM J. Sci. Comput. 30 (2008) 2635-2654, new-joe-kuo-6), scrambled by A.B. Owen's nested
/// permutations, which keep its balance: of 2^k samples each of 2^k equal parts holds one.
///
/// @param dimension  0 .. kSobolDimensions - 1
/// @param samples    up to 2^32
/// @return shape (samples), multiples of 2^-32 and half of that: > 0 and < 1
std::vector<double> sobol(std::int64_t samples, int dimension, std::uint64_t seed);

/// Places of the points of a design for Sobol' indices (A. Saltelli et al., Comput. Phys. Commun.
/// 181 (2010) 259-270): groups of axes + 2 points each; of two samples a and b of a sequence in 2
/// axes dimensions the first point of a group is a, the second b, and point 2 + i is a with axis i
/// of b.
///
/// @param axes  1 .. kSobolDimensions / 2
/// @return shape (groups (axes + 2)), of one axis
std::vector<double> saltelli(std::int64_t groups, int axes, int axis, std::uint64_t seed);

/// Without scrambling, as integers over 2^32; the first is 0.
std::uint32_t sobol_integer(std::uint32_t index, int dimension);

}  // namespace millstudy::sweep
