// SPDX-License-Identifier: MIT
#include "identify/average_fit.h"

#include <cmath>
#include <gtest/gtest.h>

#include "core/error.h"
#include "force/revolution_mean.h"
#include "identify/student.h"
#include "unit/identify/synthetic_record.h"

namespace millstudy::identify {
namespace {

using testing::slot_truth;
using testing::Truth;
using testing::values;

/// Records whose mean over every revolution is exactly that of the model.
std::vector<Record> flat_records(const Truth& truth, std::vector<double> feeds) {
  std::vector<Record> records;
  for (const double feed_rate : feeds) {
    Record record{"feed",
                  {"feed", truth.sampling_rate, 0.0, {}},
                  truth.engagement,
                  feed_rate,
                  truth.spindle_speed};
    const force::ForceBasis mean = force::revolution_mean(truth.cutter, truth.engagement);
    const double feed = feed_rate * 2.0 * core::kPi / (truth.spindle_speed * truth.cutter.flutes);
    const auto force = force::evaluate(mean, truth.coefficients, {feed});
    for (int axis = 0; axis < 3; ++axis) record.trace.force[axis].assign(1000, force[axis]);
    records.push_back(record);
  }
  return records;
}

TEST(AverageFit, RecoversCoefficientsFromMeanForces) {
  for (const double exit_deg : {180.0, 90.0, 47.0}) {
    Truth truth = slot_truth();
    truth.cutter.runout = {};
    truth.engagement.exit_angle = core::rad_from_deg(exit_deg);
    const AverageFit fit = average_fit(truth.cutter, flat_records(truth, {3.0, 6.0, 9.0, 15.0}));
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(values(fit.coefficients)[i] / values(truth.coefficients)[i], 1.0, 1e-11);
    }
    EXPECT_NEAR(fit.r_squared[0], 1.0, 1e-12);
  }
}

TEST(AverageFit, AveragesWholeRevolutionsOfARecord) {
  Truth truth = slot_truth();
  truth.samples = 5000;
  std::vector<Record> records;
  for (const double feed_rate : {4.0, 8.0, 12.0, 16.0}) {
    truth.feed_rate = feed_rate;
    truth.phase += 0.9;
    records.push_back(testing::make_record(truth, "feed"));
  }
  const AverageFit fit = average_fit(truth.cutter, records);
  EXPECT_EQ(fit.records[0].revolutions, 12.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(values(fit.coefficients)[i] / values(truth.coefficients)[i], 1.0, 3e-3);
  }
}

TEST(AverageFit, ScalesWithTheForces) {
  const Truth truth = slot_truth();
  std::vector<Record> records = flat_records(truth, {3.0, 6.0, 10.0});
  records[1].trace.force[0].assign(1000, -300.0);  // off the line
  const AverageFit once = average_fit(truth.cutter, records);
  for (Record& record : records) {
    for (auto& force : record.trace.force) {
      for (double& f : force) f *= 2.0;
    }
  }
  const AverageFit twice = average_fit(truth.cutter, records);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(twice.estimates[i].value, 2.0 * once.estimates[i].value, 1e-9);
    EXPECT_NEAR(twice.estimates[i].standard_error, 2.0 * once.estimates[i].standard_error, 1e-9);
  }
}

TEST(AverageFit, SaysWhatIsMissing) {
  const Truth truth = slot_truth();
  EXPECT_THROW(average_fit(truth.cutter, flat_records(truth, {5.0})), core::InputError);
  EXPECT_THROW(average_fit(truth.cutter, flat_records(truth, {5.0, 5.0, 5.0})), core::InputError);
  std::vector<Record> flat = flat_records(truth, {5.0, 8.0, 11.0});
  for (Record& record : flat) record.trace.force[2].clear();
  cutter::Cutter cutter = truth.cutter;
  cutter.shape = cutter::Shape::flat;
  cutter.corner_radius = 0.0;
  EXPECT_THROW(average_fit(cutter, flat), core::InputError);
  flat[0].trace.force[0].resize(10), flat[0].trace.force[1].resize(10);
  EXPECT_THROW(average_fit(cutter, flat), core::InputError);
}

TEST(Student, HasThePointsOfTables) {
  // tan(0.475 pi); 0.95 / sqrt(2 * 0.975 * 0.025); R, qt(0.975, n)
  EXPECT_NEAR(student_975(1), std::tan(0.475 * core::kPi), 1e-11);
  EXPECT_NEAR(student_975(2), 0.95 / std::sqrt(2.0 * 0.975 * 0.025), 1e-12);
  EXPECT_NEAR(student_975(4), 2.77644510519779, 1e-12);
  EXPECT_NEAR(student_975(10), 2.22813885198627, 1e-12);
  EXPECT_NEAR(student_975(100), 1.98397151852355, 1e-12);
  EXPECT_NEAR(student_975(1e6), 1.95996635679, 1e-8);  // z + (z^3 + z) / (4 n)
}

}  // namespace
}  // namespace millstudy::identify
