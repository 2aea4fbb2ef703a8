// SPDX-License-Identifier: MIT
#include "dynamics/zeroth_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <fmt/core.h>
#include <limits>

#include "core/error.h"
#include "core/units.h"
#include "dynamics/state_space.h"

namespace millstudy::dynamics {
namespace {

using Complex = std::complex<double>;

/// (D21): eigenvalues of -((1 - exp(-i omega tau)) A + i omega B) G: the loop is closed at the gain
/// 1/value of one that is real and positive.
std::array<Complex, 2> loop_values(const FrequencyDomain& machine, const Eigen::Matrix2d& mean,
                                   const Eigen::Matrix2d& damping, double delay, double omega) {
  const Complex regeneration = 1.0 - std::polar(1.0, -omega * delay);
  const Eigen::Matrix2cd gain = regeneration * mean + Complex(0.0, omega) * damping;
  const Eigen::Matrix2cd loop = -gain * machine.response(omega);
  const Complex half = 0.5 * (loop(0, 0) + loop(1, 1));
  const Complex determinant = loop(0, 0) * loop(1, 1) - loop(0, 1) * loop(1, 0);
  const Complex root = std::sqrt(half * half - determinant);
  return {half + root, half - root};
}

/// The same two in the order in which they are nearest to others.
std::array<Complex, 2> in_order(std::array<Complex, 2> values, const std::array<Complex, 2>& near) {
  const double kept = std::norm(values[0] - near[0]) + std::norm(values[1] - near[1]);
  const double swapped = std::norm(values[1] - near[0]) + std::norm(values[0] - near[1]);
  if (swapped < kept) std::swap(values[0], values[1]);
  return values;
}

}  // namespace

FrequencyDomain frequency_domain(const Machine& machine, const MeasuredAxes& measured) {
  const bool any_mode = !machine.x.empty() || !machine.y.empty() || !machine.coupled.empty();
  if (any_mode || (!measured.x && !measured.y)) check(machine);
  FrequencyDomain domain;
  domain.response = [machine, measured](double omega) {
    Eigen::Matrix2cd response = frequency_response(machine, omega);
    if (measured.x) response(0, 0) += measured.x->at(omega);
    if (measured.y) response(1, 1) += measured.y->at(omega);
    return response;
  };
  double highest = 0.0;
  const auto add = [&](const Mode& mode) {
    const double w = mode.natural_frequency;
    const double width = std::max(mode.damping_ratio, 1e-5) * w;
    highest = std::max(highest, w);
    domain.omega.push_back(w);
    for (double offset = 0.1 * width; offset < 1.5 * w; offset *= 1.1) {
      if (offset < w) domain.omega.push_back(w - offset);
      domain.omega.push_back(w + offset);
    }
  };
  for (const AxisMode& m : machine.x) add(m.mode);
  for (const AxisMode& m : machine.y) add(m.mode);
  for (const ResidueMode& m : machine.coupled) add(m.mode);
  for (const auto& axis : {measured.x, measured.y}) {
    if (!axis) continue;
    check(*axis);
    highest = std::max(highest, axis->omega.back());
    domain.omega.insert(domain.omega.end(), axis->omega.begin(), axis->omega.end());
  }
  // Stiff cuts chatter well above the modes.
  if (!any_mode) highest = 0.0;  // nothing is known beyond what was measured
  for (double omega = highest; omega < 20.0 * highest; omega *= 1.02) domain.omega.push_back(omega);
  std::sort(domain.omega.begin(), domain.omega.end());
  return domain;
}

ZerothOrder zeroth_order_gain(const FrequencyDomain& machine, const Eigen::Matrix2d& mean_stiffness,
                              double delay, const Eigen::Matrix2d& mean_damping) {
  if (!(delay > 0.0 && std::isfinite(delay))) {
    throw core::InputError(fmt::format("delay = {} s must be > 0 and finite", delay));
  }
  const auto values = [&](double omega) {
    return loop_values(machine, mean_stiffness, mean_damping, delay, omega);
  };
  const double longest = core::kTurn / delay / 32.0;
  double largest = 0.0, at = 0.0;
  double low = machine.omega.front();
  std::array<Complex, 2> at_low = values(low);
  for (std::size_t i = 1; i < machine.omega.size(); ++i) {
    const double end = machine.omega[i];
    const int parts = 1 + static_cast<int>((end - low) / longest);
    const double begin = low;
    for (int part = 1; part <= parts; ++part) {
      const double high = part == parts ? end : begin + (end - begin) * part / parts;
      const std::array<Complex, 2> at_high = in_order(values(high), at_low);
      for (int k = 0; k < 2; ++k) {
        const bool crosses = (at_low[k].imag() < 0.0) != (at_high[k].imag() < 0.0);
        if (!crosses || std::max(at_low[k].real(), at_high[k].real()) <= largest) continue;
        double a = low, b = high;
        Complex value_a = at_low[k], value = at_high[k];
        for (int step = 0; step < 50; ++step) {
          const double middle = 0.5 * (a + b);
          value = in_order(values(middle), at_low)[k];
          const bool same = (value.imag() < 0.0) == (value_a.imag() < 0.0);
          (same ? a : b) = middle;
        }
        if (value.real() > largest) {
          largest = value.real();
          at = 0.5 * (a + b);
        }
      }
      low = high;
      at_low = at_high;
    }
  }
  if (largest <= 0.0) return {std::numeric_limits<double>::infinity(), 0.0};
  return {1.0 / largest, at};
}

ZerothOrderLimit zeroth_order_limit(const FrequencyDomain& machine, const cutter::Cutter& cutter,
                                    const force::Arc& arc, const force::Coefficients& coefficients,
                                    double spindle_speed, double largest_depth,
                                    const force::Variation& variation, double process_damping) {
  if (!(spindle_speed > 0.0 && std::isfinite(spindle_speed))) {
    throw core::InputError(
        fmt::format("spindle speed = {} rad/s must be > 0 and finite", spindle_speed));
  }
  cutter::check(cutter);
  if (!cutter::has_equal_flutes(cutter)) {
    throw core::InputError("the zeroth-order solution is of equal flutes: use another method");
  }
  const auto at = [&](double depth) {
    const RegenerativeCut cut(cutter, {arc.entry_angle, arc.exit_angle, depth}, coefficients,
                              variation);
    const double per_speed = process_damping / (spindle_speed * cutter::radius(cutter));
    return zeroth_order_gain(machine, cut.mean_stiffness(), cut.period_angle() / spindle_speed,
                             cut.process_damping(per_speed).mean_stiffness());
  };
  const bool linear = cutter.shape == cutter::Shape::flat && !variation.with_height();
  ZerothOrder found = at(largest_depth);
  if (linear) {
    if (found.gain >= 1.0) return {largest_depth, 0.0};
    return {found.gain * largest_depth, found.chatter_frequency};
  }
  if (found.gain >= 1.0) return {largest_depth, 0.0};
  double low = 0.0, high = largest_depth;
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    const ZerothOrder there = at(middle);
    if (there.gain >= 1.0) {
      low = middle;
    } else {
      high = middle;
      found = there;
    }
  }
  return {0.5 * (low + high), found.chatter_frequency};
}

}  // namespace millstudy::dynamics
