// SPDX-License-Identifier: MIT
#include "path/curve.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.h"
#include "path/arc_length.h"
#include "path/curve_pieces.h"

namespace millstudy::path {
namespace {

constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();
constexpr double kLeastReach = 0.01;

void refuse_faults(const CurveData& data) {
  std::vector<core::Fault> found;
  for (std::string& line : faults(data)) found.push_back({{}, std::move(line)});
  if (!found.empty()) throw core::InputError(std::move(found));
}

}  // namespace

Curve::Curve(const CurveData& data) {
  refuse_faults(data);
  degree_ = data.degree;
  double size = 0.0;
  for (const Vec3& p : data.points) size = std::max(size, norm(p - data.points.front()));
  for (const Piece& piece : make_pieces(data)) {
    Span span;
    span.begin = piece.begin;
    span.end = piece.end;
    span.middle = piece.begin + 0.5 * (piece.end - piece.begin);
    span.half = 0.5 * (piece.end - piece.begin);
    span.inverse_half = 1.0 / span.half;
    span.origin = piece.origin;
    span.bend = piece.bend;
    double reach = kLeastReach * size;  // a span whose points are all equal still has rounding
    for (const Homogeneous& b : piece.bezier) reach = std::max(reach, norm(b.xyz()) / b.w());
    span.rest = kRounding * degree_ * reach;
    span.rational = std::any_of(piece.power.begin() + 1, piece.power.end(),
                                [](const Homogeneous& c) { return c.w() != 0.0; });
    span.coefficients = coefficients_.size();
    coefficients_.insert(coefficients_.end(), piece.power.begin(), piece.power.end());
    bezier_.insert(bezier_.end(), piece.bezier.begin(), piece.bezier.end());
    spans_.push_back(span);
  }
  for (std::size_t k = 1; k < spans_.size(); ++k) {
    const Homogeneous before = local({k - 1, 1.0}).first * spans_[k - 1].inverse_half;
    const Homogeneous after = local({k, -1.0}).first * spans_[k].inverse_half;
    spans_[k].kink = norm((after - before).xyz());
  }
  length_ = arc_length(*this, begin(), end());
}

Cursor Curve::locate(double u, std::size_t hint) const {
  std::size_t k = hint;
  if (!(u >= spans_[k].begin)) k = 0;
  if (k + 1 < spans_.size() && u >= spans_[k].end) {
    ++k;  // the usual case: the next one
    if (k + 1 < spans_.size() && u >= spans_[k].end) {
      const auto after = std::upper_bound(spans_.begin() + k, spans_.end(), u,
                                          [](double x, const Span& s) { return x < s.begin; });
      k = static_cast<std::size_t>(after - spans_.begin()) - 1;
    }
  }
  const double t = (u - spans_[k].middle) * spans_[k].inverse_half;
  return {k, std::clamp(t, -1.0, 1.0)};
}

Vec3 Curve::local_second(Cursor at, const LocalPoint& point) const {
  const Homogeneous* c = &coefficients_[spans_[at.span].coefficients];
  Homogeneous value = c[degree_] * 0.0;
  Homogeneous slope = value;
  Homogeneous second = value;
  for (int i = degree_; i >= 0; --i) {
    second = second * at.t + slope;
    slope = slope * at.t + value;
    value = value * at.t + c[i];
  }
  second = second * 2.0;
  if (!spans_[at.span].rational) return second.xyz();
  // (P2), second derivative of the quotient
  return (1.0 / value.w()) *
         (second.xyz() - 2.0 * slope.w() * point.first.xyz() - second.w() * point.position.xyz());
}

CurvePoint Curve::evaluate(double u) const {
  const Cursor at = locate(u);
  const Span& span = spans_[at.span];
  const LocalPoint point = local(at);
  const double scale = span.inverse_half;
  return {span.origin + point.position.xyz(), scale * point.first.xyz(),
          scale * scale * local_second(at, point)};
}

Vec3 Curve::position(double u) const {
  const Cursor at = locate(u);
  return spans_[at.span].origin + local(at).position.xyz();
}

}  // namespace millstudy::path
