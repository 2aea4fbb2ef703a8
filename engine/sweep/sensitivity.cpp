// SPDX-License-Identifier: MIT
#include "sweep/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace millstudy::sweep {
namespace {

constexpr std::int64_t kParts = 1024;
constexpr int kBootstrap = 1000;

/// Sums over some groups, of which all estimates are made (theory.md, (W3) to (W5)); first and
/// total have one for each axis.
struct Sums {
  explicit Sums(int axes) : first(axes), total(axes) {}

  double groups = 0.0;
  double sum = 0.0;      // of the values of the first two points
  double squares = 0.0;  // of the same
  std::vector<double> first;
  std::vector<double> total;

  void add(const Sums& other, double times) {
    groups += times * other.groups;
    sum += times * other.sum;
    squares += times * other.squares;
    for (std::size_t i = 0; i < first.size(); ++i) {
      first[i] += times * other.first[i];
      total[i] += times * other.total[i];
    }
  }
  double variance() const {
    const double mean = sum / (2.0 * groups);
    return squares / (2.0 * groups) - mean * mean;
  }
};

/// (W3) to (W5) of one group. @param mean  taken off its values
void add_group(Sums& sums, std::span<const double> group, double mean) {
  const double a = group[0] - mean, b = group[1] - mean;
  sums.groups += 1.0;
  sums.sum += a + b;
  sums.squares += a * a + b * b;
  for (std::size_t i = 0; i < sums.first.size(); ++i) {
    const double ab = group[2 + i] - mean;
    sums.first[i] += b * (ab - a);
    sums.total[i] += 0.5 * (a - ab) * (a - ab);
  }
}

Interval interval(double value, std::vector<double>& samples) {
  std::sort(samples.begin(), samples.end());
  const auto at = [&](double part) {
    return samples[static_cast<std::size_t>(part * static_cast<double>(samples.size() - 1) + 0.5)];
  };
  return {value, at(0.025), at(0.975)};
}

}  // namespace

Sensitivity sobol_indices(std::span<const double> values, int axes) {
  const auto width = static_cast<std::size_t>(axes + 2);
  const std::size_t all = values.size() / width;
  std::vector<std::size_t> whole;
  for (std::size_t g = 0; g < all; ++g) {
    const auto group = values.subspan(g * width, width);
    if (std::none_of(group.begin(), group.end(), [](double x) { return std::isnan(x); })) {
      whole.push_back(g);
    }
  }
  Sensitivity result;
  result.groups = static_cast<std::int64_t>(whole.size());
  result.dropped = static_cast<std::int64_t>(all - whole.size());
  const double nan = std::nan("");
  result.axes.assign(static_cast<std::size_t>(axes), {{nan, nan, nan}, {nan, nan, nan}});
  result.mean = result.variance = nan;
  if (whole.empty()) return result;

  double mean = 0.0;
  for (const std::size_t g : whole) mean += values[g * width] + values[g * width + 1];
  mean /= 2.0 * static_cast<double>(whole.size());
  const std::size_t parts = std::min(whole.size(), static_cast<std::size_t>(kParts));
  std::vector<Sums> sums(parts, Sums(axes));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    add_group(sums[i * parts / whole.size()], values.subspan(whole[i] * width, width), mean);
  }
  Sums total(axes);
  for (const Sums& part : sums) total.add(part, 1.0);
  result.mean = mean;
  result.variance = std::max(total.variance(), 0.0);
  // What rounding leaves of a constant is no variance.
  if (result.variance <= 1e-24 * mean * mean) return result;

  std::vector<std::vector<double>> first(axes), whole_effect(axes);
  std::mt19937_64 random(20'101);
  std::vector<int> times(parts);
  for (int sample = 0; sample < kBootstrap; ++sample) {
    std::fill(times.begin(), times.end(), 0);
    for (std::size_t i = 0; i < parts; ++i) ++times[random() % parts];
    Sums drawn(axes);
    for (std::size_t i = 0; i < parts; ++i) {
      if (times[i] > 0) drawn.add(sums[i], times[i]);
    }
    const double variance = drawn.groups * drawn.variance();
    if (!(variance > 0.0)) continue;
    for (int i = 0; i < axes; ++i) {
      first[i].push_back(drawn.first[i] / variance);
      whole_effect[i].push_back(drawn.total[i] / variance);
    }
  }
  const double variance = total.groups * total.variance();
  for (int i = 0; i < axes; ++i) {
    if (first[i].empty()) continue;
    result.axes[i].first = interval(total.first[i] / variance, first[i]);
    result.axes[i].total = interval(total.total[i] / variance, whole_effect[i]);
  }
  return result;
}

}  // namespace millstudy::sweep
