// SPDX-License-Identifier: MIT
#include "path/curve_data.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/core.h>

namespace millstudy::path {
namespace {

constexpr double kLargestCoordinate = 1e9;  // mm: a thousand kilometres
constexpr double kLargestKnot = 1e9;        // keeps every product below in range
constexpr double kSmallestSpan = 1e-9;      // of the domain: below, a parameter step has no digits
constexpr double kSmallestDomain = 1e-9;    // width
constexpr double kLargestWeightRatio = 1e12;  // beyond, points of small weight are lost in rounding
constexpr std::size_t kMostPoints = 1000000;

using Lines = std::vector<std::string>;

bool within(double value, double limit) {
  return std::abs(value) <= limit;
}  // false for NaN

void check_counts(const CurveData& data, Lines& lines) {
  if (data.degree < 1 || data.degree > kHighestDegree) {
    lines.push_back(fmt::format("degree = {} must be 1 to {}", data.degree, kHighestDegree));
  }
  const std::size_t points = data.points.size();
  if (points > kMostPoints) {
    lines.push_back(fmt::format("{} points are more than {}", points, kMostPoints));
  }
  if (!data.weights.empty() && data.weights.size() != points) {
    lines.push_back(
        fmt::format("{} weights for {} points: give one each", data.weights.size(), points));
  }
  if (!lines.empty()) return;
  const std::size_t degree = static_cast<std::size_t>(data.degree);
  if (points < degree + 1) {
    lines.push_back(fmt::format("{} points are too few for degree {}: at least {} are needed",
                                points, degree, degree + 1));
  } else if (data.knots.size() != points + degree + 1) {
    lines.push_back(fmt::format("{} knots must be {} (points {} + degree {} + 1)",
                                data.knots.size(), points + degree + 1, points, degree));
  }
}

void check_points(const CurveData& data, Lines& lines) {
  bool all_equal = !data.points.empty();
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Vec3& p = data.points[i];
    for (const double c : {p.x, p.y, p.z}) {
      if (!within(c, kLargestCoordinate)) {
        lines.push_back(fmt::format("point {}: coordinate {} must be a number within +-{} mm", i, c,
                                    kLargestCoordinate));
      }
    }
    if (!(p == data.points.front())) all_equal = false;
  }
  if (all_equal) lines.push_back("all points are equal: the curve has no length");
}

void check_weights(const CurveData& data, Lines& lines) {
  if (data.weights.empty()) return;
  double smallest = data.weights.front();
  double largest = smallest;
  bool good = true;
  for (std::size_t i = 0; i < data.weights.size(); ++i) {
    const double w = data.weights[i];
    if (!(w > 0.0) || !std::isfinite(w)) {
      lines.push_back(fmt::format("weight {} = {} must be a number > 0", i, w));
      good = false;
    }
    smallest = std::min(smallest, w);
    largest = std::max(largest, w);
  }
  if (good && !(largest / smallest <= kLargestWeightRatio)) {
    lines.push_back(fmt::format("weights from {} to {}: the ratio must not exceed {}", smallest,
                                largest, kLargestWeightRatio));
  }
}

void check_knots(const CurveData& data, Lines& lines) {
  const std::size_t before = lines.size();
  for (std::size_t i = 0; i < data.knots.size(); ++i) {
    if (!within(data.knots[i], kLargestKnot)) {
      lines.push_back(
          fmt::format("knot {} = {} must be a number within +-{}", i, data.knots[i], kLargestKnot));
    } else if (i > 0 && data.knots[i] < data.knots[i - 1]) {
      lines.push_back(fmt::format("knot {} = {} is smaller than the one before it, {}", i,
                                  data.knots[i], data.knots[i - 1]));
    }
  }
  if (lines.size() > before) return;
  const std::size_t p = static_cast<std::size_t>(data.degree);
  for (std::size_t i = 0, count = 0; i < data.knots.size(); ++i) {
    count = i > 0 && data.knots[i] == data.knots[i - 1] ? count + 1 : 1;
    if (count == p + 2) {
      lines.push_back(
          fmt::format("knot {} is repeated more than degree + 1 = {} times", data.knots[i], p + 1));
    }
  }
}

/// What needs counts, knots and points to be in order.
void check_domain(const CurveData& data, Lines& lines) {
  const std::size_t p = static_cast<std::size_t>(data.degree);
  const std::size_t n = data.points.size();
  const double begin = data.knots[p];
  const double end = data.knots[n];
  const double width = end - begin;
  if (!(width >= kSmallestDomain)) {
    lines.push_back(
        fmt::format("the domain from knot {} = {} to knot {} = {} is empty", p, begin, n, end));
    return;
  }
  for (std::size_t i = p; i < n; ++i) {
    const double span = data.knots[i + 1] - data.knots[i];
    if (span > 0.0 && span < kSmallestSpan * width) {
      lines.push_back(
          fmt::format("knots {} and {} are closer than {} of the domain: make them equal", i, i + 1,
                      kSmallestSpan));
    }
  }
  // An interior knot of full multiplicity breaks the curve unless both sides meet in one point.
  for (std::size_t i = p + 1; i + p < data.knots.size() && i < n; ++i) {
    const double knot = data.knots[i];
    if (knot <= begin || knot >= end || data.knots[i + p] != knot) continue;
    if (!(data.points[i - 1] == data.points[i])) {
      lines.push_back(fmt::format(
          "knot {} is repeated degree + 1 times: the curve breaks between points {} and {}", knot,
          i - 1, i));
    }
  }
}

}  // namespace

std::vector<std::string> faults(const CurveData& data) {
  Lines lines;
  check_counts(data, lines);
  const bool counts_good = lines.empty();
  check_points(data, lines);
  check_weights(data, lines);
  const std::size_t before_knots = lines.size();
  check_knots(data, lines);
  if (counts_good && lines.size() == before_knots) check_domain(data, lines);
  return lines;
}

std::vector<double> bezier_knots(int degree) {
  return clamped_uniform_knots(degree, degree + 1);
}

std::vector<double> clamped_uniform_knots(int degree, int points) {
  std::vector<double> knots(static_cast<std::size_t>(points + degree + 1));
  const int spans = points - degree;
  for (int i = 0; i < points + degree + 1; ++i) {
    knots[i] = std::clamp((i - degree) / static_cast<double>(spans), 0.0, 1.0);
  }
  return knots;
}

}  // namespace millstudy::path
