// SPDX-License-Identifier: MIT
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <tbb/global_control.h>

#include "cli/commands.h"
#include "cli/fit_outputs.h"
#include "cli/fit_table.h"
#include "cli/provenance.h"
#include "cli/stop_signal.h"
#include "core/parallel_items.h"
#include "core/units.h"
#include "identify/choose_model.h"
#include "identify/conditioning.h"
#include "identify/prepare_trace.h"
#include "io/fit_result.h"
#include "io/sha256.h"
#include "io/text_file.h"
#include "io/toml_reader.h"
#include "io/trace_file.h"
#include "study/fit_file.h"

namespace millstudy::cli {
namespace {

namespace fs = std::filesystem;

/// Forces on the tool from the file of a record.
identify::PreparedTrace read_trace(const study::TraceSource& source, const std::string& folder) {
  io::TraceSelection selection;
  selection.variables = source.variables;
  selection.point = source.point;
  selection.segment = source.segment;
  const std::string path = (fs::path(folder) / source.file).string();
  const io::TraceFile file = io::read_trace_file(path, selection);
  identify::TraceOptions options;
  options.axes = identify::parse_axis_map(source.axes, source.axes_place);
  options.sampling_rate = source.sampling_rate;
  if (source.window) options.window = {(*source.window)[0], (*source.window)[1]};
  options.units = source.units;
  options.sensitivity_N_per_V = source.sensitivity_N_per_V;
  return identify::prepare_trace(file.channels, options);
}

/// All records; faults of every file, not only of the first.
std::vector<identify::Record> read_records(const study::FitFile& fit, const std::string& folder,
                                           std::vector<std::string>& warnings) {
  std::vector<identify::Record> records;
  std::vector<core::Fault> faults;
  std::map<std::string, std::vector<std::string>> told;  // records by what is odd about them
  for (const study::FitRecord& record : fit.records) {
    try {
      identify::PreparedTrace prepared = read_trace(record.source, folder);
      for (const std::string& warning : prepared.warnings) told[warning].push_back(record.name);
      const double speed = core::kTurn * record.cut.cut.spindle_speed;
      identify::Trace& trace = prepared.trace;
      if (record.source.offset_from_air) identify::remove_air_offset(trace, speed);
      if (record.source.cutting_only) {
        trace = identify::part_of(trace, identify::cutting_part(trace, speed));
      }
      records.push_back({record.name, std::move(trace), study::engagement(record.cut),
                         study::feed_rate(record.cut), speed});
      for (std::string& words : identify::look_over(fit.cutter, records.back())) {
        warnings.push_back(std::move(words));
      }
    } catch (const core::InputError& error) {
      for (core::Fault fault : error.faults()) {
        if (fault.place.file.empty()) fault.place = record.source.place;
        faults.push_back(std::move(fault));
      }
    } catch (const core::CaseError& error) {
      faults.push_back({record.place, error.what()});
    }
  }
  if (!faults.empty()) throw core::InputError(faults);
  for (const auto& [warning, names] : told) {
    const bool all = names.size() == records.size() && names.size() > 1;
    warnings.push_back(fmt::format(
        "{}: {}", all ? "all records" : fmt::format("{}", fmt::join(names, ", ")), warning));
  }
  return records;
}

/// Estimates that all records share.
std::vector<identify::Estimate> shared_of(const std::vector<identify::Estimate>& all) {
  std::vector<identify::Estimate> shared;
  for (const identify::Estimate& e : all) {
    if (e.record < 0) shared.push_back(e);
  }
  return shared;
}

int interrupted() {
  fmt::print(stderr, "interrupted: nothing was written\n");
  return kInterrupted;
}

}  // namespace

int fit(const FitOptions& options) {
  const std::string text = io::read_text(options.file);
  const core::Value root = io::parse_toml(text, options.file);
  const study::FitFile file = study::read_fit_file(root, io::read_toml);
  const std::string folder = fs::path(options.file).parent_path().string();
  const auto [output, coefficients] = fit_outputs(options, file, folder);
  std::vector<std::string> warnings;
  const std::atomic<bool>& stop = stop_on_signal();
  const std::vector<identify::Record> records = read_records(file, folder, warnings);
  if (stop) return interrupted();

  const int threads = options.threads > 0 ? options.threads : core::available_threads();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  io::FitReport report;
  report.records = &records;
  identify::AverageFit average;
  identify::ModelChoice choice;
  FitTable table{file, records};
  if (file.method == study::FitMethod::average) {
    average = identify::average_fit(file.cutter, records);
    report.average = table.average = &average;
    report.estimates = average.estimates;
    report.covariance = average.covariance;
    report.correlation = average.correlation;
    report.condition_number = average.condition_number;
    warnings.insert(warnings.end(), average.warnings.begin(), average.warnings.end());
  } else {
    identify::FitSettings settings = file.settings;
    settings.stop = &stop;
    if (!options.quiet) {
      settings.progress = [](int iteration, double residual) {
        fmt::print(stderr, "iteration {:3}: root mean square residual {:.4g} N\n", iteration,
                   residual);
      };
    }
    try {
      if (file.choose_model) {
        choice = identify::choose_model(file.cutter, records, settings);
      } else {
        choice.best = identify::fit(file.cutter, records, settings);
      }
    } catch (const identify::Stopped&) {
      return interrupted();
    }
    report.fit = table.fit = &choice.best;
    report.estimates = shared_of(choice.best.estimates);
    report.covariance = choice.best.covariance;
    report.correlation = choice.best.correlation;
    report.condition_number = choice.best.condition_number;
    if (!choice.reason.empty()) warnings.push_back(choice.reason);
    warnings.insert(warnings.end(), choice.best.warnings.begin(), choice.best.warnings.end());
  }
  table.estimates = report.estimates;
  table.condition_number = report.condition_number;
  table.words = warnings;

  report.attributes = {
      {"title", file.description.empty() ? file.name : file.description},
      {"name", file.name},
      {"kind", std::string("fit")},
      {"method", std::string(report.average ? "average" : "instantaneous")},
      {"schema_version", std::int64_t{1}},
      {"fit", text},
      {"fit_hash", io::sha256_hex(text)},
  };
  if (report.fit) {
    report.attributes.push_back({"model", identify::name_of(report.fit->settings.model)});
    report.attributes.push_back({"converged", std::int64_t{report.fit->converged}});
    report.attributes.push_back({"iterations", std::int64_t{report.fit->iterations}});
    report.attributes.push_back({"cost_N2", report.fit->cost});
    report.attributes.push_back({"solver_summary", report.fit->summary});
    report.attributes.push_back({"prediction_error", report.fit->prediction_error});
  }
  std::string remarks;
  for (const std::string& warning : warnings) remarks += warning + '\n';
  report.attributes.push_back({"remarks", remarks});
  for (sweep::Attribute& attribute : provenance(threads)) {
    report.attributes.push_back(std::move(attribute));
  }
  io::write_fit_result(output, report);
  io::write_text_file(coefficients, coefficients_toml(table, output));
  if (options.json) {
    fmt::print("{}\n", fit_json(table, output, coefficients));
  } else {
    fmt::print("{}", fit_text(table));
    fmt::print("\nresult: {}\ncoefficients: {}\n", output, coefficients);
  }
  return kDone;
}

}  // namespace millstudy::cli
