// SPDX-License-Identifier: MIT
#include "force/variation.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <memory>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::force {
namespace {

using core::rad_from_deg;

OrthogonalData data_of(double shear_stress, double shear_deg, double friction_deg,
                       double rake_deg) {
  return {{shear_stress},
          {rad_from_deg(shear_deg)},
          {rad_from_deg(friction_deg)},
          rad_from_deg(rake_deg)};
}

/// Al 6061 and an end mill of 30 deg helix, a worked example of the classical transformation in a
/// course on metal cutting (github.com/keshaviyengar/CuttingForcesSim, proj2complete.m).
TEST(ObliqueCoefficients, AreThoseOfAWorkedExample) {
  const OrthogonalData data = data_of(209.24, 27.67, 32.27, 5.0);
  const std::array<double, 3> k = oblique_coefficients(data, rad_from_deg(30.0), 0.05);
  EXPECT_NEAR(k[0], 709.0, 0.5);
  EXPECT_NEAR(k[1], 306.0, 0.5);
  EXPECT_NEAR(k[2], 166.0, 0.5);
}

/// Merchant's force: Ktc = tau cos(beta - alpha) / (sin(phi) cos(phi + beta - alpha)), and Krc with
/// the sine.
TEST(ObliqueCoefficients, AreThoseOfOrthogonalCuttingWithoutHelix) {
  for (const double rake_deg : {-10.0, 0.0, 12.0}) {
    const OrthogonalData data = data_of(500.0, 31.0, 24.0, rake_deg);
    const double along = rad_from_deg(24.0 - rake_deg), shear = rad_from_deg(31.0);
    const double resultant = 500.0 / (std::sin(shear) * std::cos(shear + along));
    const std::array<double, 3> k = oblique_coefficients(data, 0.0, 0.1);
    EXPECT_NEAR(k[0], resultant * std::cos(along), 1e-12 * resultant);
    EXPECT_NEAR(k[1], resultant * std::sin(along), 1e-12 * resultant);
    EXPECT_EQ(k[2], 0.0);
  }
}

TEST(ObliqueCoefficients, DoNotSeeTheHand) {
  const OrthogonalData data = data_of(209.24, 27.67, 32.27, 5.0);
  for (const double helix_deg : {1.0, 30.0, 60.0}) {
    EXPECT_EQ(oblique_coefficients(data, rad_from_deg(helix_deg), 0.05),
              oblique_coefficients(data, rad_from_deg(-helix_deg), 0.05));
  }
}

TEST(ObliqueCoefficients, FollowRakeAndChipLinearly) {
  OrthogonalData data = data_of(0.0, 0.0, 0.0, 4.0);
  data.shear_stress = {600.0, 100.0, -200.0};
  data.shear_angle = {0.4, 0.5, 0.6};
  data.friction_angle = {0.5, -0.3, -0.4};
  const double rake = data.rake_angle, chip = 0.2;
  OrthogonalData there = data_of(0.0, 0.0, 0.0, 4.0);
  there.shear_stress = {600.0 + 100.0 * rake - 200.0 * chip};
  there.shear_angle = {0.4 + 0.5 * rake + 0.6 * chip};
  there.friction_angle = {0.5 - 0.3 * rake - 0.4 * chip};
  EXPECT_EQ(oblique_coefficients(data, 0.3, chip), oblique_coefficients(there, 0.3, 0.0));
}

TEST(ObliqueCoefficients, AreFiniteWhateverTheRatesSay) {
  for (const double rate : {-1e6, 1e6}) {
    OrthogonalData data = data_of(500.0, 30.0, 30.0, 5.0);
    data.shear_stress.per_chip = data.shear_angle.per_chip = data.friction_angle.per_chip = rate;
    for (const double k : oblique_coefficients(data, rad_from_deg(30.0), 1.0)) {
      EXPECT_TRUE(std::isfinite(k));
    }
  }
}

TEST(HeightFactors, AreOneWithoutTableAndPolynomial) {
  for (const double factor : height_factors({}, 3.0)) EXPECT_EQ(factor, 1.0);
}

TEST(HeightFactors, InterpolateTheTableAndStayConstantBeyondItsEnds) {
  HeightFactors factors;
  factors.heights = {1.0, 2.0, 4.0};
  factors.table[1] = {0.5, 1.5, 3.5};
  const auto second = [&](double z) { return height_factors(factors, z)[1]; };
  EXPECT_EQ(second(0.0), 0.5);
  EXPECT_EQ(second(1.0), 0.5);
  EXPECT_DOUBLE_EQ(second(1.25), 0.75);
  EXPECT_EQ(second(2.0), 1.5);
  EXPECT_DOUBLE_EQ(second(3.5), 3.0);
  EXPECT_EQ(second(4.0), 3.5);
  EXPECT_EQ(second(100.0), 3.5);
  for (const int other : {0, 2, 3, 4, 5}) EXPECT_EQ(height_factors(factors, 3.5)[other], 1.0);
}

TEST(HeightFactors, MultiplyTableAndPolynomial) {
  HeightFactors factors;
  factors.polynomial[0] = {0.1, -0.02, 0.003, -0.0004};
  factors.polynomial[3] = {-1.0};
  factors.heights = {0.0, 10.0};
  factors.table[3] = {2.0, 4.0};
  for (const double z : {0.0, 0.5, 7.0}) {
    const std::array<double, 6> at_z = height_factors(factors, z);
    EXPECT_NEAR(at_z[0],
                1.0 + 0.1 * z - 0.02 * z * z + 0.003 * std::pow(z, 3) - 0.0004 * std::pow(z, 4),
                1e-15);
    EXPECT_NEAR(at_z[3], (1.0 - z) * (2.0 + 0.2 * z), 1e-14);
    EXPECT_EQ(at_z[5], 1.0);
  }
}

TEST(Variation, RefusesWhatIsOutOfRange) {
  const auto refused = [](const HeightFactors& factors) {
    Variation variation;
    variation.height = std::make_shared<const HeightFactors>(factors);
    EXPECT_THROW(check(variation), core::InputError);
  };
  HeightFactors factors;
  factors.heights = {1.0, 1.0};
  refused(factors);
  factors.heights = {-1.0, 1.0};
  refused(factors);
  factors.heights = {0.0, 1.0};
  factors.table[2] = {1.0};
  refused(factors);
  factors.table[2].clear();
  factors.polynomial[4] = {1.0, 1.0, 1.0, 1.0, 1.0};
  refused(factors);
  Variation variation;
  for (const double m : {-0.1, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    variation.size_exponent = {0.0, m, 0.0};
    EXPECT_THROW(check(variation), core::InputError) << m;
  }
  variation.size_exponent = {0.2, 0.0, 0.99};
  EXPECT_NO_THROW(check(variation));
  variation.reference_chip_thickness = 0.0;
  EXPECT_THROW(check(variation), core::InputError);
}

}  // namespace
}  // namespace millstudy::force
