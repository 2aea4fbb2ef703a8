// SPDX-License-Identifier: MIT
#pragma once

/// Conversions between the native units of the engine (mm, s, rad, N) and the units of files.
///
/// Inside the engine every plain double is native; only the edges call these. Keys of studies have
/// their units in the table of study/key.h.
namespace millstudy::core {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTurn = 2.0 * kPi;  // [rad]

constexpr double rad_from_deg(double deg) {
  return deg * (kPi / 180.0);
}
constexpr double deg_from_rad(double rad) {
  return rad * (180.0 / kPi);
}
constexpr double mm_from_um(double um) {
  return um * 1e-3;
}
/// Torque: N mm to N m.
constexpr double newton_metre(double newton_mm) {
  return newton_mm * 1e-3;
}
/// Material removal rate: mm3/s to cm3/min.
constexpr double cm3_per_min_from_mm3_per_s(double rate) {
  return rate * 0.06;
}

}  // namespace millstudy::core
