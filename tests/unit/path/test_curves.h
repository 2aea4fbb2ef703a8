// SPDX-License-Identifier: MIT
#pragma once

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "path/curve_data.h"

namespace millstudy::path::test {

/// The numbers after `key = ` up to the end of the value, brackets of any depth included.
inline std::vector<double> numbers_of(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\n" + key + " = ");
  if (at == std::string::npos) return {};
  std::vector<double> numbers;
  int depth = 0;
  for (std::size_t i = at + key.size() + 4; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '[') ++depth;
    if (c == ']') --depth;
    if (c == '\n' && depth == 0) break;
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '-') {
      char* end = nullptr;
      numbers.push_back(std::strtod(&text[i], &end));
      i = static_cast<std::size_t>(end - text.data()) - 1;
    }
  }
  return numbers;
}

/// A curve of data/curves, read without the room io: only what those files contain.
inline CurveData data_curve(const std::string& name, int dimensions) {
  std::ifstream file(std::string(MILLSTUDY_SOURCE_DIR) + "/data/curves/" + name + ".toml");
  std::stringstream text;
  text << file.rdbuf();
  if (text.str().empty()) throw std::runtime_error("no curve file " + name);
  CurveData data;
  data.degree = static_cast<int>(numbers_of(text.str(), "degree").at(0));
  data.knots = numbers_of(text.str(), "knots");
  data.weights = numbers_of(text.str(), "weights");
  const std::vector<double> c = numbers_of(text.str(), "points_mm");
  for (std::size_t i = 0; i + dimensions <= c.size(); i += dimensions) {
    data.points.push_back({c[i], c[i + 1], dimensions == 3 ? c[i + 2] : 0.0});
  }
  return data;
}

inline CurveData sun2008() {
  return data_curve("sun2008", 3);
}
inline CurveData butterfly() {
  return data_curve("butterfly", 2);
}
inline CurveData trident() {
  return data_curve("trident", 2);
}

/// A clamped curve on equal spans, weights 1.
inline CurveData clamped(int degree, std::vector<Vec3> points) {
  const int n = static_cast<int>(points.size());
  return {degree, clamped_uniform_knots(degree, n), std::move(points), {}};
}

/// What a random curve may have.
struct Wildness {
  bool repeated_knots = true;
  bool unclamped = true;
  bool doubled_points = true;
  bool turn_backs = true;
  double weight_decades = 3.0;  ///< weights 10^-d to 10^d
  int highest_degree = 7;
};

/// A random curve about 10 mm large; the same for the same seed.
inline CurveData random_curve(unsigned seed, const Wildness& wild = {}) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&](double a, double b) {
    return a + (b - a) * (static_cast<double>(engine() >> 11) * 0x1p-53);
  };
  const auto chance = [&](double p) { return uniform(0.0, 1.0) < p; };
  CurveData data;
  data.degree = 1 + static_cast<int>(uniform(0.0, wild.highest_degree));
  const int n = data.degree + 1 + static_cast<int>(uniform(0.0, 9.0));
  const bool flat = chance(0.5);
  for (int i = 0; i < n; ++i) {
    Vec3 p{uniform(-5.0, 5.0), uniform(-5.0, 5.0), flat ? 0.0 : uniform(-5.0, 5.0)};
    if (i > 0 && wild.doubled_points && chance(0.15)) p = data.points[i - 1];
    if (i > 1 && wild.turn_backs && chance(0.15)) {
      p = data.points[i - 1] + uniform(0.1, 2.0) * (data.points[i - 2] - data.points[i - 1]);
    }
    data.points.push_back(p);
  }
  if (data.points.front() == data.points.back()) data.points.back().x += 1.0;
  const bool clamp = !wild.unclamped || chance(0.6);
  double knot = uniform(-2.0, 2.0);
  int repeats = 0;
  const int p = data.degree;
  for (int i = 0; i < n + p + 1; ++i) {
    const bool at_ends = clamp && ((i > 0 && i <= p) || i > n);
    const bool repeat = i > 0 && (at_ends || (wild.repeated_knots && i != n && chance(0.2) &&
                                              repeats < p - 1 && i != p + 1));
    repeats = repeat ? repeats + 1 : 0;
    if (i > 0 && !repeat) knot += uniform(0.05, 1.0);
    data.knots.push_back(knot);
  }
  if (chance(0.6)) {
    const double d = chance(0.5) ? wild.weight_decades : 0.3;
    for (int i = 0; i < n; ++i) data.weights.push_back(std::pow(10.0, uniform(-d, d)));
  }
  return data;
}

}  // namespace millstudy::path::test
