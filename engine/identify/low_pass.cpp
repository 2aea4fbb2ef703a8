// SPDX-License-Identifier: MIT
#include "identify/low_pass.h"

#include <cmath>
#include <cstddef>

#include "core/units.h"

namespace millstudy::identify {

std::size_t low_pass_length(double frequency, double sampling_rate) {
  // A Blackman window passes from 1 to 0 over 5.5 / length of the sampling rate; here over half the
  // frequency.
  const double part = frequency / sampling_rate;
  return 2 * static_cast<std::size_t>(std::ceil(5.5 / part)) + 1;
}

std::vector<double> low_pass(std::span<const double> signal, double frequency, double sampling_rate,
                             std::size_t step) {
  const std::size_t length = low_pass_length(frequency, sampling_rate);
  if (signal.size() < length) return {};
  std::vector<double> weights(length);
  double sum = 0.0;
  for (std::size_t i = 0; i < length; ++i) {
    const double t = static_cast<double>(i) - 0.5 * static_cast<double>(length - 1);
    const double x = core::kTurn * frequency / sampling_rate * t;
    const double w = core::kTurn * static_cast<double>(i + 1) / static_cast<double>(length + 1);
    weights[i] =
        (x == 0.0 ? 1.0 : std::sin(x) / x) * (0.42 - 0.5 * std::cos(w) + 0.08 * std::cos(2.0 * w));
    sum += weights[i];
  }
  for (double& w : weights) w /= sum;
  const std::size_t count = (signal.size() - length) / step + 1;
  std::vector<double> out(count);
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {  // together, for each sum waits for itself
    const double* x = &signal[i * step];
    double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
#pragma omp simd reduction(+ : a, b, c, d)
    for (std::size_t k = 0; k < length; ++k) {
      a += weights[k] * x[k];
      b += weights[k] * x[k + step];
      c += weights[k] * x[k + 2 * step];
      d += weights[k] * x[k + 3 * step];
    }
    out[i] = a, out[i + 1] = b, out[i + 2] = c, out[i + 3] = d;
  }
  for (; i < count; ++i) {
    double sum_here = 0.0;
#pragma omp simd reduction(+ : sum_here)
    for (std::size_t k = 0; k < length; ++k) sum_here += weights[k] * signal[i * step + k];
    out[i] = sum_here;
  }
  return out;
}

}  // namespace millstudy::identify
