// SPDX-License-Identifier: MIT
#include "identify/prepare_trace.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "core/error.h"
#include "identify/force_unit.h"
#include "identify/time_axis.h"

namespace millstudy::identify {
namespace {

constexpr std::size_t kMostFaults = 20;
// Saturation: that many samples in a row, and in all, are the largest or smallest of the channel.
constexpr std::size_t kClippedInARow = 3;
constexpr std::size_t kClipped = 8;

/// The value of a table by channel, or that for all channels.
template <class Value>
const Value* look_up(const std::map<std::string, Value>& table, const std::string& channel) {
  for (const std::string& key : {channel, std::string()}) {
    const auto found = table.find(key);
    if (found != table.end()) return &found->second;
  }
  return nullptr;
}

/// Makes a trace of a channel set; collects what is wrong on the way.
class Preparation {
 public:
  Preparation(const ChannelSet& set, const TraceOptions& options) : set_(set), options_(options) {}

  PreparedTrace run() {
    result_.warnings = set_.remarks;
    find_channels();
    throw_if_any();
    const TimeAxis axis = find_time_axis(set_, options_.sampling_rate, result_.warnings);
    find_window(axis);
    throw_if_any();
    Trace& trace = result_.trace;
    trace.source = set_.source;
    trace.sampling_rate = axis.sampling_rate;
    trace.start = axis.start + static_cast<double>(begin_) / axis.sampling_rate;
    for (int i = 0; i < 3; ++i) {
      if (channels_[i] != nullptr)
        trace.force[i] = forces(*channels_[i], options_.axes.axes[i].sign);
    }
    throw_if_any();
    check(trace);
    return std::move(result_);
  }

 private:
  void fault(std::string text, int line = 0) {
    if (faults_.size() < kMostFaults) faults_.push_back({{set_.source, line}, std::move(text)});
  }
  void throw_if_any() const {
    if (!faults_.empty()) throw core::InputError(faults_);
  }

  void find_channels() {
    std::string known;
    for (const Channel& channel : set_.channels) {
      known += (known.empty() ? "" : ", ") + channel.name;
    }
    bool any = false;
    for (int i = 0; i < 3; ++i) {
      if (!options_.axes.has_axis(i)) continue;
      const std::string& name = options_.axes.axes[i].channel;
      channels_[i] = set_.find(name);
      if (channels_[i] == nullptr) {
        fault(fmt::format("has no channel {} for axis {}; it has {}", name, kAxisNames[i], known));
        continue;
      }
      const std::size_t samples = channels_[i]->samples.size();
      if (!any) samples_ = samples;
      any = true;
      if (samples != samples_) {
        fault(fmt::format("channel {} has {} samples, another has {}", name, samples, samples_));
      }
    }
    if (!set_.time.empty() && samples_ != 0 && set_.time.size() != samples_) {
      fault(fmt::format("{} times for {} samples", set_.time.size(), samples_));
    }
    if (faults_.empty() && samples_ == 0) fault("has no samples");
  }

  /// Samples begin_ .. end_ - 1.
  void find_window(const TimeAxis& axis) {
    end_ = samples_;
    const double data_end = axis.start + static_cast<double>(samples_) / axis.sampling_rate;
    if (options_.window) {
      const auto [from, to] = *options_.window;
      const double slack = 1e-6 / axis.sampling_rate + 1e-12 * std::abs(data_end);
      if (!(std::isfinite(from) && std::isfinite(to) && from < to)) {
        return fault(
            fmt::format("window_s = [{}, {}] must go from a time to a later one", from, to));
      }
      if (from < axis.start - slack || to > data_end + slack) {
        return fault(
            fmt::format("window_s = [{}, {}] is not within the record, which goes from {} "
                        "to {:.9g} s",
                        from, to, axis.start, data_end));
      }
      begin_ = first_at(axis, from, slack);
      end_ = std::max(first_at(axis, to, slack), begin_);
    }
    if (end_ - begin_ < kFewestSamples) {
      fault(fmt::format("{} samples are too few: there must be at least {}", end_ - begin_,
                        kFewestSamples));
    } else if (end_ - begin_ > kMostSamples) {
      fault(fmt::format(
          "{} samples, {:.4g} s, are more than {}: take a part of them, by window_s = "
          "[from, to]; some hundred revolutions say all",
          end_ - begin_, static_cast<double>(end_ - begin_) / axis.sampling_rate, kMostSamples));
    }
  }

  /// First sample that is not before a time; samples_ where there is none.
  std::size_t first_at(const TimeAxis& axis, double time, double slack) const {
    const double index = std::ceil((time - axis.start - slack) * axis.sampling_rate);
    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(samples_)));
  }

  /// [N] per unit of a channel, with its sign.
  double factor(const Channel& channel) {
    const std::string* given = look_up(options_.units, channel.name);
    const std::string unit = given != nullptr ? *given : channel.unit;
    const double* sensitivity = look_up(options_.sensitivity_N_per_V, channel.name);
    if (unit.empty()) {
      result_.warnings.push_back(
          fmt::format("channel {} has no unit: it is taken as N", channel.name));
      return 1.0;
    }
    if (const std::optional<double> newtons = newtons_per(unit)) return *newtons;
    const std::optional<double> volts = volts_per(unit);
    if (!volts) {
      fault(fmt::format("channel {} has the unit \"{}\": a force is in {}; give its unit by a key",
                        channel.name, unit, kForceUnits));
      return 1.0;
    }
    if (sensitivity == nullptr) {
      fault(fmt::format("channel {} is in {}: give sensitivity_N_per_V", channel.name, unit));
      return 1.0;
    }
    if (!std::isfinite(*sensitivity) || *sensitivity == 0.0) {
      fault(fmt::format("sensitivity_N_per_V = {} of channel {} must be a number other than 0",
                        *sensitivity, channel.name));
      return 1.0;
    }
    return *volts * *sensitivity;
  }

  std::vector<double> forces(const Channel& channel, double sign) {
    const double scale = sign * factor(channel);
    std::vector<double> force;
    force.reserve(end_ - begin_);
    for (std::size_t i = begin_; i < end_; ++i) {
      const double value = channel.samples[i];
      if (!std::isfinite(value)) i = report_bad_run(channel, i);
      force.push_back(scale * value);
    }
    warn_of_extremes(channel);
    return force;
  }

  /// One fault for a run of samples that are no numbers; returns its last.
  std::size_t report_bad_run(const Channel& channel, std::size_t first) {
    std::size_t last = first;
    while (last + 1 < end_ && !std::isfinite(channel.samples[last + 1])) ++last;
    const std::string what =
        first == last ? fmt::format("is {}", channel.samples[first])
                      : fmt::format("is {} for {} samples, to {}", channel.samples[first],
                                    last - first + 1, place_of(set_, last));
    const int line = set_.line_of(first);
    fault(line > 0 ? fmt::format("channel {} {}", channel.name, what)
                   : fmt::format("channel {}, sample {}: {}", channel.name, first, what),
          line);
    return last;
  }

  /// Constant and clipped channels. A force is often exactly 0, out of cut: that is no clipping.
  void warn_of_extremes(const Channel& channel) {
    const auto begin = channel.samples.begin() + static_cast<std::ptrdiff_t>(begin_);
    const auto end = channel.samples.begin() + static_cast<std::ptrdiff_t>(end_);
    const auto [least, most] = std::minmax_element(begin, end);
    if (*least == *most) {
      result_.warnings.push_back(
          fmt::format("channel {} is {} throughout: is it connected?", channel.name, *least));
      return;
    }
    for (const double extreme : {*least, *most}) {
      std::size_t count = 0;
      std::size_t run = 0;
      std::size_t longest = 0;
      for (auto at = begin; at != end; ++at) {
        run = *at == extreme ? run + 1 : 0;
        count += *at == extreme ? 1 : 0;
        longest = std::max(longest, run);
      }
      if (extreme == 0.0 || count < kClipped || longest < kClippedInARow) continue;
      result_.warnings.push_back(fmt::format(
          "channel {} is {} in {:.3g} % of the samples, up to {} in a row, and never {}: is it "
          "clipped?",
          channel.name, extreme,
          100.0 * static_cast<double>(count) / static_cast<double>(end - begin), longest,
          extreme == *most ? "more" : "less"));
    }
  }

  const ChannelSet& set_;
  const TraceOptions& options_;
  PreparedTrace result_;
  std::vector<core::Fault> faults_;
  std::array<const Channel*, 3> channels_ = {};
  std::size_t samples_ = 0;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
};

}  // namespace

PreparedTrace prepare_trace(const ChannelSet& set, const TraceOptions& options) {
  return Preparation(set, options).run();
}

}  // namespace millstudy::identify
