// SPDX-License-Identifier: MIT
// Usage: fit_coverage [REPEATS]. Fits records of known coefficients under many draws of coloured
// noise, and counts how often the 95 % intervals hold the truth and how far the mean is off.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <tbb/parallel_for.h>

#include "unit/identify/synthetic_record.h"

namespace {

using namespace millstudy;
using namespace millstudy::identify;

constexpr std::array<const char*, 6> kNames = {"Ktc", "Krc", "Kac", "Kte", "Kre", "Kae"};

/// Three feeds with a phase, a speed, a runout and offsets of their own.
std::vector<Record> clean_records(testing::Truth& truth) {
  truth = testing::slot_truth();
  truth.engagement = {0.0, 0.5 * core::kPi, 2.0};
  truth.sampling_rate = 1000.0;
  truth.samples = 1600;  // 20 revolutions
  std::vector<Record> records;
  for (int i = 0; i < 3; ++i) {
    truth.feed_rate = 4.0 + 4.0 * i;
    truth.phase += 1.7;
    truth.offset = {1.0 + i, -2.0, 0.5 * i};
    records.push_back(testing::make_record(truth, "feed " + std::to_string(i)));
  }
  return records;
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 2000;
  constexpr double kDeviation = 10.0;   // [N], forces are up to 300
  constexpr double kCorrelation = 0.9;  // of neighbours, as residuals of real records have
  testing::Truth truth;
  const std::vector<Record> clean = clean_records(truth);
  const std::array<double, 6> k = testing::values(truth.coefficients);
  std::vector<std::array<double, 6>> errors(repeats), deviations(repeats);
  std::vector<std::array<bool, 6>> held(repeats);
  tbb::parallel_for(0, repeats, [&](int n) {
    std::vector<Record> records = clean;
    for (std::size_t r = 0; r < records.size(); ++r) {
      add_noise(records[r].trace, kDeviation, kCorrelation, 10 * static_cast<std::uint64_t>(n) + r);
    }
    const FitResult result = fit(truth.cutter, records, {});
    for (int i = 0; i < 6; ++i) {
      const Estimate& e = result.estimates[i];
      errors[n][i] = e.value - k[i];
      deviations[n][i] = e.standard_error;
      held[n][i] = e.confidence_low <= k[i] && k[i] <= e.confidence_high;
    }
  });
  // 2000 draws tell a coverage to +-0.5 % (one standard deviation), fewer less.
  const double slack =
      2.0 * std::sqrt(0.05 * 0.95) * (1.0 / std::sqrt(repeats) - 1.0 / std::sqrt(2000.0));
  bool good = true;
  for (int i = 0; i < 6; ++i) {
    double coverage = 0.0, mean = 0.0, variance = 0.0, deviation = 0.0;
    for (int n = 0; n < repeats; ++n) {
      coverage += held[n][i] ? 1.0 / repeats : 0.0;
      mean += errors[n][i] / repeats;
      variance += errors[n][i] * errors[n][i] / repeats;
      deviation += deviations[n][i] / repeats;
    }
    const double bias = std::abs(mean) / std::sqrt(variance);
    std::printf("%s: held %.2f %%, mean error %.3f standard errors, spread %.4g, said %.4g\n",
                kNames[i], 100.0 * coverage, bias, std::sqrt(variance), deviation);
    good = good && coverage >= 0.93 - slack && coverage <= 0.97 + slack && bias < 0.2 + slack;
  }
  std::printf("%s\n", good ? "good" : "FAILED");
  return good ? 0 : 1;
}
