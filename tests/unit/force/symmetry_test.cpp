// SPDX-License-Identifier: MIT
// Symmetries of an end mill that hold whatever the numbers are: whole axial pitches, both hands,
// and the surface that the teeth share.
#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <numeric>

#include "force/chip_law.h"
#include "force/sampler.h"
#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using cutter::Cutter;
using cutter::Shape;
using testing::Force;
using testing::uniform;

/// As one tooth leaves a height the next one comes to it: the edge in cut is always the same.
TEST(FlatForce, IsConstantAtWholeMultiplesOfTheAxialPitch) {
  constexpr int kSteps = 90;
  double worst = 0.0;
  for (const double helix_deg : {-50.0, 5.0, 30.0, 60.0}) {
    for (int flutes = 1; flutes <= 6; ++flutes) {
      for (const int pitches : {1, 2, 5}) {
        const Cutter cutter{Shape::flat, 12.0, flutes, core::rad_from_deg(helix_deg)};
        const double pitch = core::kPi * 12.0 / (flutes * std::abs(std::tan(cutter.helix_angle)));
        const double depth = pitches * pitch;
        for (const Engagement& engagement :
             {slot(depth), up_milling(6.0, 0.2, depth), Engagement{1.0, 1.4, depth}}) {
          ForceSamples f;
          ForceSampler(cutter, engagement, {}, kSteps)
              .sample(testing::kGgg70, {0.07}, 0, kSteps, f);
          const double size = std::hypot(f.x[0], f.y[0], f.z[0]);
          for (const auto* row : {&f.x, &f.y, &f.z}) {
            const double mean = std::accumulate(row->begin(), row->begin() + kSteps, 0.0) / kSteps;
            for (int i = 0; i < kSteps; ++i) {
              worst = std::max(worst, std::abs((*row)[i] - mean) / size);
            }
          }
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-12);
  std::cout << "flat at whole axial pitches: varies by " << worst << " of its mean\n";
}

/// Reflecting x turns a right-hand cutter into a left-hand one, phi into pi - phi, and swaps entry
/// and exit; Fx of radial and axial loads and Fy of tangential ones keep their sign with it.
TEST(EdgeForce, OfLeftHandBullNosesAndTapersIsTheMirrorImageOfRightHandOnes) {
  std::mt19937_64 random(41);
  double worst = 0.0;
  for (int round = 0; round < 400; ++round) {
    testing::Case c = testing::random_case(random, Shape::flat);
    Cutter& right = c.cutter;
    right.shape = round % 2 ? Shape::bull_nose : Shape::taper;
    right.corner_radius = 0.5 * right.diameter * uniform(random, 0.05, 0.8);
    right.taper_angle = round % 2 ? 0.0 : uniform(random, 0.01, 0.3);
    right.lead = round % 4 ? cutter::Lead::constant_lead : cutter::Lead::constant_helix;
    Cutter left = right;
    left.helix_angle = -left.helix_angle;
    const Engagement mirrored{core::kPi - c.engagement.exit_angle,
                              core::kPi - c.engagement.entry_angle, c.engagement.axial_depth};
    const double phi = uniform(random, -7.0, 7.0);
    const ForceBasis a = force_basis(right, c.engagement, {}, phi);
    const ForceBasis near = force_basis(right, c.engagement, {}, phi + 1e-14);
    const ForceBasis b = force_basis(left, mirrored, {}, core::kPi - phi);
    const double scale =
        c.engagement.axial_depth * (1.0 + std::tan(right.taper_angle)) + right.diameter;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < 3 * kColumns; ++column) {
        const bool tangential = column % kColumns == 0;
        const double sign = (row == 0 && tangential) || (row == 1 && !tangential) ? -1.0 : 1.0;
        const double unit = scale * (row == 3 ? scale : 1.0);
        // What rounding the angle does where the edge enters at once is not the law's fault.
        const double rounding = std::abs(entry(near, row, column) - entry(a, row, column));
        const double off = std::abs(entry(b, row, column) - sign * entry(a, row, column));
        worst = std::max(worst, (off - rounding) / unit);
      }
    }
  }
  EXPECT_LT(worst, 1e-13);
  std::cout << "left hand = mirrored right hand: " << worst << " of depth and diameter\n";
}

/// At a point of the surface the teeth take N feeds a revolution, however they share them.
TEST(ChipLaw, SumsToTheFeedOfARevolutionAtEveryPoint) {
  std::mt19937_64 random(42);
  double worst = 0.0;
  int missed = 0;
  for (int round = 0; round < 2000; ++round) {
    Cutter cutter{Shape::bull_nose, 12.0, 1 + static_cast<int>(random() % 6)};
    cutter.corner_radius = 3.0;
    double turn = 0.0;
    for (int j = 0; j < cutter.flutes; ++j) {
      cutter.pitch_angles.push_back(uniform(random, 0.7, 1.3));
      cutter.helix_angles.push_back(uniform(random, 0.5, 0.6));
      turn += cutter.pitch_angles.back();
    }
    for (double& pitch : cutter.pitch_angles) pitch *= 2.0 * core::kPi / turn;
    const double feed = uniform(random, 0.02, 0.2);
    cutter.runout = {feed * uniform(random, 0.0, 3.0), uniform(random, 0.0, 6.0),
                     feed * uniform(random, 0.0, 0.5), uniform(random, 0.0, 6.0)};
    const CuttingEdges edges(cutter, 5.0, {});
    const ChipLaw law(edges);
    std::vector<Reach> reaches(law.reaches());
    const double z = uniform(random, 0.1, 5.0), phi = uniform(random, 0.01, 3.13);
    const double sin_kappa = std::sin(edges.envelope().segment_at(z).kappa_at(z));
    double sum = 0.0;
    for (int j = 0; j < cutter.flutes; ++j) {
      law.find(j, edge_point(edges.envelope(), edges.flutes()[j].helix_tangent, z), reaches);
      const double h = ChipLaw::thickness(reaches, {feed}, std::sin(phi), sin_kappa, 0.0);
      missed += h == 0.0;
      sum += h;
    }
    worst =
        std::max(worst, std::abs(sum / (cutter.flutes * feed * std::sin(phi) * sin_kappa) - 1.0));
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(missed, 1000);
  std::cout << "chips of a revolution over N feeds: 1 to " << worst << ", " << missed
            << " cuts missed\n";
}

}  // namespace
}  // namespace millstudy::force
