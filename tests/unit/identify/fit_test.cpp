// SPDX-License-Identifier: MIT
#include "identify/fit.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <tbb/global_control.h>

#include "core/error.h"
#include "force/sensitivity.h"
#include "identify/joint_problem.h"
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

/// Half immersion, where edge and offset along z separate.
Truth half_immersion() {
  Truth truth = slot_truth();
  truth.engagement = {0.0, 0.5 * core::kPi, 2.0};
  return truth;
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
  const Truth truth = half_immersion();
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

TEST(Fit, RecoversSlopesOverHeight) {
  Truth truth = half_immersion();
  force::HeightFactors factors;
  for (int i = 0; i < 6; ++i) factors.polynomial[i] = {0.05 * (i - 2)};
  truth.variation.height = std::make_shared<const force::HeightFactors>(factors);
  std::vector<Record> records = three_feeds(truth);
  truth.engagement.axial_depth = 3.0;  // another depth tells slopes from values
  truth.phase = 0.3;
  records.push_back(make_record(truth, "deeper"));
  FitSettings settings;
  settings.model = Model::per_height;
  const FitResult result = fit(truth.cutter, records, settings);
  EXPECT_LT(off(result.coefficients, truth.coefficients), 1e-8);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(result.height_slope[i], 0.05 * (i - 2) * values(truth.coefficients)[i],
                1e-7 * values(truth.coefficients)[i]);
  }
}

TEST(Fit, RecoversASizeEffect) {
  Truth truth = half_immersion();
  truth.variation.size_exponent = {0.2, 0.2, 0.2};
  truth.variation.reference_chip_thickness = 0.1;
  FitSettings settings;
  settings.model = Model::exponential;
  const FitResult result = fit(truth.cutter, three_feeds(truth), settings);
  EXPECT_NEAR(result.size_exponent, 0.2, 1e-9);
  EXPECT_LT(off(result.coefficients, truth.coefficients), 1e-8);
}

TEST(Fit, RecoversTheDynamometer) {
  Truth truth = half_immersion();
  for (int axis = 0; axis < 3; ++axis) {
    truth.dynamometer[axis] = {{{2.0 * core::kPi * (500.0 + 100.0 * axis), 0.03}, 0.8}};
  }
  FitSettings settings;
  settings.estimate_dynamometer = true;
  for (int axis = 0; axis < 3; ++axis) {
    settings.dynamometer[axis] = {{{2.0 * core::kPi * (515.0 + 100.0 * axis), 0.05}, 1.0}};
  }
  const FitResult result = fit(truth.cutter, three_feeds(truth), settings);
  EXPECT_LT(off(result.coefficients, truth.coefficients), 1e-6);
  for (int axis = 0; axis < 3; ++axis) {
    const dynamics::DynamometerMode& mode = result.dynamometer[axis][0];
    EXPECT_NEAR(mode.mode.natural_frequency / truth.dynamometer[axis][0].mode.natural_frequency,
                1.0, 1e-7);
    EXPECT_NEAR(mode.mode.damping_ratio, 0.03, 1e-7);
    EXPECT_NEAR(mode.gain, 0.8, 1e-6);
  }
}

TEST(Fit, ScalesWithTheForces) {
  const Truth truth = half_immersion();
  std::vector<Record> records = three_feeds(truth);
  for (std::size_t r = 0; r < 3; ++r) add_noise(records[r].trace, 5.0, 0.8, r);
  const FitResult once = fit(truth.cutter, records, {});
  for (Record& record : records) {
    for (auto& force : record.trace.force) {
      for (double& f : force) f *= 3.0;
    }
  }
  const FitResult thrice = fit(truth.cutter, records, {});
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(thrice.estimates[i].value / once.estimates[i].value, 3.0, 1e-4);
    EXPECT_NEAR(thrice.estimates[i].standard_error / once.estimates[i].standard_error, 3.0, 1e-2);
  }
}

TEST(Fit, IsTheSameForAnyNumberOfThreads) {
  const Truth truth = half_immersion();
  std::vector<Record> records = three_feeds(truth);
  for (std::size_t r = 0; r < 3; ++r) add_noise(records[r].trace, 5.0, 0.8, r);
  std::vector<FitResult> results;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(fit(truth.cutter, records, {}));
  }
  for (const FitResult& result : results) {
    for (std::size_t i = 0; i < result.estimates.size(); ++i) {
      EXPECT_EQ(result.estimates[i].value, results[0].estimates[i].value);
      EXPECT_EQ(result.estimates[i].standard_error, results[0].estimates[i].standard_error);
    }
    EXPECT_EQ(result.records[2].predicted[0], results[0].records[2].predicted[0]);
    EXPECT_EQ(result.prediction_error, results[0].prediction_error);
  }
}

// Two modes an axis, each of which takes the force that the cut makes, over several stretches.
TEST(RecordModel, HasTheSignalOfADynamometerForAnyNumberOfThreads) {
  Truth truth = half_immersion();
  truth.samples = 9001;
  for (int axis = 0; axis < 3; ++axis) {
    truth.dynamometer[axis] = {{{2.0 * core::kPi * (500.0 + 100.0 * axis), 0.03}, 0.8},
                               {{2.0 * core::kPi * 1100.0, 0.05}, -0.3}};
  }
  const std::vector<Record> records = {make_record(truth, "two modes")};
  FitSettings settings;
  settings.estimate_dynamometer = true;
  settings.dynamometer = truth.dynamometer;
  RecordState state;
  const std::array<double, 6> k = values(truth.coefficients);
  std::copy(k.begin(), k.end(), state.coefficients.k.begin());
  state.dynamometer = truth.dynamometer;
  const double middle = 0.5 * static_cast<double>(truth.samples - 1) / truth.sampling_rate;
  state.phase = truth.phase + truth.spindle_speed * middle;
  state.spindle_speed = truth.spindle_speed;
  const cutter::Runout& runout = truth.cutter.runout;
  state.runout = {runout.offset * std::cos(runout.angle), runout.offset * std::sin(runout.angle)};
  std::vector<NormalEquations> sums;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const JointProblem problem(truth.cutter, records, settings, {state});
    sums.push_back(problem.sum(0, problem.states()[0]));
  }
  double forces = 0.0;
  for (const std::vector<double>& force : records[0].trace.force) {
    for (const double f : force) forces += f * f;
  }
  std::printf("residual of the true state: %.1e of the force\n",
              std::sqrt(sums[0].squares / forces));
  EXPECT_LT(sums[0].squares, 1e-20 * forces);
  for (const NormalEquations& one : sums) {
    EXPECT_EQ(one.gram, sums[0].gram);
    EXPECT_EQ(one.gradient, sums[0].gradient);
  }
}

TEST(Bootstrap, HasTheErrorsOfCorrelatedResidualsForAnyNumberOfThreads) {
  Truth truth = half_immersion();
  truth.samples = 4000;
  std::vector<Record> records = three_feeds(truth);
  for (std::size_t r = 0; r < 3; ++r) add_noise(records[r].trace, 5.0, 0.8, r);
  FitSettings settings;
  settings.bootstrap = 60;
  std::vector<FitResult> results;
  for (const std::size_t threads : {1, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(fit(truth.cutter, records, settings));
  }
  double worst = 0.0;
  for (int i = 0; i < 6; ++i) {
    const Estimate& e = results[0].estimates[i];
    worst = std::max(worst, std::abs(std::log(e.bootstrap_error / e.standard_error)));
    EXPECT_LT(e.bootstrap_low, e.value + 0.5 * e.standard_error) << e.name;
    EXPECT_GT(e.bootstrap_high, e.value - 0.5 * e.standard_error) << e.name;
    EXPECT_NEAR(e.bootstrap_high - e.bootstrap_low, 3.92 * e.bootstrap_error,
                1.0 * e.bootstrap_error);
    for (const FitResult& result : results) {
      EXPECT_EQ(result.estimates[i].bootstrap_error, e.bootstrap_error);
      EXPECT_EQ(result.estimates[i].bootstrap_low, e.bootstrap_low);
    }
  }
  std::printf("bootstrap over standard error: within %.0f %%\n", 100.0 * std::expm1(worst));
  EXPECT_LT(worst, 0.5);
  settings.bootstrap = 20;
  settings.seed = 2;
  EXPECT_NE(fit(truth.cutter, records, settings).estimates[0].bootstrap_error,
            results[0].estimates[0].bootstrap_error);
}

TEST(Fit, EndsAtTheLinearLeastSquaresOfTheCoefficients) {
  // What variable projection would end at: K by linear least squares at the phases, speeds and
  // runouts that were found.
  const Truth truth = half_immersion();
  std::vector<Record> records = three_feeds(truth);
  for (std::size_t r = 0; r < 3; ++r) add_noise(records[r].trace, 5.0, 0.8, r);
  FitSettings settings;
  settings.offset = Estimated::no;
  settings.tolerance = 1e-13;
  for (Record& record : records) {
    for (auto& force : record.trace.force) force.resize(600);
  }
  const FitResult result = fit(truth.cutter, records, settings);
  std::array<std::array<double, 7>, 6> normal{};
  for (std::size_t r = 0; r < records.size(); ++r) {
    cutter::Cutter cutter = truth.cutter;
    cutter.runout = result.records[r].runout;
    force::ForceSensitivity kernel(cutter, truth.engagement, {});
    for (std::size_t i = 0; i < records[r].trace.size(); ++i) {
      const double angle = result.records[r].phase + result.records[r].spindle_speed *
                                                         static_cast<double>(i) /
                                                         records[r].trace.sampling_rate;
      const auto at = kernel.at(angle, result.records[r].feed_per_tooth, {});
      for (int axis = 0; axis < 3; ++axis) {
        for (int a = 0; a < 6; ++a) {
          for (int b = 0; b < 6; ++b) {
            normal[a][b] += at.coefficient[a][axis] * at.coefficient[b][axis];
          }
          normal[a][6] += at.coefficient[a][axis] * records[r].trace.force[axis][i];
        }
      }
    }
  }
  for (int a = 0; a < 6; ++a) {  // Gauss and Jordan; the matrix is positive definite
    const double pivot = normal[a][a];
    for (double& x : normal[a]) x /= pivot;
    for (int b = 0; b < 6; ++b) {
      if (b == a) continue;
      const double times = normal[b][a];
      for (int c = 0; c < 7; ++c) normal[b][c] -= times * normal[a][c];
    }
  }
  for (int a = 0; a < 6; ++a) {
    EXPECT_NEAR(normal[a][6] / values(result.coefficients)[a], 1.0, 1e-5);
  }
}

TEST(Fit, HoldsAgainstSpikes) {
  const Truth truth = half_immersion();
  std::vector<Record> records = three_feeds(truth);
  for (std::size_t r = 0; r < 3; ++r) {
    add_noise(records[r].trace, 2.0, 0.5, r);
    for (std::size_t i = 40; i < records[r].trace.size(); i += 97) {
      records[r].trace.force[i % 3][i] += 900.0;
    }
  }
  const FitResult plain = fit(truth.cutter, records, {});
  FitSettings settings;
  settings.loss = Loss::cauchy;
  settings.loss_scale = 6.0;
  const FitResult robust = fit(truth.cutter, records, settings);
  EXPECT_LT(off(robust.coefficients, truth.coefficients), 0.02);
  EXPECT_GT(off(plain.coefficients, truth.coefficients),
            5.0 * off(robust.coefficients, truth.coefficients));
}

TEST(Fit, KeepsWhatIsKnown) {
  const Truth truth = half_immersion();
  std::vector<Record> records = three_feeds(truth);
  for (std::size_t r = 0; r < 3; ++r) add_noise(records[r].trace, 20.0, 0.8, r);
  FitSettings settings;
  settings.known[5].fixed = 6.7;
  settings.known[4].mean = 7.8;
  settings.known[4].deviation = 1e-3;
  const FitResult result = fit(truth.cutter, records, settings);
  EXPECT_EQ(result.coefficients.Kae, 6.7);
  EXPECT_NEAR(result.coefficients.Kre, 7.8, 5e-3);
  EXPECT_EQ(result.estimates[4].name, "Kre");
  EXPECT_LT(result.estimates[4].standard_error, 2e-3);
}

TEST(Fit, SaysWhatOneFeedAndNoZCannotTell) {
  Truth truth = slot_truth();
  Record record = make_record(truth, "alone");
  record.trace.force[2].clear();
  const FitResult result = fit(truth.cutter, {record}, {});
  const auto says = [&](const char* words) {
    return std::any_of(result.warnings.begin(), result.warnings.end(),
                       [&](const std::string& w) { return w.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("one feed"));
  EXPECT_TRUE(says("measure the z force too"));
}

TEST(Fit, RefusesRecordsThatSayNothing) {
  const Truth truth = slot_truth();
  EXPECT_THROW(fit(truth.cutter, {}, {}), core::InputError);
  Record record = make_record(truth, "short");
  for (auto& force : record.trace.force) force.resize(50);
  EXPECT_THROW(fit(truth.cutter, {record}, {}), core::InputError);
  record = make_record(truth, "no axis");
  FitSettings settings;
  settings.axes = {false, false, false};
  EXPECT_THROW(fit(truth.cutter, {record}, settings), core::InputError);
}

}  // namespace
}  // namespace millstudy::identify
