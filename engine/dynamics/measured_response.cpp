// SPDX-License-Identifier: MIT
#include "dynamics/measured_response.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::dynamics {
namespace {

constexpr std::size_t kMostFaults = 20;
/// No tool that cuts metal is softer at its resonance, none stiffer [mm/N].
constexpr double kSoftest = 1.0, kStiffest = 1e-10;

double hertz(double omega) {
  return omega / core::kTurn;
}

/// Frequencies in order, without gaps.
void check_frequencies(const std::vector<double>& omega, std::vector<ResponseFault>& faults) {
  for (std::size_t i = 1; i < omega.size(); ++i) {
    if (omega[i] > omega[i - 1]) continue;
    faults.push_back({i, fmt::format("frequencies must ascend: {:.7g} Hz comes after {:.7g} Hz",
                                     hertz(omega[i]), hertz(omega[i - 1]))});
  }
  if (!faults.empty()) return;
  for (std::size_t i = 1; i < omega.size(); ++i) {
    const double gap = omega[i] - omega[i - 1];
    const double before = i > 1 ? omega[i - 1] - omega[i - 2] : 0.0;
    const double after = i + 1 < omega.size() ? omega[i + 1] - omega[i] : 0.0;
    if (gap <= 10.0 * std::max(before, after)) continue;
    faults.push_back({i, fmt::format("there is a gap between {:.7g} Hz and {:.7g} Hz",
                                     hertz(omega[i - 1]), hertz(omega[i]))});
  }
}

/// Size and sign of the largest amplitude.
void check_peak(const MeasuredResponse& measured, std::vector<ResponseFault>& faults) {
  const auto peak =
      std::max_element(measured.compliance.begin(), measured.compliance.end(),
                       [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); });
  const auto at = static_cast<std::size_t>(peak - measured.compliance.begin());
  const double size = std::abs(*peak);
  const auto fault = [&](const std::string& text) {
    faults.push_back({at, fmt::format("its largest amplitude, {:.3g} m/N at {:.7g} Hz, {}",
                                      1e-3 * size, hertz(measured.omega[at]), text)});
  };
  if (size > kSoftest) {
    fault("is softer than any tool: is it in mm/N or um/N, or not displacement over force?");
  } else if (size < kStiffest) {
    fault("is stiffer than any tool: check the unit");
  } else if (peak->imag() > 0.5 * size) {
    fault(
        "has a positive imaginary part: it must be displacement over force at the same place, not "
        "acceleration, and lag behind");
  }
}

}  // namespace

std::complex<double> MeasuredResponse::at(double frequency) const {
  if (frequency <= omega.front()) return compliance.front();
  if (frequency >= omega.back()) {
    const double ratio = omega.back() / frequency;
    return ratio * ratio * compliance.back();
  }
  const auto above = std::upper_bound(omega.begin(), omega.end(), frequency);
  const auto i = static_cast<std::size_t>(above - omega.begin()) - 1;
  const double share = (frequency - omega[i]) / (omega[i + 1] - omega[i]);
  return (1.0 - share) * compliance[i] + share * compliance[i + 1];
}

std::vector<ResponseFault> faults(const MeasuredResponse& measured) {
  std::vector<ResponseFault> faults;
  if (measured.omega.size() != measured.compliance.size() || measured.omega.size() < 3) {
    faults.push_back({0, fmt::format("a frequency response must have as many values as "
                                     "frequencies, and three at least, not {} and {}",
                                     measured.compliance.size(), measured.omega.size())});
    return faults;
  }
  for (std::size_t i = 0; i < measured.omega.size(); ++i) {
    const std::complex<double> value = measured.compliance[i];
    if (std::isfinite(measured.omega[i]) && measured.omega[i] >= 0.0 &&
        std::isfinite(value.real()) && std::isfinite(value.imag())) {
      continue;
    }
    faults.push_back(
        {i, fmt::format("{:.7g} Hz, {:.7g}, {:.7g}: all must be finite and the "
                        "frequency >= 0",
                        hertz(measured.omega[i]), 1e-3 * value.real(), 1e-3 * value.imag())});
  }
  if (faults.empty()) check_frequencies(measured.omega, faults);
  if (faults.empty()) check_peak(measured, faults);
  if (faults.size() > kMostFaults) faults.resize(kMostFaults);
  return faults;
}

void check(const MeasuredResponse& measured) {
  const std::vector<ResponseFault> found = faults(measured);
  if (!found.empty()) throw core::InputError(found.front().text);
}

}  // namespace millstudy::dynamics
