// SPDX-License-Identifier: MIT
#pragma once

#include "path/vec3.h"

namespace millstudy::path {

/// The homogeneous point (w x, w y, w z, w), or a difference of two.
///
/// GCC's vector type keeps the four in one register where the machine has one, without leaving it
/// to the vectoriser, which at -O2 does not see it.
struct Homogeneous {
  using Four = double __attribute__((vector_size(32)));
  Four v;

  double w() const { return v[3]; }
  Vec3 xyz() const { return {v[0], v[1], v[2]}; }
};

inline Homogeneous make_homogeneous(const Vec3& a, double w) {
  return {Homogeneous::Four{a.x, a.y, a.z, w}};
}
inline Homogeneous operator+(const Homogeneous& a, const Homogeneous& b) {
  return {a.v + b.v};
}
inline Homogeneous operator-(const Homogeneous& a, const Homogeneous& b) {
  return {a.v - b.v};
}
inline Homogeneous operator*(const Homogeneous& a, double s) {
  return {a.v * s};
}

/// Sum over all four; the callers see to it that one of the two w is zero.
inline double dot(const Homogeneous& a, const Homogeneous& b) {
  const Homogeneous::Four p = a.v * b.v;
  return (p[0] + p[2]) + (p[1] + p[3]);
}

}  // namespace millstudy::path
