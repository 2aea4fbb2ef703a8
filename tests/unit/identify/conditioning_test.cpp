// SPDX-License-Identifier: MIT
#include "identify/conditioning.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "core/error.h"
#include "identify/spindle_speed.h"
#include "identify/synchronous_average.h"
#include "unit/identify/synthetic_record.h"

namespace millstudy::identify {
namespace {

using testing::make_record;
using testing::slot_truth;
using testing::Truth;

/// Largest error in turns over the record, of records of 12 to 60 revolutions.
double worst_speed(double noise) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double worst = 0.0;
  for (int i = 0; i < 20; ++i) {
    Truth truth = slot_truth();
    truth.engagement.exit_angle = core::kPi * (0.3 + 0.7 * part(random));
    truth.spindle_speed = 80.0 * (1.0 + 0.036 * (part(random) - 0.5));
    truth.phase = 6.0 * part(random);
    truth.samples = 5000 + random() % 20000;
    Record record = make_record(truth, "record");
    add_noise(record.trace, noise, 0.5, i);
    const SpindleSpeed found = estimate_spindle_speed(record.trace, 80.0);
    const double time = static_cast<double>(truth.samples) / truth.sampling_rate;
    worst = std::max(worst, std::abs(found.value - truth.spindle_speed) * time / (2.0 * core::kPi));
  }
  std::printf("worst speed under %g N of noise: %.1e turns over the record\n", noise, worst);
  return worst;
}

TEST(SpindleSpeed, IsFoundFarBelowTheWidthOfABin) {
  EXPECT_LT(worst_speed(0.0), 2e-3);
  EXPECT_LT(worst_speed(100.0), 5e-3);
}

TEST(SpindleSpeed, SaysWhatPartOfTheForcesRepeats) {
  const Record record = make_record(slot_truth(), "clean");
  EXPECT_GT(estimate_spindle_speed(record.trace, 80.0).share, 0.98);
  Record noise = record;
  for (auto& force : noise.trace.force) std::fill(force.begin(), force.end(), 0.0);
  add_noise(noise.trace, 5.0, 0.0, 3);
  EXPECT_LT(estimate_spindle_speed(noise.trace, 80.0).share, 0.15);
}

TEST(SynchronousAverage, IsOneRevolutionOfASteadyForce) {
  Truth truth = slot_truth();
  truth.samples = 5000;
  const Record record = make_record(truth, "steady");
  const Trace turn = synchronous_average(record.trace, truth.spindle_speed);
  truth.samples = turn.size();
  truth.sampling_rate = turn.sampling_rate;
  const double middle = 0.5 * 4999.0 / 5000.0 * truth.spindle_speed;
  truth.phase += middle + core::kPi / static_cast<double>(turn.size());
  const Record again = make_record(truth, "one revolution");
  double high = 0.0, wrong = 0.0;
  for (std::size_t i = 0; i < turn.size(); ++i) {
    high = std::max(high, std::abs(again.trace.force[1][i]));
    wrong = std::max(wrong, std::abs(turn.force[1][i] - again.trace.force[1][i]));
  }
  EXPECT_LT(wrong, 0.1 * high);  // edges spread over a bin of a degree
}

/// Air, a cut of the length of the record, air; with an offset and a drift.
Trace with_air(const Record& record, std::size_t air, double offset, double drift) {
  Trace trace = record.trace;
  for (std::vector<double>& force : trace.force) {
    std::vector<double> longer(air, 0.0);
    longer.insert(longer.end(), force.begin(), force.end());
    longer.insert(longer.end(), air, 0.0);
    for (std::size_t i = 0; i < longer.size(); ++i) {
      longer[i] += offset + drift * static_cast<double>(i) / trace.sampling_rate;
    }
    force = std::move(longer);
  }
  return trace;
}

TEST(CuttingPart, IsThatInWhichTheToolCuts) {
  Truth truth = slot_truth();
  truth.samples = 6000;
  const Record record = make_record(truth, "cut");
  Trace trace = with_air(record, 2000, 0.0, 0.0);
  add_noise(trace, 5.0, 0.5, 4);
  const Part part = cutting_part(trace, truth.spindle_speed);
  const double turn = 2.0 * core::kPi / truth.spindle_speed * truth.sampling_rate;
  EXPECT_GE(part.first, 2000u);
  EXPECT_LE(part.first + part.count, 8000u);
  EXPECT_GT(static_cast<double>(part.count), 6000.0 - 4.0 * turn);
  const Trace cut = part_of(trace, part);
  EXPECT_EQ(cut.size(), part.count);
  EXPECT_DOUBLE_EQ(cut.start, static_cast<double>(part.first) / truth.sampling_rate);
  const Part all = cutting_part(record.trace, truth.spindle_speed);
  EXPECT_EQ(all.count, record.trace.size());
}

TEST(AirOffset, IsRemovedWithItsDrift) {
  Truth truth = slot_truth();
  truth.samples = 6000;
  const Record record = make_record(truth, "cut");
  Trace trace = with_air(record, 2500, 12.0, -3.0);
  remove_air_offset(trace, truth.spindle_speed);
  for (std::size_t i = 0; i < record.trace.size(); ++i) {
    ASSERT_NEAR(trace.force[0][2500 + i], record.trace.force[0][i], 1e-9);
  }
  Trace none = record.trace;
  EXPECT_THROW(remove_air_offset(none, truth.spindle_speed), core::InputError);
}

TEST(LookOver, FindsNothingOddInAGoodRecord) {
  Truth truth = slot_truth();
  truth.samples = 6000;
  Record record = make_record(truth, "good");
  add_noise(record.trace, 5.0, 0.5, 4);
  EXPECT_TRUE(look_over(truth.cutter, record).empty());
}

TEST(LookOver, FindsWrongAxesFlutesAndSpikes) {
  Truth truth = slot_truth();
  truth.engagement.exit_angle = 0.5 * core::kPi;
  truth.samples = 6000;
  Record record = make_record(truth, "odd");
  add_noise(record.trace, 5.0, 0.5, 4);
  const auto says = [&](const cutter::Cutter& cutter, const Record& odd, const char* words) {
    const std::vector<std::string> all = look_over(cutter, odd);
    return std::any_of(all.begin(), all.end(), [&](const std::string& text) {
      return text.find(words) != std::string::npos;
    });
  };
  Record swapped = record;
  std::swap(swapped.trace.force[0], swapped.trace.force[1]);
  EXPECT_TRUE(says(truth.cutter, swapped, "x = y, y = x, z = z"));
  cutter::Cutter three = truth.cutter;
  three.flutes = 3;
  EXPECT_TRUE(says(three, record, "repeat 2 times a revolution, the cutter has 3"));
  record.trace.force[2][1234] += 4000.0;
  EXPECT_TRUE(says(truth.cutter, record, "1 sample is far off"));
}

}  // namespace
}  // namespace millstudy::identify
