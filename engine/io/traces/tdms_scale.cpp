// SPDX-License-Identifier: MIT
#include "io/traces/tdms_scale.h"

#include <algorithm>
#include <fmt/core.h>

#include "core/error.h"

namespace millstudy::io::tdms {
namespace {

constexpr int kMostScales = 64;
constexpr int kMostCoefficients = 64;

double needed(const Source& source, const Channel& channel, const std::string& property) {
  const std::optional<double> value = channel.number(property);
  if (value) return *value;
  throw core::InputError({source.path, 0}, fmt::format("channel {}/{} has a scale without {}",
                                                       channel.group, channel.name, property));
}

std::vector<double> polynomial(const Source& source, const Channel& channel,
                               const std::string& scale, const std::string& type) {
  if (type == "Linear") {
    return {needed(source, channel, scale + "_Linear_Y_Intercept"),
            needed(source, channel, scale + "_Linear_Slope")};
  }
  if (type != "Polynomial") {
    throw core::InputError(
        {source.path, 0},
        fmt::format("channel {}/{} has a scale of the type {}; Linear and Polynomial can be read",
                    channel.group, channel.name, type));
  }
  const double size = channel.number(scale + "_Polynomial_Coefficients_Size").value_or(4.0);
  std::vector<double> coefficients;
  for (int i = 0; i < std::min(size, double{kMostCoefficients}); ++i) {
    coefficients.push_back(
        needed(source, channel, fmt::format("{}_Polynomial_Coefficients[{}]", scale, i)));
  }
  return coefficients;
}

}  // namespace

std::optional<Scale> scale_of(const Source& source, const Channel& channel) {
  const std::string status = channel.text("NI_Scaling_Status");
  if (status == "scaled" || status == "Scaled") return {};
  int last = -1;
  for (int i = 0; i < kMostScales; ++i) {
    if (!channel.text(fmt::format("NI_Scale[{}]_Scale_Type", i)).empty()) last = i;
  }
  if (last < 0) return {};
  Scale scale;
  // From the last scale back to the stored value, each by where its input comes from.
  for (int i = last; i >= 0;) {
    const std::string name = fmt::format("NI_Scale[{}]", i);
    const std::string type = channel.text(name + "_Scale_Type");
    if (type.empty()) break;  // the place of the raw data
    scale.polynomials.push_back(polynomial(source, channel, name, type));
    const std::optional<double> input = channel.number(name + '_' + type + "_Input_Source");
    if (!input || !(*input >= 0.0 && *input < i)) break;  // 2^32 - 1: the stored value
    i = static_cast<int>(*input);
  }
  std::reverse(scale.polynomials.begin(), scale.polynomials.end());
  return scale;
}

double apply(const Scale& scale, double value) {
  for (const std::vector<double>& coefficients : scale.polynomials) {
    double sum = 0.0;
    for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) sum = sum * value + *c;
    value = sum;
  }
  return value;
}

}  // namespace millstudy::io::tdms
