// SPDX-License-Identifier: MIT
#include "identify/average_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "force/revolution_mean.h"
#include "identify/student.h"

namespace millstudy::identify {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, 6> kNames = {"Ktc", "Krc", "Kac", "Kte", "Kre", "Kae"};
constexpr std::array<const char*, 6> kUnits = {"N/mm2", "N/mm2", "N/mm2", "N/mm", "N/mm", "N/mm"};

/// Mean of each axis over as many whole revolutions as the record has, from its first sample.
RecordAverage mean_of(const Record& record) {
  const double per_turn =
      core::kTurn / record.spindle_speed * record.trace.sampling_rate;  // samples
  const double turns = std::floor(static_cast<double>(record.trace.size()) / per_turn);
  if (turns < 1.0) {
    throw core::InputError(
        fmt::format("{}: {} samples are less than one revolution of the spindle ({:.0f})",
                    record.name, record.trace.size(), per_turn));
  }
  const auto count = static_cast<std::size_t>(turns * per_turn);
  RecordAverage out{turns, {kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}};
  for (int axis = 0; axis < 3; ++axis) {
    if (!record.trace.has_axis(axis)) continue;
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += record.trace.force[axis][i];
    out.mean[axis] = sum / static_cast<double>(count);
  }
  return out;
}

/// The pair of coefficients that the regression tells apart least.
std::string weakest_pair(const Eigen::VectorXd& direction) {
  std::array<int, 6> order = {0, 1, 2, 3, 4, 5};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::abs(direction[a]) > std::abs(direction[b]); });
  return fmt::format("{} and {}", kNames[order[0]], kNames[order[1]]);
}

}  // namespace

AverageFit average_fit(const cutter::Cutter& cutter, const std::vector<Record>& records) {
  AverageFit fit;
  std::vector<Eigen::Matrix<double, 1, 6>> rows;
  std::vector<double> means;
  std::vector<int> axes;
  std::array<bool, 3> measured{};
  for (const Record& record : records) {
    check(record.trace);
    fit.records.push_back(mean_of(record));
    const force::ForceBasis basis = force::revolution_mean(cutter, record.engagement);
    const double feed = record.feed_rate * core::kTurn / (record.spindle_speed * cutter.flutes);
    for (int axis = 0; axis < 3; ++axis) {
      if (!record.trace.has_axis(axis)) continue;
      measured[axis] = true;
      Eigen::Matrix<double, 1, 6> row;
      for (int c = 0; c < 3; ++c) {
        row[c] = feed * basis.chip[axis][c];
        row[3 + c] = basis.edge[axis][c];
      }
      rows.push_back(row);
      means.push_back(fit.records.back().mean[axis]);
      axes.push_back(axis);
    }
  }
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd a(count, 6);
  Eigen::VectorXd b(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    a.row(i) = rows[static_cast<std::size_t>(i)];
    b[i] = means[static_cast<std::size_t>(i)];
  }
  // Columns at unit length, so that a condition number means something.
  Eigen::VectorXd scale = count > 0 ? Eigen::VectorXd(a.colwise().norm()) : Eigen::VectorXd();
  const char* more = "measure at least two feeds along x, y and z";
  if (count < 6 || scale.minCoeff() <= 1e-12 * scale.maxCoeff()) {
    throw core::InputError(fmt::format(
        "{} mean forces do not hold six coefficients{}: {}", count,
        measured[2] ? "" : " (no record has z, which alone shows Kac and Kae on a flat end mill)",
        more));
  }
  a *= scale.cwiseInverse().asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  fit.condition_number = svd.singularValues()[0] / svd.singularValues()[5];
  if (!(fit.condition_number < 1e8)) {
    throw core::InputError(fmt::format("the mean forces cannot tell {} apart: {}",
                                       weakest_pair(svd.matrixV().col(5)), more));
  }
  if (fit.condition_number > 50.0) {
    fit.warnings.push_back(fmt::format(
        "the mean forces hardly tell {} apart (condition number {:.0f}): {}, further from each "
        "other",
        weakest_pair(svd.matrixV().col(5)), fit.condition_number, more));
  }
  const Eigen::VectorXd scaled = svd.solve(b);
  const Eigen::VectorXd k = scaled.cwiseQuotient(scale);
  fit.coefficients = {k[0], k[1], k[2], k[3], k[4], k[5]};
  const Eigen::VectorXd predicted = a * scaled;

  // Each axis scatters about its line in its own way.
  std::array<double, 3> variance{};
  const double freedom = static_cast<double>(records.size()) - 2.0;
  for (int axis = 0; axis < 3; ++axis) {
    double mean = 0.0, squares = 0.0, total = 0.0, n = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) {
      if (axes[static_cast<std::size_t>(i)] == axis) mean += b[i], n += 1.0;
    }
    mean /= std::max(1.0, n);
    for (Eigen::Index i = 0; i < count; ++i) {
      if (axes[static_cast<std::size_t>(i)] != axis) continue;
      squares += (b[i] - predicted[i]) * (b[i] - predicted[i]);
      total += (b[i] - mean) * (b[i] - mean);
    }
    fit.r_squared[axis] = total > 0.0 ? 1.0 - squares / total : kUnknown;
    variance[axis] = freedom > 0.0 ? squares / freedom : kUnknown;
  }
  Eigen::VectorXd scatter(count);
  for (Eigen::Index i = 0; i < count; ++i) scatter[i] = variance[axes[static_cast<std::size_t>(i)]];
  const Eigen::MatrixXd inverse =
      svd.matrixV() * svd.singularValues().cwiseInverse().asDiagonal() * svd.matrixU().transpose();
  const Eigen::MatrixXd unscaled = scale.cwiseInverse().asDiagonal() * inverse;
  const Eigen::MatrixXd covariance = unscaled * scatter.asDiagonal() * unscaled.transpose();
  for (int i = 0; i < 6; ++i) {
    Estimate e;
    e.name = kNames[i];
    e.unit = kUnits[i];
    e.value = k[i];
    e.standard_error = std::sqrt(covariance(i, i));
    const double half = freedom >= 1.0 ? student_975(freedom) * e.standard_error : kUnknown;
    e.confidence_low = e.value - half;
    e.confidence_high = e.value + half;
    fit.estimates.push_back(std::move(e));
    for (int j = 0; j < 6; ++j) {
      fit.covariance.push_back(covariance(i, j));
      fit.correlation.push_back(covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j)));
    }
  }
  if (!(freedom > 0.0)) {
    fit.warnings.push_back(
        "two records leave nothing to judge the scatter by: no errors are "
        "given; measure three feeds or more");
  }
  std::size_t next = 0;
  for (std::size_t r = 0; r < records.size(); ++r) {
    for (int axis = 0; axis < 3; ++axis) {
      if (records[r].trace.has_axis(axis)) {
        fit.records[r].predicted[axis] = predicted[static_cast<Eigen::Index>(next++)];
      }
    }
  }
  return fit;
}

}  // namespace millstudy::identify
