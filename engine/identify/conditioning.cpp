// SPDX-License-Identifier: MIT
#include "identify/conditioning.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/core.h>
#include <numeric>

#include "core/error.h"
#include "core/units.h"
#include "identify/fit_start.h"
#include "identify/spindle_speed.h"
#include "identify/synchronous_average.h"

namespace millstudy::identify {
namespace {

double samples_per_turn(const Trace& trace, double spindle_speed) {
  return core::kTurn / spindle_speed * trace.sampling_rate;
}

/// Reorders its argument.
double median(std::vector<double>& values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

/// How much the forces vary over each whole revolution: variances of the axes, added.
std::vector<double> variations(const Trace& trace, double per_turn) {
  std::vector<double> out;
  for (double from = 0.0; from + per_turn <= static_cast<double>(trace.size()); from += per_turn) {
    const auto first = static_cast<std::size_t>(from);
    const auto last = static_cast<std::size_t>(from + per_turn);
    double sum = 0.0;
    for (const std::vector<double>& force : trace.force) {
      if (force.empty()) continue;
      double mean = 0.0, squares = 0.0;
      for (std::size_t i = first; i < last; ++i) mean += force[i];
      mean /= static_cast<double>(last - first);
      for (std::size_t i = first; i < last; ++i) squares += (force[i] - mean) * (force[i] - mean);
      sum += squares / static_cast<double>(last - first);
    }
    out.push_back(sum);
  }
  return out;
}

/// Amplitudes squared of the harmonics 1, 2, ... of one revolution, axes added.
std::vector<double> harmonic_powers(const Trace& turn) {
  const auto bins = static_cast<int>(turn.size());
  std::vector<double> powers(std::min(bins / 2, 60), 0.0);
  for (const std::vector<double>& force : turn.force) {
    if (force.empty()) continue;
    for (std::size_t k = 0; k < powers.size(); ++k) {
      std::complex<double> sum = 0.0;
      for (int i = 0; i < bins; ++i) {
        const double angle = core::kTurn * static_cast<double>((k + 1) * i % bins) / bins;
        sum += force[i] * std::complex<double>(std::cos(angle), -std::sin(angle));
      }
      powers[k] += std::norm(sum) / bins;
    }
  }
  return powers;
}

/// Part of the power in multiples of a number of passes.
double share_of(const std::vector<double>& powers, int passes) {
  double part = 0.0, all = 0.0;
  for (std::size_t k = 0; k < powers.size(); ++k) {
    all += powers[k];
    if (static_cast<int>(k + 1) % passes == 0) part += powers[k];
  }
  return all > 0.0 ? part / all : 0.0;
}

std::string flute_words(const Record& record, const std::vector<double>& powers, int flutes) {
  constexpr int kMostFlutes = 12;
  constexpr double kNearlyAll = 0.97, kFew = 0.2;
  int repeats = 1;
  for (int n = 2; n <= kMostFlutes; ++n) {
    if (share_of(powers, n) > kNearlyAll) repeats = n;
  }
  const bool other =
      flutes % repeats != 0 || (repeats > 1 && repeats < flutes && share_of(powers, flutes) < kFew);
  if (!other) return "";
  return fmt::format(
      "{}: the forces repeat {} times a revolution, the cutter has {} flute{}: is their number "
      "right, "
      "and do all of them cut?",
      record.name, repeats, flutes, flutes == 1 ? "" : "s");
}

/// (I43): against the median revolution, which spikes do not move.
std::string spike_words(const Record& record, int bins, double spindle_speed) {
  const Trace& trace = record.trace;
  const double per_turn = samples_per_turn(trace, spindle_speed);
  const double middle = 0.5 * static_cast<double>(trace.size() - 1);
  std::vector<int> bin_of(trace.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const double turns = (static_cast<double>(i) - middle) / per_turn;
    bin_of[i] = std::min(bins - 1, static_cast<int>((turns - std::floor(turns)) * bins));
  }
  std::size_t spikes = 0, first = trace.size();
  for (const std::vector<double>& force : trace.force) {
    if (force.empty()) continue;
    std::vector<std::vector<double>> in_bin(static_cast<std::size_t>(bins));
    for (std::size_t i = 0; i < force.size(); ++i) {
      in_bin[static_cast<std::size_t>(bin_of[i])].push_back(force[i]);
    }
    std::vector<double> medians;
    double low = INFINITY, high = -INFINITY;
    for (std::vector<double>& values : in_bin) {
      medians.push_back(values.empty() ? 0.0 : median(values));
      if (values.empty()) continue;
      low = std::min(low, medians.back());
      high = std::max(high, medians.back());
    }
    std::vector<double> off(force.size());
    for (std::size_t i = 0; i < off.size(); ++i) {
      off[i] = std::abs(force[i] - medians[static_cast<std::size_t>(bin_of[i])]);
    }
    std::vector<double> sorted = off;
    constexpr double kNormal = 1.4826, kFar = 12.0;  // deviations: never of normal noise
    constexpr double kRange = 0.5;                   // of the force: steep edges spread in a bin
    const double limit = std::max(kFar * kNormal * median(sorted), kRange * (high - low));
    for (std::size_t i = 0; i < off.size(); ++i) {
      if (!(off[i] > limit)) continue;
      ++spikes;
      first = std::min(first, i);
    }
  }
  if (spikes == 0) return "";
  return fmt::format(
      "{}: {} sample{} far off the median revolution, the first at {:.6g} s: spikes? fit.loss = "
      "\"huber\" holds against them",
      record.name, spikes, spikes == 1 ? " is" : "s are",
      trace.start + static_cast<double>(first) / trace.sampling_rate);
}

/// Axes in another order and with other signs.
struct SignedOrder {
  std::array<int, 3> axis;
  std::array<double, 3> sign;
};

std::vector<SignedOrder> signed_orders() {
  std::vector<SignedOrder> all;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      all.push_back(
          {order, {signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0}});
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

/// (I45)
std::string axis_words(const cutter::Cutter& cutter, const Record& record, const Trace& turn,
                       double spindle_speed) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!turn.has_axis(axis)) return "";
  }
  Record mean = record;
  mean.spindle_speed = spindle_speed;
  const auto unexplained = [&](const SignedOrder& order) {
    mean.trace = turn;
    for (int axis = 0; axis < 3; ++axis) {
      mean.trace.force[axis] = turn.force[order.axis[axis]];
      for (double& f : mean.trace.force[axis]) f *= order.sign[axis];
    }
    return unexplained_part(cutter, mean);
  };
  const double given = unexplained({{0, 1, 2}, {1.0, 1.0, 1.0}});
  SignedOrder best{};
  constexpr double kBad = 0.3, kBetter = 0.4;
  if (given < kBad) return "";
  double least = given;
  for (const SignedOrder& order : signed_orders()) {
    const double part = unexplained(order);
    if (part < least) least = part, best = order;
  }
  if (least > kBetter * given) return "";
  std::string map;
  for (int axis = 0; axis < 3; ++axis) {
    map += fmt::format("{}{} = {}{}", axis == 0 ? "" : ", ", kAxisNames[axis],
                       best.sign[axis] < 0.0 ? "-" : "", kAxisNames[best.axis[axis]]);
  }
  return fmt::format(
      "{}: the mean revolution is described far better with other axes, {} of those given ({:.0f} "
      "% "
      "unexplained against {:.0f} %): is trace.axes right?",
      record.name, map, 100.0 * least, 100.0 * given);
}

}  // namespace

Part cutting_part(const Trace& trace, double spindle_speed) {
  const double per_turn = samples_per_turn(trace, spindle_speed);
  const std::vector<double> all = variations(trace, per_turn);
  std::vector<double> sorted = all;
  std::sort(sorted.begin(), sorted.end());
  std::size_t best_from = 0, best = 0;
  if (!sorted.empty()) {
    const double strong = sorted[sorted.size() - 1 - sorted.size() / 20];
    constexpr double kCuts = 0.25;  // of the variance: half of the amplitude
    for (std::size_t from = 0; from < all.size();) {
      std::size_t to = from;
      while (to < all.size() && all[to] >= kCuts * strong) ++to;
      if (to - from > best) best = to - from, best_from = from;
      from = std::max(to, from + 1);
    }
  }
  const bool whole = best == all.size();  // it cuts from end to end: nothing to leave out
  if (!whole && best < 3) {
    throw core::InputError(
        fmt::format("{}: less than three revolutions of steady cutting were found", trace.source));
  }
  if (whole) return {0, trace.size()};
  const auto first =
      static_cast<std::size_t>(std::ceil(static_cast<double>(best_from + 1) * per_turn));
  const auto last = static_cast<std::size_t>(static_cast<double>(best_from + best - 1) * per_turn);
  return {first, last - first};
}

Trace part_of(const Trace& trace, const Part& part) {
  Trace out = trace;
  out.start += static_cast<double>(part.first) / trace.sampling_rate;
  for (std::vector<double>& force : out.force) {
    if (force.empty()) continue;
    const auto from = force.begin() + static_cast<std::ptrdiff_t>(part.first);
    force = std::vector<double>(from, from + static_cast<std::ptrdiff_t>(part.count));
  }
  return out;
}

void remove_air_offset(Trace& trace, double spindle_speed) {
  const Part cut = cutting_part(trace, spindle_speed);
  const double per_turn = samples_per_turn(trace, spindle_speed);
  // Two revolutions next to the cut are left out: the tool enters and leaves in them.
  const auto guard = static_cast<std::size_t>(2.0 * per_turn);
  const std::size_t before = cut.first > guard ? cut.first - guard : 0;
  const std::size_t after = std::min(trace.size(), cut.first + cut.count + guard);
  const auto least = static_cast<std::size_t>(0.5 * per_turn);
  const bool has_before = before >= least, has_after = trace.size() - after >= least;
  if (!has_before && !has_after) {
    throw core::InputError(fmt::format(
        "{}: no air cutting was recorded to take the offset from: record some before the cut, or "
        "estimate the offset",
        trace.source));
  }
  for (std::vector<double>& force : trace.force) {
    if (force.empty()) continue;
    const auto mean = [&](std::size_t from, std::size_t to) {
      return std::accumulate(force.begin() + static_cast<std::ptrdiff_t>(from),
                             force.begin() + static_cast<std::ptrdiff_t>(to), 0.0) /
             static_cast<double>(to - from);
    };
    const double first = has_before ? mean(0, before) : mean(after, force.size());
    const double last = has_after ? mean(after, force.size()) : first;
    const double t1 = 0.5 * (static_cast<double>(before) - 1.0);
    const double t2 = 0.5 * (static_cast<double>(after + force.size()) - 1.0);
    const double slope = has_before && has_after ? (last - first) / (t2 - t1) : 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
      force[i] -= first + slope * (static_cast<double>(i) - t1);
    }
  }
}

std::vector<std::string> look_over(const cutter::Cutter& cutter, const Record& record) {
  const double nominal_turn = samples_per_turn(record.trace, record.spindle_speed);
  if (static_cast<double>(record.trace.size()) < nominal_turn) {
    throw core::InputError(
        fmt::format("{}: {} samples are less than one revolution of the spindle ({:.0f})",
                    record.name, record.trace.size(), nominal_turn));
  }
  const SpindleSpeed speed = estimate_spindle_speed(record.trace, record.spindle_speed);
  const Trace turn = synchronous_average(record.trace, speed.value);
  const double bins = static_cast<double>(turn.size());
  const double samples = static_cast<double>(record.trace.size());
  // Of noise, averaging leaves one part in as many revolutions.
  if (speed.share < std::max(0.02, 4.0 * bins / samples)) {
    throw core::InputError(fmt::format(
        "{}: no force repeats with the spindle at {:.4g} rpm: was the tool cutting, and is "
        "cut.spindle_speed_rpm right?",
        record.name, 30.0 / core::kPi * record.spindle_speed));
  }
  std::vector<std::string> words;
  const auto say = [&](std::string text) {
    if (!text.empty()) words.push_back(std::move(text));
  };
  say(flute_words(record, harmonic_powers(turn), cutter.flutes));
  say(spike_words(record, static_cast<int>(turn.size()), speed.value));
  say(axis_words(cutter, record, turn, speed.value));
  return words;
}

}  // namespace millstudy::identify
