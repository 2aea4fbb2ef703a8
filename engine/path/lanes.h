// SPDX-License-Identifier: MIT
#pragma once

#include "path/vec3.h"

namespace millstudy::path {

/// Four doubles that move together: the homogeneous point (w x, w y, w z, w).
///
/// GCC's vector type keeps the four in one register where the machine has one, without leaving it
/// to the vectoriser, which at -O2 does not see it.
struct Lanes {
  using Four = double __attribute__((vector_size(32)));
  Four v;

  double w() const { return v[3]; }
  Vec3 xyz() const { return {v[0], v[1], v[2]}; }
};

inline Lanes make_lanes(const Vec3& a, double w) {
  return {Lanes::Four{a.x, a.y, a.z, w}};
}
inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return {a.v + b.v};
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return {a.v - b.v};
}
inline Lanes operator*(const Lanes& a, double s) {
  return {a.v * s};
}

/// Sum over all four lanes; the callers see to it that one of the w lanes is zero.
inline double dot(const Lanes& a, const Lanes& b) {
  const Lanes::Four p = a.v * b.v;
  return (p[0] + p[2]) + (p[1] + p[3]);
}

}  // namespace millstudy::path
