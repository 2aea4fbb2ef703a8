// SPDX-License-Identifier: MIT
#include "identify/fit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.h"
#include "force/sensitivity.h"
#include "unit/identify/synthetic_record.h"

namespace millstudy::identify {
namespace {

using testing::make_record;
using testing::slot_truth;
using testing::Truth;
using testing::values;

/// Worst relative error of the six coefficients.
double off(const force::Coefficients& found, const force::Coefficients& truth) {
  double worst = 0.0;
  for (int i = 0; i < 6; ++i) {
    worst = std::max(worst, std::abs(values(found)[i] / values(truth)[i] - 1.0));
  }
  return worst;
}

/// Three feeds of one cut, each with a phase, a speed, a runout and offsets of its own.
std::vector<Record> three_feeds(Truth truth) {
  std::vector<Record> records;
  for (int i = 0; i < 3; ++i) {
    truth.feed_rate = 4.0 + 4.0 * i;
    truth.spindle_speed = 80.0 + 0.3 * i;
    truth.phase += 1.7;
    truth.cutter.runout.offset += 0.004;
    truth.cutter.runout.angle += 0.4;
    truth.offset = {1.0 + i, -2.0, 0.5 * i};
    records.push_back(make_record(truth, "feed " + std::to_string(i)));
    records.back().spindle_speed = 80.1;  // what the machine displays
  }
  return records;
}

TEST(Fit, RecoversCoefficientsFromNoiselessForces) {
  // Of half immersion, where edge and offset along z separate.
  Truth truth = slot_truth();
  truth.engagement = {0.0, 0.5 * core::kPi, 2.0};
  const FitResult result = fit(truth.cutter, three_feeds(truth), {});
  std::printf("worst coefficient: %.1e, in %d iterations\n",
              off(result.coefficients, truth.coefficients), result.iterations);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(off(result.coefficients, truth.coefficients), 1e-8);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(result.records[i].spindle_speed, 80.0 + 0.3 * i, 1e-7);
    EXPECT_NEAR(result.records[i].offset[0], 1.0 + i, 1e-6);
    EXPECT_GT(result.records[i].agreement.r_squared[1], 1.0 - 1e-12);
  }
}

}  // namespace
}  // namespace millstudy::identify
