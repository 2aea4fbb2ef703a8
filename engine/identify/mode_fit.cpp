// SPDX-License-Identifier: MIT
#include "identify/mode_fit.h"

#include <algorithm>
#include <ceres/ceres.h>
#include <cmath>
#include <complex>
#include <fmt/core.h>
#include <numeric>

#include "core/error.h"

namespace millstudy::identify {
namespace {

using Complex = std::complex<double>;
using dynamics::MeasuredResponse;

constexpr std::size_t kMostPoints = 8192;  // the fit takes every so manieth beyond
constexpr double kLeastGain = 0.9;         // of a further mode on what is left
constexpr double kNothingLeft = 1e-9;
constexpr double kLeastDamping = 1e-5, kMostDamping = 0.7;
constexpr double kSoftest = 1e3;     // [mm/N]
constexpr double kGoodEnough = 0.1;  // left over: below, one mode that does not help ends the fit

/// A mode as the fit has it: logarithms of frequency [rad/s], damping ratio and static compliance
/// [mm/N], so that all stay positive and steps are relative.
struct Parameters {
  double frequency;
  double damping;
  double compliance;
};
constexpr int kPerMode = 3;

/// (D2) of one mode and its derivatives by the three.
struct Response {
  Complex value, by_frequency, by_damping;  // by_compliance is the value
};
class OneMode {
 public:
  explicit OneMode(const Parameters& mode)
      : w_(std::exp(mode.frequency)),
        twice_damping_(2.0 * std::exp(mode.damping) * w_),
        strength_(std::exp(mode.compliance) * w_ * w_) {}

  Response at(double omega) const {
    const double real = w_ * w_ - omega * omega, imaginary = twice_damping_ * omega;
    const double scale = 1.0 / (real * real + imaginary * imaginary);
    const Complex inverse(real * scale, -imaginary * scale);
    const Complex value = strength_ * inverse;
    const auto times_inverse = [&](double r, double i) {  // without the checks for infinities
      return Complex(r * inverse.real() - i * inverse.imag(),
                     r * inverse.imag() + i * inverse.real());
    };
    const Complex a = times_inverse(2.0 * w_ * w_, imaginary), b = times_inverse(0.0, imaginary);
    return {value, times_inverse(strength_ * (2.0 - a.real()), -strength_ * a.imag()),
            times_inverse(-strength_ * b.real(), -strength_ * b.imag())};
  }

 private:
  double w_, twice_damping_, strength_;
};

MeasuredResponse thinned(const MeasuredResponse& all) {
  const std::size_t every = 1 + (all.omega.size() - 1) / kMostPoints;
  MeasuredResponse some;
  for (std::size_t i = 0; i < all.omega.size(); i += every) {
    some.omega.push_back(all.omega[i]);
    some.compliance.push_back(all.compliance[i]);
  }
  return some;
}

/// Differences of a sum of modes from the response, real and imaginary parts one after another,
/// over the root of the sum of squares of the response.
class Differences : public ceres::CostFunction {
 public:
  Differences(const MeasuredResponse& measured, std::size_t modes) : measured_(measured) {
    double square = 0.0;
    for (const Complex& value : measured.compliance) square += std::norm(value);
    scale_ = 1.0 / std::sqrt(square);
    set_num_residuals(static_cast<int>(2 * measured.omega.size()));
    for (std::size_t i = 0; i < modes; ++i) mutable_parameter_block_sizes()->push_back(kPerMode);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const std::size_t count = measured_.omega.size();
    for (std::size_t i = 0; i < count; ++i) {
      residuals[2 * i] = -scale_ * measured_.compliance[i].real();
      residuals[2 * i + 1] = -scale_ * measured_.compliance[i].imag();
    }
    for (std::size_t m = 0; m < parameter_block_sizes().size(); ++m) {
      const OneMode mode({parameters[m][0], parameters[m][1], parameters[m][2]});
      double* row = jacobians ? jacobians[m] : nullptr;
      for (std::size_t i = 0; i < count; ++i) {
        const Response r = mode.at(measured_.omega[i]);
        residuals[2 * i] += scale_ * r.value.real();
        residuals[2 * i + 1] += scale_ * r.value.imag();
        if (!row) continue;
        for (const Complex& slope : {r.by_frequency, r.by_damping, r.value}) {
          row[0] = scale_ * slope.real();
          row[kPerMode] = scale_ * slope.imag();
          ++row;
        }
        row += kPerMode;
      }
    }
    return true;
  }

 private:
  const MeasuredResponse& measured_;
  double scale_;
};

/// Modes that were fitted, and the relative difference that they leave.
struct Candidate {
  std::vector<Parameters> modes;
  double left = 1.0;
};

Candidate solved(const MeasuredResponse& measured, std::vector<Parameters> modes) {
  ceres::Problem problem;
  std::vector<double*> blocks;
  blocks.reserve(modes.size());
  for (Parameters& mode : modes) blocks.push_back(&mode.frequency);
  problem.AddResidualBlock(new Differences(measured, modes.size()), nullptr, blocks);
  const double first = std::max(measured.omega.front(), 1e-3 * measured.omega.back());
  for (double* block : blocks) {
    problem.SetParameterLowerBound(block, 0, std::log(0.3 * first));
    problem.SetParameterUpperBound(block, 0, std::log(3.0 * measured.omega.back()));
    problem.SetParameterLowerBound(block, 1, std::log(kLeastDamping));
    problem.SetParameterUpperBound(block, 1, std::log(kMostDamping));
    problem.SetParameterUpperBound(block, 2, std::log(kSoftest));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 100;
  options.function_tolerance = 1e-12;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {std::move(modes), std::sqrt(2.0 * std::max(summary.final_cost, 0.0))};
}

/// What modes leave of the response.
std::vector<Complex> left_over(const MeasuredResponse& measured,
                               const std::vector<Parameters>& modes) {
  std::vector<Complex> left = measured.compliance;
  for (const Parameters& parameters : modes) {
    const OneMode mode(parameters);
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= mode.at(measured.omega[i]).value;
  }
  return left;
}

/// A mode at the largest of what is left: its damping by the width at half power.
Parameters at_peak(const std::vector<double>& omega, const std::vector<Complex>& left) {
  const auto peak = std::max_element(
      left.begin(), left.end(),
      [](const Complex& a, const Complex& b) { return std::norm(a) < std::norm(b); });
  const auto at = static_cast<std::size_t>(peak - left.begin());
  const double half = 0.5 * std::norm(*peak);
  std::size_t low = at, high = at;
  while (low > 0 && std::norm(left[low]) > half) --low;
  while (high + 1 < left.size() && std::norm(left[high]) > half) ++high;
  const double w = std::max(omega[at], 1e-3 * omega.back());
  const double zeta = std::clamp(0.5 * (omega[high] - omega[low]) / w, kLeastDamping, 0.3);
  return {std::log(w), std::log(zeta), std::log(2.0 * zeta * std::abs(*peak))};
}

/// A mode above all that was measured, of the mean of what is left.
Parameters beyond(const std::vector<double>& omega, const std::vector<Complex>& left) {
  const Complex sum = std::accumulate(left.begin(), left.end(), Complex());
  const double mean = std::abs(sum.real()) / static_cast<double>(left.size());
  return {std::log(1.5 * omega.back()), std::log(0.05), std::log(std::max(mean, 1e-15))};
}

}  // namespace

ModeFit fit_modes(const MeasuredResponse& all, int most) {
  dynamics::check(all);
  if (most < 1 || most > 8) {
    throw core::InputError(fmt::format("most = {} modes must be between 1 and 8", most));
  }
  const MeasuredResponse measured = thinned(all);
  Candidate best, last;
  int in_vain = 0;
  while (last.modes.size() < static_cast<std::size_t>(most) && best.left > kNothingLeft) {
    const std::vector<Complex> left = left_over(measured, last.modes);
    Candidate next;
    for (const Parameters& start : {at_peak(measured.omega, left), beyond(measured.omega, left)}) {
      std::vector<Parameters> modes = last.modes;
      modes.push_back(start);
      Candidate found = solved(measured, std::move(modes));
      if (next.modes.empty() || found.left < next.left) next = std::move(found);
    }
    last = std::move(next);
    if (last.left < kLeastGain * best.left) {
      best = last;
      in_vain = 0;
    } else if (best.left < kGoodEnough || ++in_vain == 2) {
      break;
    }
  }
  ModeFit fit;
  fit.unexplained = best.left;
  std::sort(best.modes.begin(), best.modes.end(),
            [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  for (const Parameters& mode : best.modes) {
    fit.modes.push_back(
        {{std::exp(mode.frequency), std::exp(mode.damping)}, 0.0, std::exp(-mode.compliance)});
  }
  return fit;
}

}  // namespace millstudy::identify
