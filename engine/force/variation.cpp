// SPDX-License-Identifier: MIT
#include "force/variation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::force {
namespace {

constexpr std::size_t kMostPolynomial = 4;

double interpolated(const std::vector<double>& heights, const std::vector<double>& values,
                    double z) {
  const auto above = std::upper_bound(heights.begin(), heights.end(), z);
  if (above == heights.begin()) return values.front();
  if (above == heights.end()) return values.back();
  const auto i = static_cast<std::size_t>(above - heights.begin());
  const double part = (z - heights[i - 1]) / (heights[i] - heights[i - 1]);
  return values[i - 1] + part * (values[i] - values[i - 1]);
}

double at(const OrthogonalQuantity& quantity, double rake, double chip_thickness) {
  return quantity.constant + quantity.per_rake * rake + quantity.per_chip * chip_thickness;
}

bool depends_on_chip(const OrthogonalData& data) {
  return data.shear_stress.per_chip != 0.0 || data.shear_angle.per_chip != 0.0 ||
         data.friction_angle.per_chip != 0.0;
}

void check(const HeightFactors& factors) {
  const bool ascending =
      std::adjacent_find(factors.heights.begin(), factors.heights.end(),
                         [](double a, double b) { return !(a < b); }) == factors.heights.end();
  if (!ascending || (!factors.heights.empty() && !(factors.heights.front() >= 0.0))) {
    throw core::InputError("the heights of coefficient tables must be >= 0 and ascend");
  }
  for (int q = 0; q < 6; ++q) {
    if (!factors.table[q].empty() && factors.table[q].size() != factors.heights.size()) {
      throw core::InputError("a coefficient table must have one factor for each height");
    }
    if (factors.polynomial[q].size() > kMostPolynomial) {
      throw core::InputError("a coefficient polynomial has at most four terms");
    }
  }
}

}  // namespace

bool Variation::with_exponent() const {
  return std::any_of(size_exponent.begin(), size_exponent.end(), [](double m) { return m != 0.0; });
}

bool Variation::with_chip() const {
  return with_exponent() || (orthogonal && depends_on_chip(*orthogonal));
}

bool Variation::with_height() const {
  return height != nullptr || orthogonal.has_value();
}

void check(const Variation& variation) {
  for (const double m : variation.size_exponent) {
    if (!(m >= 0.0 && m < 1.0)) {
      throw core::InputError("a size-effect exponent = " + std::to_string(m) +
                             " must be >= 0 and < 1");
    }
  }
  if (!(variation.reference_chip_thickness > 0.0)) {
    throw core::InputError("reference_chip_thickness must be > 0");
  }
  if (variation.height) check(*variation.height);
}

std::array<double, 6> height_factors(const HeightFactors& factors, double z) {
  std::array<double, 6> at_z;
  for (int q = 0; q < 6; ++q) {
    double polynomial = 0.0;
    for (std::size_t n = factors.polynomial[q].size(); n > 0; --n) {
      polynomial = (polynomial + factors.polynomial[q][n - 1]) * z;
    }
    at_z[q] = 1.0 + polynomial;
    if (!factors.table[q].empty()) at_z[q] *= interpolated(factors.heights, factors.table[q], z);
  }
  return at_z;
}

std::array<double, 3> oblique_coefficients(const OrthogonalData& data, double inclination,
                                           double chip_thickness) {
  const double rake = data.rake_angle;
  const double stress = std::max(0.0, at(data.shear_stress, rake, chip_thickness));
  const double shear = std::clamp(at(data.shear_angle, rake, chip_thickness),
                                  core::rad_from_deg(1.0), core::rad_from_deg(80.0));
  const double friction =
      std::clamp(at(data.friction_angle, rake, chip_thickness), 0.0, core::rad_from_deg(80.0));
  const double tan_i = std::abs(std::tan(inclination));
  const double cos_i = std::cos(inclination);
  const double normal_friction = std::atan(std::tan(friction) * cos_i);  // eta = i
  const double sin_f = std::sin(normal_friction);
  // Within a degree of a right angle, and beyond, shearing has no meaning any more: kept off it.
  const double plane = std::min(shear + normal_friction - rake, core::rad_from_deg(89.0));
  const double cos_fr = std::cos(normal_friction - rake);
  const double c = std::hypot(std::cos(plane), tan_i * sin_f);
  const double scale = stress / (std::sin(shear) * c);
  return {scale * (cos_fr + tan_i * tan_i * sin_f),
          scale * std::sin(normal_friction - rake) / cos_i,
          scale * (cos_fr * tan_i - tan_i * sin_f)};
}

}  // namespace millstudy::force
