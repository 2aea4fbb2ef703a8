// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sweep/block.h"
#include "sweep/layout.h"

/// Invented studies whose value at every point is known, for tests of the result file.
namespace millstudy::io::sample {

enum class Design { grid, zip };

inline sweep::Coordinate numbers(const std::string& name, std::int64_t count) {
  std::vector<double> values;
  for (std::int64_t i = 0; i < count; ++i) values.push_back(600.0 + 100.0 * static_cast<double>(i));
  return {name, "cut." + name, "mm/min", "feed rate, axis " + name, values};
}

/// The first axis is one of texts (interpolators) when it is short.
inline sweep::Layout layout(const std::vector<std::int64_t>& shape, Design design, bool traces) {
  sweep::Layout result;
  result.shape = shape;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    std::string name = "axis_" + std::to_string(d);
    if (d == 0 && shape[d] <= 4) {
      const std::vector<std::string> methods = {"taylor1", "taylor2", "newton", "größer"};
      result.coordinates.push_back(
          {"method", "path.method", "1", "interpolator",
           std::vector<std::string>(methods.begin(), methods.begin() + shape[d])});
    } else {
      result.coordinates.push_back(numbers(name, shape[d]));
    }
    result.dimensions.push_back(result.coordinates.back().name);
  }
  if (design == Design::zip) {
    result.dimensions = {"point"};
    result.coordinates.push_back(numbers("feed_rate_mm_per_min", shape.at(0)));
    result.coordinates.push_back(numbers("spindle_speed_rpm", shape.at(0)));
  }
  result.columns = {{"force_resultant_mean", "N", "mean resultant force"},
                    {"feed_fluctuation_max", "percent", "largest feed fluctuation"},
                    {"steps", "1", "full steps"}};
  result.traces = traces;
  result.attributes = {{"title", std::string("sample")},
                       {"schema_version", std::int64_t{1}},
                       {"study_hash", std::string("0123abcd")}};
  return result;
}

inline sweep::Status status(std::int64_t point) {
  if (point % 7 == 3) return sweep::Status::failed;
  if (point % 11 == 5) return sweep::Status::skipped;
  return sweep::Status::ok;
}

inline std::string failure(std::int64_t point) {
  if (status(point) != sweep::Status::failed) return "";
  return point % 2 == 0 ? "the path, \"as given\", has no length" : "the chord is too long";
}

inline double value(std::size_t column, std::int64_t point) {
  const auto i = static_cast<double>(point);
  return column == 0 ? 300.0 + 0.1 * i + std::sin(i) : column == 1 ? std::exp(-1e-3 * i) : i;
}

inline std::int64_t trace_length(std::int64_t point) {
  return point % 5;
}

/// Points first .. first + count - 1 of a study with this layout.
inline sweep::Block block(const sweep::Layout& layout, std::int64_t first, std::int64_t count) {
  sweep::Block result(first, count, layout.columns.size(), layout.traces);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t point = first + i;
    const auto at = static_cast<std::size_t>(i);
    result.status[at] = status(point);
    result.failures[at] = failure(point);
    if (status(point) != sweep::Status::ok) continue;
    for (std::size_t c = 0; c < layout.columns.size(); ++c) result.value(c, i) = value(c, point);
    for (std::int64_t k = 0; layout.traces && k < trace_length(point); ++k) {
      const auto sample = static_cast<float>(point) + static_cast<float>(k) / 8.0f;
      sweep::Trace& trace = result.traces[at];
      trace.time.push_back(sample);
      trace.angle.push_back(2.0f * sample);
      trace.force_x.push_back(-sample);
      trace.force_y.push_back(sample + 1.0f);
      trace.force_z.push_back(sample + 2.0f);
    }
  }
  return result;
}

}  // namespace millstudy::io::sample
