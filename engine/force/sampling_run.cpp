// SPDX-License-Identifier: MIT
#include "force/sampling_run.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/units.h"
#include "force/lanes.h"
#include "force/tooth_integral.h"

namespace millstudy::force {

AngleTables::AngleTables(int angular_steps, int tooth_count)
    : teeth(tooth_count),
      period(angular_steps / std::gcd(angular_steps, tooth_count)),
      step(core::kTurn / angular_steps),
      steps_per_rad(angular_steps / core::kTurn),
      circle(UnitCircle::of(angular_steps, period + kLanes)),
      cos1(circle->cosine.data()),
      sin1(circle->sine.data()) {
  const int padded = period + kLanes;
  for (std::vector<double>* table : {&cos2, &sin2}) table->reserve(padded);
  for (int n = 0; n < padded; ++n) {
    cos2.push_back((cos1[n] - sin1[n]) * (cos1[n] + sin1[n]));
    sin2.push_back(2.0 * sin1[n] * cos1[n]);
  }
  for (int q = 0; q < teeth; ++q) {
    cos_pitch.push_back(std::cos(core::kTurn * q / teeth));
    sin_pitch.push_back(std::sin(core::kTurn * q / teeth));
  }
}

SamplingRun::SamplingRun(const AngleTables& tables, const Angle& direction, IndexRange indices,
                         std::array<double*, kRows> rows)
    : tables_(tables),
      direction_(direction),
      per_pitch_(0.5 * tables.teeth / core::kPi),
      indices_(indices),
      rows_(rows) {}

Pass SamplingRun::pass(std::int64_t q) const {
  const std::int64_t left = q % tables_.teeth;
  const std::size_t at = left < 0 ? left + tables_.teeth : left;
  const double c = tables_.cos_pitch[at];
  const double s = tables_.sin_pitch[at];
  return {zero_ + core::kTurn * static_cast<double>(q) / tables_.teeth,
          zero_cosine_ * c - zero_sine_ * s, zero_sine_ * c + zero_cosine_ * s};
}

IndexRange SamplingRun::between(const Pass& pass, double from, double to, Closed closed) const {
  const double scale = tables_.steps_per_rad;
  const double snap = kAngleSnap * scale;
  const auto first_after = [&](double angle) {
    const double at = (angle - pass.offset) * scale;
    const double index = closed == Closed::above ? std::floor(at + snap) + 1.0  // angle excluded
                                                 : std::ceil(at - snap);        // angle included
    return static_cast<int>(std::clamp<double>(index, indices_.first, indices_.last));
  };
  return {first_after(from), first_after(to)};
}

void SamplingRun::put_zeros(IndexRange indices) {
  const int count = indices.last - indices.first;
  for (double* row : rows_) std::fill_n(row + (indices.first - indices_.first), count, 0.0);
}

void SamplingRun::finish() {
  if (!written_) put_zeros(indices_);
}

void SamplingRun::add(const Pass& pass, IndexRange indices, const Harmonics& force) {
  if (indices.first >= indices.last) return;
  const Harmonics p = shifted(force, pass.cosine, pass.sine);
  accumulate(indices, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
    const Lanes c1 = load(&tables_.cos1[n]);
    const Lanes s1 = load(&tables_.sin1[n]);
    const Lanes c2 = load(&tables_.cos2[n]);
    const Lanes s2 = load(&tables_.sin2[n]);
    x = p.constant[0] + p.cos1[0] * c1 + p.sin1[0] * s1 + p.cos2[0] * c2 + p.sin2[0] * s2;
    y = p.constant[1] + p.cos1[1] * c1 + p.sin1[1] * s1 + p.cos2[1] * c2 + p.sin2[1] * s2;
    z = p.constant[2] + p.cos1[2] * c1 + p.sin1[2] * s1;
    torque = p.constant[3] + p.cos1[3] * c1 + p.sin1[3] * s1;
  });
}

void SamplingRun::add(const Pass& pass, IndexRange indices, const Harmonics& force,
                      const Row& slope, double origin) {
  if (indices.first >= indices.last) return;
  const Harmonics p = shifted(force, pass.cosine, pass.sine);
  const double from = pass.offset - origin;
  accumulate(indices, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
    const Lanes d = from + tables_.step * (static_cast<double>(n) + kLaneIndex);
    const Lanes c1 = load(&tables_.cos1[n]);
    const Lanes s1 = load(&tables_.sin1[n]);
    const Lanes c2 = load(&tables_.cos2[n]);
    const Lanes s2 = load(&tables_.sin2[n]);
    x = p.constant[0] + slope[0] * d + p.cos1[0] * c1 + p.sin1[0] * s1 + p.cos2[0] * c2 +
        p.sin2[0] * s2;
    y = p.constant[1] + slope[1] * d + p.cos1[1] * c1 + p.sin1[1] * s1 + p.cos2[1] * c2 +
        p.sin2[1] * s2;
    z = p.constant[2] + slope[2] * d + p.cos1[2] * c1 + p.sin1[2] * s1;
    torque = p.constant[3] + slope[3] * d + p.cos1[3] * c1 + p.sin1[3] * s1;
  });
}

void SamplingRun::add_taylor(const Pass& pass, IndexRange indices, const Taylor& terms, double sign,
                             double origin) {
  const double from = pass.offset - origin;
  accumulate(indices, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
    const Lanes d = sign * (from + tables_.step * (static_cast<double>(n) + kLaneIndex));
    x = y = z = torque = Lanes{};
    for (int m = kTaylorTerms - 1; m >= 0; --m) {
      x = x * d + terms[m][0];
      y = y * d + terms[m][1];
      z = z * d + terms[m][2];
      torque = torque * d + terms[m][3];
    }
    x *= d, y *= d, z *= d, torque *= d;
  });
}

template <class Variable>
[[gnu::always_inline]] inline void SamplingRun::add_series_in(const Pass& pass, IndexRange indices,
                                                              const std::vector<double>& terms,
                                                              Terms kind, double sign,
                                                              double origin, double length,
                                                              const Variable& variable) {
  const double from = pass.offset - origin;
  accumulate(indices, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
    const Lanes d = sign * (from + tables_.step * (static_cast<double>(n) + kLaneIndex));
    const Lanes part = d / length;
    const Lanes t = variable(part > 0.0 ? (part < 1.0 ? part : Lanes{} + 1.0) : Lanes{});
    const std::array<Lanes, kRows> sum =
        sum_series<kRows, kRows>(kind, terms.data(), terms.size() / kRows, t);
    x = sum[0], y = sum[1], z = sum[2], torque = sum[3];
  });
}

void SamplingRun::add_series(const Pass& pass, IndexRange indices, const std::vector<double>& terms,
                             Terms kind, double sign, double origin, double length,
                             const SeriesVariable& variable) {
  add_series_in(pass, indices, terms, kind, sign, origin, length,
                [&](const Lanes& part) { return variable.at(part); });
}

void SamplingRun::add_quartic_chebyshev(const Pass& pass, IndexRange indices,
                                        const std::vector<double>& terms, double sign,
                                        double origin, double length) {
  add_series_in(
      pass, indices, terms, Terms::chebyshev, sign, origin, length,
      [&](const Lanes& part) -> Lanes { return 2.0 * square_root(square_root(part)) - 1.0; });
}

}  // namespace millstudy::force
