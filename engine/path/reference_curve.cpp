// SPDX-License-Identifier: MIT
#include "path/reference_curve.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"

namespace millstudy::path {
namespace {

constexpr int kMost = kHighestDegree + 1;
using Basis = std::array<std::array<double, kMost>, 3>;  // derivative order, function

/// A2.1: k with knots[k] <= u < knots[k + 1], degree <= k < points; the last one at the end.
int find_span(const CurveData& data, double u) {
  const int p = data.degree;
  const int n = static_cast<int>(data.points.size());
  int low = p;
  int high = n;
  if (u >= data.knots[n]) {
    int k = n - 1;
    while (data.knots[k] == data.knots[n]) --k;
    return k;
  }
  int middle = (low + high) / 2;
  while (u < data.knots[middle] || u >= data.knots[middle + 1]) {
    (u < data.knots[middle] ? high : low) = middle;
    middle = (low + high) / 2;
  }
  return middle;
}

/// A2.3 for derivatives up to `order` <= 2.
void basis_functions(const CurveData& data, int k, double u, int order, Basis& ders) {
  const int p = data.degree;
  std::array<std::array<double, kMost>, kMost> ndu;
  std::array<double, kMost> left;
  std::array<double, kMost> right;
  ndu[0][0] = 1.0;
  for (int j = 1; j <= p; ++j) {
    left[j] = u - data.knots[k + 1 - j];
    right[j] = data.knots[k + j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r) {
      ndu[j][r] = right[r + 1] + left[j - r];
      const double temp = ndu[r][j - 1] / ndu[j][r];
      ndu[r][j] = saved + right[r + 1] * temp;
      saved = left[j - r] * temp;
    }
    ndu[j][j] = saved;
  }
  for (int j = 0; j <= p; ++j) ders[0][j] = ndu[j][p];
  std::array<std::array<double, kMost>, 2> a;
  for (int r = 0; r <= p; ++r) {
    int s1 = 0;
    int s2 = 1;
    a[0][0] = 1.0;
    for (int m = 1; m <= order; ++m) {
      const int rk = r - m;
      const int pk = p - m;
      double d = 0.0;
      if (pk < 0) {  // the book stops at the degree; beyond it derivatives are zero
        ders[m][r] = 0.0;
        continue;
      }
      if (r >= m) {
        a[s2][0] = a[s1][0] / ndu[pk + 1][rk];
        d = a[s2][0] * ndu[rk][pk];
      }
      const int j1 = rk >= -1 ? 1 : -rk;
      const int j2 = r - 1 <= pk ? m - 1 : p - r;
      for (int j = j1; j <= j2; ++j) {
        a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[pk + 1][rk + j];
        d += a[s2][j] * ndu[rk + j][pk];
      }
      if (r <= pk) {
        a[s2][m] = -a[s1][m - 1] / ndu[pk + 1][r];
        d += a[s2][m] * ndu[r][pk];
      }
      ders[m][r] = d;
      std::swap(s1, s2);
    }
  }
  int factor = p;
  for (int m = 1; m <= order; ++m) {
    for (int j = 0; j <= p; ++j) ders[m][j] *= factor;
    factor *= p - m;
  }
}

}  // namespace

ReferenceCurve::ReferenceCurve(CurveData data) : data_(std::move(data)) {
  std::vector<core::Fault> found;
  for (std::string& line : faults(data_)) found.push_back({{}, std::move(line)});
  if (!found.empty()) throw core::InputError(std::move(found));
  if (data_.weights.empty()) data_.weights.assign(data_.points.size(), 1.0);
}

CurvePoint ReferenceCurve::evaluate(double u, int order) const {
  u = std::clamp(u, begin(), end());
  const int k = find_span(data_, u);
  Basis basis;
  basis_functions(data_, k, u, order, basis);
  std::array<Vec3, 3> a{};    // derivatives of the numerator
  std::array<double, 3> w{};  // and of the denominator
  for (int d = 0; d <= order; ++d) {
    for (int j = 0; j <= data_.degree; ++j) {
      const int i = k - data_.degree + j;
      const double weighted = basis[d][j] * data_.weights[i];
      a[d] = a[d] + weighted * data_.points[i];
      w[d] += weighted;
    }
  }
  // A4.2
  CurvePoint out;
  const double inverse = 1.0 / w[0];
  out.position = inverse * a[0];
  if (order >= 1) out.first = inverse * (a[1] - w[1] * out.position);
  if (order >= 2) {
    out.second = inverse * (a[2] - 2.0 * w[1] * out.first - w[2] * out.position);
  }
  return out;
}

}  // namespace millstudy::path
