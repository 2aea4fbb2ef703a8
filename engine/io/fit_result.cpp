// SPDX-License-Identifier: MIT
#include "io/fit_result.h"

#include <cstring>
#include <fmt/core.h>
#include <functional>
#include <limits>
#include <variant>

#include "core/resource_error.h"
#include "core/units.h"
#include "io/atomic_file.h"
#include "io/hdf5.h"
#include "io/hdf5_output.h"
#include "io/hdf5_text.h"

namespace millstudy::io {
namespace {

using identify::Record;

/// Variables of one file, each with its dimensions, unit and meaning.
class Variables {
 public:
  explicit Variables(hid_t file) : file_(file) {}

  /// A dimension whose scale is a variable of texts.
  void add_labels(const std::string& name, const std::vector<std::string>& labels,
                  const std::string& meaning) {
    hdf5::Handle dataset = hdf5::create_texts(file_, name, labels);
    hdf5::make_scale(dataset.get(), name);
    hdf5::write_attribute(dataset.get(), "long_name", meaning);
    scales_.emplace_back(name, std::move(dataset));
  }

  /// A dimension whose scale counts from 0.
  void add_count(const std::string& name, std::int64_t length, const std::string& meaning) {
    hdf5::Handle dataset = hdf5::create_dataset(file_, name, H5T_STD_I64LE, {length});
    std::vector<std::int64_t> numbers(static_cast<std::size_t>(length));
    for (std::int64_t i = 0; i < length; ++i) numbers[static_cast<std::size_t>(i)] = i;
    hdf5::write_range(dataset.get(), H5T_NATIVE_INT64, {length}, 0, length, numbers.data());
    hdf5::make_scale(dataset.get(), name);
    hdf5::write_attribute(dataset.get(), "long_name", meaning);
    scales_.emplace_back(name, std::move(dataset));
  }

  void add(const std::string& name, const std::vector<std::string>& dimensions, const Shape& shape,
           const std::vector<double>& values, const std::string& units,
           const std::string& meaning) {
    hdf5::DatasetOptions options;
    options.fill = std::numeric_limits<double>::quiet_NaN();
    options.fill_is_missing = true;
    hdf5::Handle dataset = hdf5::create_dataset(file_, name, H5T_IEEE_F64LE, shape, options);
    const auto count = static_cast<std::int64_t>(values.size());
    hdf5::write_range(dataset.get(), H5T_NATIVE_DOUBLE, shape, 0, count, values.data());
    finish(dataset.get(), dimensions, units, meaning);
  }

  void add_integers(const std::string& name, const std::string& dimension,
                    const std::vector<std::int64_t>& values, const std::string& meaning,
                    const std::string& sample_dimension) {
    const auto count = static_cast<std::int64_t>(values.size());
    hdf5::Handle dataset = hdf5::create_dataset(file_, name, H5T_STD_I64LE, {count});
    hdf5::write_range(dataset.get(), H5T_NATIVE_INT64, {count}, 0, count, values.data());
    if (!sample_dimension.empty()) {
      hdf5::write_attribute(dataset.get(), "sample_dimension", sample_dimension);
    }
    finish(dataset.get(), {dimension}, "1", meaning);
  }

  void add_texts(const std::string& name, const std::string& dimension,
                 const std::vector<std::string>& values, const std::string& meaning) {
    const hdf5::Handle dataset = hdf5::create_texts(file_, name, values);
    attach(dataset.get(), {dimension});
    hdf5::write_attribute(dataset.get(), "long_name", meaning);
  }

 private:
  void finish(hid_t dataset, const std::vector<std::string>& dimensions, const std::string& units,
              const std::string& meaning) {
    attach(dataset, dimensions);
    hdf5::write_attribute(dataset, "units", units);
    hdf5::write_attribute(dataset, "long_name", meaning);
  }

  void attach(hid_t dataset, const std::vector<std::string>& dimensions) {
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
      for (const auto& [name, scale] : scales_) {
        if (name == dimensions[d]) hdf5::attach_scale(dataset, scale.get(), d);
      }
    }
  }

  hid_t file_;
  std::vector<std::pair<std::string, hdf5::Handle>> scales_;
};

void write_estimates(Variables& file, const FitReport& report) {
  std::vector<std::string> names, units;
  std::vector<double> values, standard, naive, jackknife, low, high;
  std::vector<double> bootstrap, bootstrap_low, bootstrap_high;
  for (const identify::Estimate& e : report.estimates) {
    names.push_back(e.name);
    units.push_back(e.unit);
    values.push_back(e.value);
    standard.push_back(e.standard_error);
    naive.push_back(e.naive_error);
    jackknife.push_back(e.jackknife_error);
    bootstrap.push_back(e.bootstrap_error);
    bootstrap_low.push_back(e.bootstrap_low);
    bootstrap_high.push_back(e.bootstrap_high);
    low.push_back(e.confidence_low);
    high.push_back(e.confidence_high);
  }
  const auto n = static_cast<std::int64_t>(names.size());
  const std::string name = "coefficient_name";
  file.add_labels(name, names, "coefficients and what else all records share");
  file.add_labels("other_name", names, "the same names, for covariance and correlation");
  file.add("coefficient", {name}, {n}, values, "1", "value, in coefficient_unit");
  file.add_texts("coefficient_unit", name, units, "unit of coefficient and its errors");
  file.add("standard_error", {name}, {n}, standard, "1",
           "standard error under correlated residuals, in coefficient_unit");
  file.add("naive_error", {name}, {n}, naive, "1",
           "standard error if residuals were white, in coefficient_unit");
  file.add("jackknife_error", {name}, {n}, jackknife, "1",
           "standard error by leaving out each record, in coefficient_unit");
  if (!bootstrap.empty() && std::isfinite(bootstrap.front())) {
    file.add("bootstrap_error", {name}, {n}, bootstrap, "1",
             "standard error by bootstrap over revolutions, in coefficient_unit");
    file.add("bootstrap_low", {name}, {n}, bootstrap_low, "1", "2.5 % of the bootstrap samples");
    file.add("bootstrap_high", {name}, {n}, bootstrap_high, "1", "97.5 % of the bootstrap samples");
  }
  file.add("confidence_low", {name}, {n}, low, "1", "95 % interval, lower end");
  file.add("confidence_high", {name}, {n}, high, "1", "95 % interval, upper end");
  file.add("covariance", {name, "other_name"}, {n, n}, report.covariance, "1",
           "covariance of the estimates, in the product of their units");
  file.add("correlation", {name, "other_name"}, {n, n}, report.correlation, "1",
           "correlation of the estimates");
  file.add("condition_number", {}, {}, {report.condition_number}, "1",
           "condition number of the coefficients' columns at unit length");
}

/// One number for each record.
void write_per_record(Variables& file, std::size_t records, const std::string& name,
                      const std::string& units, const std::string& meaning,
                      const std::function<double(std::size_t)>& value) {
  std::vector<double> values;
  for (std::size_t r = 0; r < records; ++r) values.push_back(value(r));
  file.add(name, {"record"}, {static_cast<std::int64_t>(records)}, values, units, meaning);
}

void write_records(Variables& file, const identify::FitResult& fit) {
  const std::size_t n = fit.records.size();
  const auto& r = fit.records;
  const auto number = [&](const char* name, const char* units, const char* meaning,
                          const std::function<double(std::size_t)>& value) {
    write_per_record(file, n, name, units, meaning, value);
  };
  number("phase", "degree", "immersion angle of flute 0's tip at the first sample",
         [&](std::size_t i) { return core::deg_from_rad(r[i].phase); });
  number("spindle_speed", "rpm", "actual spindle speed",
         [&](std::size_t i) { return 30.0 / core::kPi * r[i].spindle_speed; });
  number("feed_per_tooth", "mm", "feed per tooth at that speed",
         [&](std::size_t i) { return r[i].feed_per_tooth; });
  number("runout_offset", "mm", "distance of the axes of cutter and spindle",
         [&](std::size_t i) { return r[i].runout.offset; });
  number("runout_angle", "degree", "where the offset points, from the tip of flute 0",
         [&](std::size_t i) { return core::deg_from_rad(r[i].runout.angle); });
  for (int axis = 0; axis < 3; ++axis) {
    const std::string x(identify::kAxisNames[axis]);
    const auto of_axis = [&](const std::string& name, const char* units, const std::string& meaning,
                             const std::function<double(std::size_t)>& value) {
      write_per_record(file, n, name + x, units, meaning + " along " + x, value);
    };
    of_axis("offset_", "N", "offset of the signal at the middle of the record",
            [&](std::size_t i) { return r[i].offset[axis]; });
    of_axis("drift_", "N s-1", "drift of the signal",
            [&](std::size_t i) { return r[i].drift[axis]; });
    of_axis("r_squared_", "1", "coefficient of determination",
            [&](std::size_t i) { return r[i].agreement.r_squared[axis]; });
    of_axis("rmse_", "N", "root mean square error",
            [&](std::size_t i) { return r[i].agreement.rmse[axis]; });
    if (fit.left_out.empty()) continue;
    of_axis("left_out_r_squared_", "1",
            "coefficient of determination by the coefficients of the other records",
            [&](std::size_t i) { return fit.left_out[i].r_squared[axis]; });
  }
  const std::size_t knots = r.front().phase_drift.size();
  if (knots == 0) return;
  std::vector<double> drift;
  for (const identify::RecordFit& record : r) {
    for (const double angle : record.phase_drift) drift.push_back(core::deg_from_rad(angle));
  }
  file.add_count("knot", static_cast<std::int64_t>(knots), "even parts of the record");
  file.add("phase_drift", {"record", "knot"},
           {static_cast<std::int64_t>(n), static_cast<std::int64_t>(knots)}, drift, "degree",
           "spindle angle less that of an even turn");
}

void write_averages(Variables& file, const identify::AverageFit& average) {
  const std::size_t n = average.records.size();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string x(identify::kAxisNames[axis]);
    write_per_record(file, n, "mean_force_" + x, "N", "measured mean force along " + x,
                     [&](std::size_t i) { return average.records[i].mean[axis]; });
    write_per_record(file, n, "predicted_mean_force_" + x, "N",
                     "mean force along " + x + " by the coefficients",
                     [&](std::size_t i) { return average.records[i].predicted[axis]; });
    file.add("r_squared_" + x, {}, {}, {average.r_squared[axis]}, "1",
             "coefficient of determination of the mean forces along " + x);
  }
  write_per_record(file, n, "revolutions", "1", "whole revolutions that were averaged",
                   [&](std::size_t i) { return average.records[i].revolutions; });
}

/// Measured and predicted forces of all records, one after the other (CF contiguous ragged array).
void write_traces(Variables& file, const FitReport& report) {
  const std::vector<Record>& records = *report.records;
  std::vector<std::int64_t> starts, counts;
  std::vector<double> time;
  std::int64_t total = 0;
  for (const Record& record : records) {
    starts.push_back(total);
    counts.push_back(static_cast<std::int64_t>(record.trace.size()));
    total += counts.back();
    for (std::size_t i = 0; i < record.trace.size(); ++i) {
      time.push_back(record.trace.start + static_cast<double>(i) / record.trace.sampling_rate);
    }
  }
  file.add_count("sample", total, "samples of all records, one record after the other");
  file.add_integers("trace_start", "record", starts, "first sample of the record", "");
  file.add_integers("trace_count", "record", counts, "samples of the record", "sample");
  file.add("time", {"sample"}, {total}, time, "s", "time on the clock of the record");
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> measured, predicted, residual;
    bool any = false;
    for (std::size_t r = 0; r < records.size(); ++r) {
      const std::size_t size = records[r].trace.size();
      const std::vector<double>& force = records[r].trace.force[axis];
      const std::vector<double> none(size, std::numeric_limits<double>::quiet_NaN());
      const std::vector<double>& m = force.empty() ? none : force;
      const std::vector<double>& p = report.fit && !report.fit->records[r].predicted[axis].empty()
                                         ? report.fit->records[r].predicted[axis]
                                         : none;
      any = any || !force.empty();
      measured.insert(measured.end(), m.begin(), m.end());
      predicted.insert(predicted.end(), p.begin(), p.end());
      for (std::size_t i = 0; i < size; ++i) residual.push_back(m[i] - p[i]);
    }
    if (!any) continue;
    const std::string x(identify::kAxisNames[axis]);
    file.add("measured_" + x, {"sample"}, {total}, measured, "N", "measured force along " + x);
    if (!report.fit) continue;
    file.add("predicted_" + x, {"sample"}, {total}, predicted, "N",
             "force along " + x + " by the model, with dynamometer and offset");
    file.add("residual_" + x, {"sample"}, {total}, residual, "N",
             "measured less predicted force along " + x);
  }
}

}  // namespace

void write_fit_result(const std::string& path, const FitReport& report) {
  AtomicFile target(path);
  hdf5::Output output{target.descriptor()};
  {
    const hdf5::QuietErrors quiet;
    try {
      const hdf5::Handle file = hdf5::create_file(output);
      hdf5::write_attribute(file.get(), "Conventions", std::string("CF-1.8"));
      for (const auto& [name, value] : report.attributes) {
        std::visit([&](const auto& v) { hdf5::write_attribute(file.get(), name, v); }, value);
      }
      Variables variables(file.get());
      write_estimates(variables, report);
      std::vector<std::string> names;
      for (const Record& record : *report.records) names.push_back(record.name);
      variables.add_labels("record", names, "records, by name");
      if (report.fit) write_records(variables, *report.fit);
      if (report.average) write_averages(variables, *report.average);
      write_traces(variables, report);
      hdf5::check(H5Fflush(file.get(), H5F_SCOPE_GLOBAL), "flush the file");
    } catch (const hdf5::Error& error) {
      if (output.error == 0) throw;
    }
  }
  if (output.error != 0) {
    throw core::ResourceError(
        fmt::format("{}: cannot be written: {}", path, std::strerror(output.error)));
  }
  target.commit();
}

}  // namespace millstudy::io
