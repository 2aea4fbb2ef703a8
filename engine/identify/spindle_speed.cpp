// SPDX-License-Identifier: MIT
#include "identify/spindle_speed.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/units.h"

namespace millstudy::identify {
namespace {

constexpr int kHarmonics = 24;

/// Part of the variance in the harmonics of a speed, over the first samples of a trace.
class HarmonicPower {
 public:
  HarmonicPower(const Trace& trace, std::size_t samples)
      : samples_(samples), rate_(trace.sampling_rate) {
    for (const std::vector<double>& force : trace.force) {
      if (force.empty()) continue;
      std::vector<double> centred(force.begin(),
                                  force.begin() + static_cast<std::ptrdiff_t>(samples));
      double mean = 0.0;
      for (const double f : centred) mean += f / static_cast<double>(samples);
      for (double& f : centred) {
        f -= mean;
        total_ += f * f;
      }
      forces_.push_back(std::move(centred));
    }
  }

  double at(double speed) const {
    const double step = speed / rate_;
    const int harmonics =
        std::max(1, std::min(kHarmonics, static_cast<int>(0.45 * core::kTurn / step)));
    std::vector<std::complex<double>> sums(forces_.size() * static_cast<std::size_t>(harmonics));
    for (std::size_t i = 0; i < samples_; ++i) {
      const double angle = step * static_cast<double>(i);
      const std::complex<double> turn(std::cos(angle), -std::sin(angle));
      std::complex<double> power = 1.0;
      for (int k = 0; k < harmonics; ++k) {
        power *= turn;
        for (std::size_t a = 0; a < forces_.size(); ++a) {
          sums[a * static_cast<std::size_t>(harmonics) + static_cast<std::size_t>(k)] +=
              forces_[a][i] * power;
        }
      }
    }
    double powers = 0.0;
    for (const std::complex<double>& sum : sums) powers += std::norm(sum);
    return total_ > 0.0 ? 2.0 * powers / static_cast<double>(samples_) / total_ : 0.0;
  }

 private:
  std::size_t samples_;
  double rate_;
  double total_ = 0.0;
  std::vector<std::vector<double>> forces_;
};

}  // namespace

SpindleSpeed estimate_spindle_speed(const Trace& trace, double nominal) {
  constexpr double kRange = 0.02;
  const double rate = trace.sampling_rate;
  const double all = static_cast<double>(trace.size());
  // A short stretch first: the finer a speed is told, the narrower the range that is left.
  double speed = nominal, range = kRange * nominal;
  double samples = std::min(all, 8.0 * core::kTurn / nominal * rate);
  for (;;) {
    const HarmonicPower power(trace, static_cast<std::size_t>(samples));
    // Between neighbours the tenth harmonic turns by an eighth over the stretch.
    const double step = core::kTurn * rate / samples / 80.0;
    const int steps = std::max(2, static_cast<int>(std::ceil(range / step)));
    double best = -1.0, found = speed;
    for (int i = -steps; i <= steps; ++i) {
      const double tried = speed + range * i / steps;
      const double here = power.at(tried);
      if (here > best) best = here, found = tried;
    }
    if (samples >= all) {
      // Golden section on the last peak.
      double low = found - range / steps, high = found + range / steps;
      constexpr double kGolden = 0.6180339887498949;
      double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
      double fa = power.at(a), fb = power.at(b);
      for (int i = 0; i < 24; ++i) {
        if (fa > fb) {
          high = b, b = a, fb = fa;
          fa = power.at(a = high - kGolden * (high - low));
        } else {
          low = a, a = b, fa = fb;
          fb = power.at(b = low + kGolden * (high - low));
        }
      }
      found = 0.5 * (low + high);
      return {found, power.at(found)};
    }
    speed = found;
    range = core::kTurn * rate / samples / 8.0;
    samples = std::min(all, 3.0 * samples);
  }
}

}  // namespace millstudy::identify
