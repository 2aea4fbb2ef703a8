// SPDX-License-Identifier: MIT
#include "sweep/sampling.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numbers>

namespace millstudy::sweep {
namespace {

// From the file new-joe-kuo-6.21201 by the recurrence of Joe and Kuo's notes; scipy 1.10 has the
// same.
TEST(Sobol, IsTheSequenceOfJoeAndKuo) {
  const std::vector<std::vector<double>> points = {
      {0.0, 0.0, 0.0},       {0.5, 0.5, 0.5},       {0.75, 0.25, 0.25},    {0.25, 0.75, 0.75},
      {0.375, 0.375, 0.625}, {0.875, 0.875, 0.125}, {0.625, 0.125, 0.875}, {0.125, 0.625, 0.375}};
  // In Gray code order there, in binary order here: the same points.
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t gray = i ^ (i >> 1);
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(sobol_integer(gray, d) * 0x1p-32, points[i][d]) << i << ' ' << d;
    }
  }
}

TEST(Sobol, HasOneValueInEachPartOfEveryDimensionWhateverTheSeed) {
  for (const std::uint64_t seed : {0U, 1U, 12345U}) {
    for (int d = 0; d < kSobolDimensions; ++d) {
      std::vector<double> u = sobol(1024, d, seed);
      std::sort(u.begin(), u.end());
      for (int i = 0; i < 1024; ++i) {
        ASSERT_EQ(static_cast<int>(u[i] * 1024.0), i) << "dimension " << d << ", seed " << seed;
      }
    }
  }
  EXPECT_NE(sobol(8, 0, 1), sobol(8, 0, 2));
  EXPECT_NE(sobol(8, 0, 1), sobol(8, 1, 1));
}

TEST(LatinHypercube, HasOneValueInEachPart) {
  for (const std::int64_t n : {1, 7, 1000}) {
    for (int d = 0; d < 3; ++d) {
      std::vector<double> u = latin_hypercube(n, d, 4);
      std::sort(u.begin(), u.end());
      for (std::int64_t i = 0; i < n; ++i) {
        ASSERT_EQ(static_cast<std::int64_t>(u[i] * static_cast<double>(n)), i);
      }
    }
  }
  EXPECT_NE(latin_hypercube(100, 0, 1), latin_hypercube(100, 0, 2));
  EXPECT_EQ(latin_hypercube(100, 5, 1), latin_hypercube(100, 5, 1));
}

/// Mean of the product of |4 u - 2| over the dimensions, which is 1 (Sobol's g-function, a = 0).
double g_mean(const std::vector<std::vector<double>>& u) {
  double sum = 0.0;
  for (std::size_t i = 0; i < u[0].size(); ++i) {
    double product = 1.0;
    for (const std::vector<double>& dimension : u) product *= std::abs(4.0 * dimension[i] - 2.0);
    sum += product;
  }
  return sum / static_cast<double>(u[0].size());
}

TEST(Sampling, IntegratesBetterThanChance) {
  constexpr int kDimensions = 6, kSeeds = 20;
  constexpr std::int64_t kSamples = 4096;
  double sobol_square = 0.0, latin_square = 0.0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    std::vector<std::vector<double>> s, l;
    for (int d = 0; d < kDimensions; ++d) {
      s.push_back(sobol(kSamples, d, seed));
      l.push_back(latin_hypercube(kSamples, d, seed));
    }
    sobol_square += std::pow(g_mean(s) - 1.0, 2) / kSeeds;
    latin_square += std::pow(g_mean(l) - 1.0, 2) / kSeeds;
  }
  const double chance = std::sqrt((std::pow(4.0 / 3.0, kDimensions) - 1.0) / kSamples);
  std::cout << "root mean square error: chance " << chance << ", Latin hypercube "
            << std::sqrt(latin_square) << ", Sobol " << std::sqrt(sobol_square) << "\n";
  EXPECT_LT(std::sqrt(latin_square), 0.9 * chance);
  EXPECT_LT(std::sqrt(sobol_square), 0.2 * chance);
}

}  // namespace
}  // namespace millstudy::sweep
