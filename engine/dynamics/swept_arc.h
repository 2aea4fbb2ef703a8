// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "force/engagement.h"

/// Integrals over the arc of engagement of 1, cos(2 phi), sin(2 phi), which is all that (D5) has.
namespace millstudy::dynamics {

/// (D5): the directional matrix of tangential and radial weight [N/mm], given 1, cos(2 phi),
/// sin(2 phi) or integrals of them; rows and columns x, y.
inline Eigen::Matrix2d directional(double tangential, double radial, const Eigen::Vector3d& terms) {
  const double one = terms[0], c = terms[1], s = terms[2];
  Eigen::Matrix2d a;
  a << tangential * s + radial * (one - c), tangential * (one + c) + radial * s,
      -tangential * (one - c) + radial * s, -tangential * s + radial * (one + c);
  return 0.5 * a;
}

/// (D7): first and second integral, over all angles below phi, of the three terms where phi is in
/// an arc, which comes back every turn. Counted from the entry angle; exact to rounding.
class SweptArc {
 public:
  explicit SweptArc(const force::Arc& arc)
      : arc_(arc),
        entry_(arc.entry_angle),
        width_(arc.exit_angle - arc.entry_angle),
        cos_(std::cos(2.0 * entry_)),
        sin_(std::sin(2.0 * entry_)),
        arc_once_(once_within(width_)),
        turn_twice_(twice_within(width_) + (core::kTurn - width_) * arc_once_) {}

  Eigen::Vector3d once(double phi) const {
    const auto [turns, rest] = split(phi);
    return turns * arc_once_ + once_within(std::min(rest, width_));
  }

  /// once() at phi, phi + step, ...: visit(i, terms) for 0 .. count - 1. Sines by rotation, made
  /// anew every few steps: exact to 1e-15.
  template <class Visit>
  void for_each_once(double phi, double step, int count, const Visit& visit) const {
    constexpr int kRotations = 16;
    const double s_step = std::sin(2.0 * step), c_step = std::cos(2.0 * step);
    double s = 0.0, c = 1.0;
    int rotated = kRotations;
    for (int i = 0; i < count; ++i) {
      const auto [turns, rest] = split(phi + i * step);
      if (rest >= width_) {
        visit(i, Eigen::Vector3d((turns + 1.0) * arc_once_));
        rotated = kRotations;
        continue;
      }
      if (rotated == kRotations) {
        s = std::sin(2.0 * rest);
        c = std::cos(2.0 * rest);
        rotated = 0;
      } else {
        const double next = s * c_step + c * s_step;
        c = c * c_step - s * s_step;
        s = next;
        ++rotated;
      }
      const double c1 = 1.0 - c;
      visit(i,
            Eigen::Vector3d(turns * arc_once_ + Eigen::Vector3d(rest, 0.5 * (cos_ * s - sin_ * c1),
                                                                0.5 * (sin_ * s + cos_ * c1))));
    }
  }

  Eigen::Vector3d twice(double phi) const {
    const auto [turns, rest] = split(phi);
    const Eigen::Vector3d partial =
        rest < width_ ? twice_within(rest) : twice_within(width_) + (rest - width_) * arc_once_;
    return turns * turn_twice_ + (core::kPi * turns * (turns - 1.0) + rest * turns) * arc_once_ +
           partial;
  }

  const force::Arc& arc() const { return arc_; }
  double entry() const { return entry_; }
  double width() const { return width_; }

 private:
  struct Split {
    double turns;
    double rest;  // 0 .. 2 pi
  };
  Split split(double phi) const {
    const double past = phi - entry_;
    const double turns = std::floor(past / core::kTurn);
    return {turns, past - turns * core::kTurn};
  }
  Eigen::Vector3d once_within(double r) const {
    // 2 entry + 2 r by the addition theorems: one sine and one cosine.
    const double s = std::sin(2.0 * r), c1 = 2.0 * std::sin(r) * std::sin(r);  // 1 - cos 2r
    return {r, 0.5 * (cos_ * s - sin_ * c1), 0.5 * (sin_ * s + cos_ * c1)};
  }
  Eigen::Vector3d twice_within(double r) const {
    const double d = 2.0 * r - std::sin(2.0 * r), c1 = 2.0 * std::sin(r) * std::sin(r);
    return {0.5 * r * r, 0.25 * (cos_ * c1 - sin_ * d), 0.25 * (sin_ * c1 + cos_ * d)};
  }

  force::Arc arc_;
  double entry_;
  double width_;
  double cos_;
  double sin_;
  Eigen::Vector3d arc_once_;
  Eigen::Vector3d turn_twice_;
};

}  // namespace millstudy::dynamics
