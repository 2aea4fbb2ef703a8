// SPDX-License-Identifier: MIT
#include "identify/time_axis.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <map>

#include "core/error.h"

namespace millstudy::identify {
namespace {

constexpr std::size_t kMostFaults = 20;
constexpr int kMostDecimals = 12;
constexpr int kTimesLookedAt = 500;  // of each power of ten
constexpr double kStepTolerance = 0.05;
constexpr double kRateTolerance = 1e-3;

/// Decimals with which a number was printed; kMostDecimals: it was not rounded to fewer.
int decimals_of(double value) {
  double scaled = std::abs(value);
  for (int decimals = 0; decimals < kMostDecimals; ++decimals, scaled *= 10.0) {
    if (std::abs(scaled - std::round(scaled)) <= 1e-15 * scaled + 1e-9) return decimals;
  }
  return kMostDecimals;
}

int power_of_ten(double value) {
  return value == 0.0 ? -30 : static_cast<int>(std::floor(std::log10(std::abs(value))));
}

/// How coarsely times are rounded.
class Rounding {
 public:
  explicit Rounding(const std::vector<double>& times) {
    for (const double time : times) {
      single_ &= time == static_cast<double>(static_cast<float>(time));
      Power& power = powers_[power_of_ten(time)];
      if (power.seen++ < kTimesLookedAt) {
        power.decimals = std::max(power.decimals, decimals_of(time));
      }
    }
    // A power with few times, perhaps all of them whole: a fixed number of digits takes one decimal
    // for every power of ten, and never adds one.
    for (auto power = powers_.begin(); std::next(power) != powers_.end(); ++power) {
      const auto next = std::next(power);
      next->second.decimals =
          std::max(next->second.decimals, power->second.decimals - (next->first - power->first));
    }
    for (auto power = powers_.rbegin(); std::next(power) != powers_.rend(); ++power) {
      const auto smaller = std::next(power);
      smaller->second.decimals = std::max(smaller->second.decimals, power->second.decimals);
    }
  }
  /// Distance of the numbers that a time near this can be [s].
  double near(double time) const {
    const int decimals = powers_.at(power_of_ten(time)).decimals;
    const double printed = decimals < kMostDecimals ? std::pow(10.0, -decimals) : 0.0;
    const double binary = std::ldexp(std::abs(time), single_ ? -23 : -51);
    return std::max(printed, binary);
  }

 private:
  struct Power {
    int seen = 0;
    int decimals = 0;
  };
  std::map<int, Power> powers_;
  bool single_ = true;
};

core::Fault fault_at(const ChannelSet& set, std::size_t sample, const std::string& text) {
  const int line = set.line_of(sample);
  return {{set.source, line}, line > 0 ? text : fmt::format("sample {}: {}", sample, text)};
}

/// The number of the fewest digits within a tolerance (relative).
double round_rate(double rate, double tolerance) {
  for (int digits = 1; digits <= 12; ++digits) {
    const double unit = std::pow(10.0, power_of_ten(rate) + 1 - digits);
    const double rounded = std::round(rate / unit) * unit;
    if (std::abs(rounded - rate) <= tolerance * rate) return rounded;
  }
  return rate;
}

/// Whether times that are rounded to multiples of a unit are exact, the step being a multiple.
bool is_multiple(double step, double unit) {
  const double times = unit > 0.0 ? step / unit : 0.0;
  return times > 0.5 && std::abs(times - std::round(times)) < 1e-3;
}

void check_steps(const ChannelSet& set, const Rounding& rounding, double step,
                 std::vector<core::Fault>& faults) {
  const std::vector<double>& time = set.time;
  for (std::size_t i = 1; i < time.size() && faults.size() < kMostFaults; ++i) {
    const double got = time[i] - time[i - 1];
    const double unit = rounding.near(time[i]);
    const double rounded = is_multiple(step, unit) ? 0.0 : unit;
    if (std::abs(got - step) <= rounded + kStepTolerance * step) continue;
    if (got == 0.0) {
      faults.push_back(fault_at(set, i, fmt::format("time {} s is repeated", time[i])));
    } else if (got < 0.0) {
      faults.push_back(
          fault_at(set, i, fmt::format("time goes back from {} to {} s", time[i - 1], time[i])));
    } else {
      faults.push_back(
          fault_at(set, i,
                   fmt::format("time goes from {} to {} s, the usual step is {:.6g} s: samples are "
                               "missing or not evenly spaced",
                               time[i - 1], time[i], step)));
    }
  }
}

/// The step that is meant: gaps and repetitions make the mean one a wrong measure of it. Where nine
/// in ten steps are alike it is theirs; where rounding makes them differ, the mean.
double find_step(const std::vector<double>& time, double mean, double coarsest) {
  std::vector<double> steps(time.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = time[i + 1] - time[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double median = *middle;
  if (!(median > 0.0)) return mean;
  if (median > 4.0 * coarsest) return median;
  const auto alike = std::count_if(steps.begin(), steps.end(), [&](double step) {
    return std::abs(step - median) <= kStepTolerance * median;
  });
  return 10 * static_cast<std::size_t>(alike) >= 9 * steps.size() ? median : mean;
}

void check_numbers(const ChannelSet& set) {
  std::vector<core::Fault> faults;
  for (std::size_t i = 0; i < set.time.size() && faults.size() < kMostFaults; ++i) {
    if (!std::isfinite(set.time[i])) {
      faults.push_back(fault_at(set, i, fmt::format("time {} is no number", set.time[i])));
    }
  }
  if (!faults.empty()) throw core::InputError(std::move(faults));
}

void warn(double a, const char* of_a, double b, const char* of_b, const char* taken,
          std::vector<std::string>& warnings) {
  if (std::abs(a - b) <= kRateTolerance * std::abs(a)) return;
  warnings.push_back(
      fmt::format("{} {:.7g} Hz, {} {:.7g} Hz: {} is taken", of_a, a, of_b, b, taken));
}

}  // namespace

std::string place_of(const ChannelSet& set, std::size_t sample) {
  const int line = set.line_of(sample);
  return line > 0 ? fmt::format("line {}", line) : fmt::format("sample {}", sample);
}

TimeAxis fit_time_axis(const ChannelSet& set, std::optional<double> expected_rate) {
  const std::vector<double>& time = set.time;
  if (time.size() < 2) throw core::InputError({set.source, 0}, "has fewer than two times");
  check_numbers(set);
  const Rounding rounding(time);
  const double duration = time.back() - time.front();
  const double mean = duration / static_cast<double>(time.size() - 1);
  const double coarsest = std::max(rounding.near(time.front()), rounding.near(time.back()));
  const double tolerance = 1e-9 + 1.01 * coarsest / duration;
  const bool expected =
      expected_rate && duration > 0.0 && std::abs(*expected_rate * mean - 1.0) <= tolerance;
  const double step = expected ? 1.0 / *expected_rate : find_step(time, mean, coarsest);
  std::vector<core::Fault> faults;
  if (!(step > 0.0)) faults.push_back(fault_at(set, 0, "time does not go on"));
  if (faults.empty()) check_steps(set, rounding, step, faults);
  for (std::size_t i = 0; i < time.size() && faults.empty(); ++i) {
    const double even = time.front() + static_cast<double>(i) * mean;
    if (std::abs(time[i] - even) > coarsest + 0.5 * mean) {
      faults.push_back(fault_at(
          set, i,
          fmt::format("time {} s, evenly spaced samples would be at {:.9g} s: the sampling "
                      "rate is not constant",
                      time[i], even)));
    }
  }
  if (!faults.empty()) throw core::InputError(std::move(faults));
  return {time.front(), expected ? *expected_rate : round_rate(1.0 / mean, tolerance)};
}

TimeAxis find_time_axis(const ChannelSet& set, std::optional<double> given_rate,
                        std::vector<std::string>& warnings) {
  const core::Place place{set.source, 0};
  if (given_rate && !(std::isfinite(*given_rate) && *given_rate > 0.0)) {
    throw core::InputError(place, fmt::format("sampling_rate_Hz = {} must be > 0", *given_rate));
  }
  TimeAxis axis{set.start, 0.0};
  if (!set.time.empty()) {
    axis = fit_time_axis(set, given_rate ? given_rate : set.sampling_rate);
    if (set.sampling_rate) {
      warn(*set.sampling_rate, "the header says", axis.sampling_rate, "the time column is at",
           given_rate ? "neither" : "the time column", warnings);
      // Of two that agree the header's is not rounded.
      const double difference = std::abs(*set.sampling_rate - axis.sampling_rate);
      if (difference <= kRateTolerance * axis.sampling_rate)
        axis.sampling_rate = *set.sampling_rate;
    }
  } else if (set.sampling_rate) {
    axis.sampling_rate = *set.sampling_rate;
  }
  if (given_rate) {
    if (axis.sampling_rate > 0.0) {
      warn(*given_rate, "sampling_rate_Hz =", axis.sampling_rate, "the file says", "the given one",
           warnings);
    }
    axis.sampling_rate = *given_rate;
  }
  if (!(axis.sampling_rate > 0.0)) {
    throw core::InputError(place,
                           "says no sampling rate and has no time column: give sampling_rate_Hz");
  }
  return axis;
}

}  // namespace millstudy::identify
