// SPDX-License-Identifier: MIT
#include "sweep/sampling.h"

#include <array>
#include <cassert>
#include <numeric>
#include <random>

namespace millstudy::sweep {
namespace {

constexpr int kBits = 32;

/// A primitive polynomial x^degree + a x^(degree-1) ... + 1 and the numbers that begin its
/// directions.
struct Primitive {
  int degree;
  unsigned inner;  // coefficients between the first and the last, as bits
  std::array<std::uint32_t, 8> first;
};

// clang-format off
constexpr std::array<Primitive, kSobolDimensions - 1> kPrimitives = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
    {6, 19, {1, 1, 1, 15, 7, 5}},
    {6, 22, {1, 3, 1, 15, 13, 25}},
    {6, 25, {1, 1, 5, 5, 19, 61}},
    {7, 1, {1, 3, 7, 11, 23, 15, 103}},
    {7, 4, {1, 3, 7, 13, 13, 15, 69}},
    {7, 7, {1, 1, 3, 13, 7, 35, 63}},
    {7, 8, {1, 3, 5, 9, 1, 25, 53}},
    {7, 14, {1, 3, 1, 13, 9, 35, 107}},
    {7, 19, {1, 3, 1, 5, 27, 61, 31}},
    {7, 21, {1, 1, 5, 11, 19, 41, 61}},
    {7, 28, {1, 3, 5, 3, 3, 13, 69}},
    {7, 31, {1, 1, 7, 13, 1, 19, 1}},
    {7, 32, {1, 3, 7, 5, 13, 19, 59}},
    {7, 37, {1, 1, 3, 9, 25, 29, 41}},
    {7, 41, {1, 3, 5, 13, 23, 1, 55}},
    {7, 42, {1, 3, 7, 3, 13, 59, 17}},
    {7, 50, {1, 3, 1, 3, 5, 53, 69}},
    {7, 55, {1, 1, 5, 5, 23, 33, 13}},
    {7, 56, {1, 1, 7, 7, 1, 61, 123}},
    {7, 59, {1, 1, 7, 9, 13, 61, 49}},
    {7, 62, {1, 3, 3, 5, 3, 55, 33}},
    {8, 14, {1, 3, 1, 15, 31, 13, 49, 245}},
    {8, 21, {1, 3, 5, 15, 31, 59, 63, 97}},
    {8, 22, {1, 3, 1, 11, 11, 11, 77, 249}},
}};
// clang-format on

/// Directions of a dimension, the most significant bit first.
std::array<std::uint32_t, kBits> directions(int dimension) {
  std::array<std::uint32_t, kBits> v{};
  if (dimension == 0) {
    for (int i = 0; i < kBits; ++i) v[i] = std::uint32_t{1} << (kBits - 1 - i);
    return v;
  }
  const Primitive& p = kPrimitives[dimension - 1];
  for (int i = 0; i < kBits; ++i) {
    if (i < p.degree) {
      v[i] = p.first[i] << (kBits - 1 - i);
      continue;
    }
    v[i] = v[i - p.degree] ^ (v[i - p.degree] >> p.degree);
    for (int k = 1; k < p.degree; ++k) {
      if (p.inner >> (p.degree - 1 - k) & 1U) v[i] ^= v[i - k];
    }
  }
  return v;
}

std::uint32_t combined(const std::array<std::uint32_t, kBits>& v, std::uint32_t index) {
  std::uint32_t x = 0;
  for (int bit = 0; index != 0; ++bit, index >>= 1) {
    if (index & 1U) x ^= v[bit];
  }
  return x;
}

/// A well mixed number of two (the finaliser of splitmix64).
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = a ^ (b + 0x9e3779b97f4a7c15ULL + (a << 6) + (a >> 2));
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Each bit is turned or not by what the bits above it are: the same for all that share them.
std::uint32_t scrambled(std::uint32_t x, std::uint64_t seed) {
  std::uint32_t flips = static_cast<std::uint32_t>(mixed(seed, 1) & 1U) << (kBits - 1);
  for (int bit = 1; bit < kBits; ++bit) {
    const std::uint64_t above = (std::uint64_t{1} << bit) | (x >> (kBits - bit));
    flips |= static_cast<std::uint32_t>(mixed(seed, above) & 1U) << (kBits - 1 - bit);
  }
  return x ^ flips;
}

}  // namespace

std::vector<double> latin_hypercube(std::int64_t samples, int dimension, std::uint64_t seed) {
  std::mt19937_64 random(mixed(seed, static_cast<std::uint64_t>(dimension)));
  std::vector<std::int64_t> part(static_cast<std::size_t>(samples));
  std::iota(part.begin(), part.end(), 0);
  // The standard's own shuffle differs from library to library.
  for (std::size_t i = part.size(); i > 1; --i) std::swap(part[i - 1], part[random() % i]);
  std::vector<double> values;
  values.reserve(part.size());
  for (const std::int64_t p : part) {
    const double within = (static_cast<double>(random() >> 12) + 0.5) * 0x1p-52;
    values.push_back((static_cast<double>(p) + within) / static_cast<double>(samples));
  }
  return values;
}

std::uint32_t sobol_integer(std::uint32_t index, int dimension) {
  assert(0 <= dimension && dimension < kSobolDimensions);
  return combined(directions(dimension), index);
}

std::vector<double> sobol(std::int64_t samples, int dimension, std::uint64_t seed) {
  assert(0 <= dimension && dimension < kSobolDimensions);
  const std::array<std::uint32_t, kBits> v = directions(dimension);
  const std::uint64_t own = mixed(seed, static_cast<std::uint64_t>(dimension));
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(samples));
  for (std::int64_t i = 0; i < samples; ++i) {
    const std::uint32_t x = scrambled(combined(v, static_cast<std::uint32_t>(i)), own);
    values.push_back((static_cast<double>(x) + 0.5) * 0x1p-32);
  }
  return values;
}

std::vector<double> saltelli(std::int64_t groups, int axes, int axis, std::uint64_t seed) {
  const std::vector<double> a = sobol(groups, axis, seed);
  const std::vector<double> b = sobol(groups, axes + axis, seed);
  std::vector<double> values;
  values.reserve(a.size() * static_cast<std::size_t>(axes + 2));
  for (std::size_t group = 0; group < a.size(); ++group) {
    values.push_back(a[group]);
    values.push_back(b[group]);
    for (int i = 0; i < axes; ++i) values.push_back(i == axis ? b[group] : a[group]);
  }
  return values;
}

}  // namespace millstudy::sweep
