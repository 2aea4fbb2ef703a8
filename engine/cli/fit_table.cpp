// SPDX-License-Identifier: MIT
#include "cli/fit_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "cli/version.h"
#include "core/units.h"

namespace millstudy::cli {
namespace {

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

/// As many decimals as an error of two digits needs.
int decimals(const identify::Estimate& e) {
  const double error =
      std::max(e.standard_error, std::isfinite(e.jackknife_error) ? e.jackknife_error : 0.0);
  if (!(error > 0.0)) return 4;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6);
}

double rpm(double spindle_speed) {
  return 30.0 / core::kPi * spindle_speed;
}

std::string record_lines(const FitTable& table) {
  std::size_t width = 6;
  for (const identify::Record& record : table.records) width = std::max(width, record.name.size());
  std::string text;
  if (table.average) {
    text += fmt::format("\n{:<{}}  {:>11}  {:>26}  {:>26}\n", "record", width, "revolutions",
                        "mean force x y z [N]", "by the coefficients [N]");
    for (std::size_t r = 0; r < table.records.size(); ++r) {
      const identify::RecordAverage& a = table.average->records[r];
      text += fmt::format("{:<{}}  {:>11.0f}  {:>8} {:>8} {:>8}  {:>8} {:>8} {:>8}\n",
                          table.records[r].name, width, a.revolutions, number(a.mean[0], 2),
                          number(a.mean[1], 2), number(a.mean[2], 2), number(a.predicted[0], 2),
                          number(a.predicted[1], 2), number(a.predicted[2], 2));
    }
    const auto& r2 = table.average->r_squared;
    text += fmt::format("R2 of the mean forces over the records: x {}, y {}, z {}\n",
                        number(r2[0], 3), number(r2[1], 3), number(r2[2], 3));
    return text;
  }
  const identify::FitResult& fit = *table.fit;
  const bool left_out = !fit.left_out.empty();
  text += fmt::format("\n{:<{}}  {:>9} {:>8} {:>9} {:>8}  {:>20}  {:>20}{}\n", "record", width,
                      "speed", "phase", "runout", "at", "R2 x y z", "RMSE x y z [N]",
                      left_out ? "     R2 if left out" : "");
  for (std::size_t r = 0; r < table.records.size(); ++r) {
    const identify::RecordFit& f = fit.records[r];
    text +=
        fmt::format("{:<{}}  {:>9} {:>8} {:>9} {:>8}  {:>6} {:>6} {:>6}  {:>6} {:>6} {:>6}",
                    table.records[r].name, width, fmt::format("{:.2f} rpm", rpm(f.spindle_speed)),
                    fmt::format("{:.1f} deg", core::deg_from_rad(f.phase)),
                    fmt::format("{:.1f} um", 1e3 * f.runout.offset),
                    fmt::format("{:.0f} deg", core::deg_from_rad(f.runout.angle)),
                    number(f.agreement.r_squared[0], 4), number(f.agreement.r_squared[1], 4),
                    number(f.agreement.r_squared[2], 4), number(f.agreement.rmse[0], 1),
                    number(f.agreement.rmse[1], 1), number(f.agreement.rmse[2], 1));
    if (left_out) {
      const auto& out = fit.left_out[r].r_squared;
      text += fmt::format("  {:>6} {:>6} {:>6}", number(out[0], 4), number(out[1], 4),
                          number(out[2], 4));
    }
    text += '\n';
  }
  if (left_out) {
    text += fmt::format("error of left-out records over the scatter of their forces: {:.2f} %\n",
                        100.0 * fit.prediction_error);
  }
  return text;
}

nlohmann::json json_number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace

std::string fit_text(const FitTable& table) {
  const std::size_t samples = [&] {
    std::size_t sum = 0;
    for (const identify::Record& record : table.records) sum += record.trace.size();
    return sum;
  }();
  std::string text =
      fmt::format("{}: {} record{}, {} samples\n\n", table.file.name, table.records.size(),
                  table.records.size() == 1 ? "" : "s", samples);
  text += fmt::format("{:<28} {:>12} {:<6} {:>10} {:>10}   {}\n", "", "value", "", "std error",
                      "jackknife", "95 % interval");
  for (const identify::Estimate& e : table.estimates) {
    const int d = decimals(e);
    text +=
        fmt::format("{:<28} {:>12} {:<6} {:>10} {:>10}   {} .. {}\n", e.name, number(e.value, d),
                    e.unit, number(e.standard_error, d), number(e.jackknife_error, d),
                    number(e.confidence_low, d), number(e.confidence_high, d));
  }
  if (!table.estimates.empty() && std::isfinite(table.estimates.front().bootstrap_error)) {
    text += fmt::format("\n{:<28} {:>12} {:<6} {:>10}   {}\n", "bootstrap over revolutions", "", "",
                        "std error", "95 % of the samples");
    for (const identify::Estimate& e : table.estimates) {
      const int d = decimals(e);
      text += fmt::format("{:<28} {:>12} {:<6} {:>10}   {} .. {}\n", e.name, "", e.unit,
                          number(e.bootstrap_error, d), number(e.bootstrap_low, d),
                          number(e.bootstrap_high, d));
    }
  }
  text += fmt::format("condition number {:.1f}\n", table.condition_number);
  text += record_lines(table);
  for (const std::string& word : table.words) text += fmt::format("\nnote: {}\n", word);
  return text;
}

std::string fit_json(const FitTable& table, const std::string& result,
                     const std::string& coefficients) {
  nlohmann::json json = {{"name", table.file.name},
                         {"result", result},
                         {"coefficients", coefficients},
                         {"condition_number", json_number(table.condition_number)},
                         {"remarks", table.words}};
  for (const identify::Estimate& e : table.estimates) {
    json["estimates"][e.name] = {{"value", json_number(e.value)},
                                 {"unit", e.unit},
                                 {"standard_error", json_number(e.standard_error)},
                                 {"naive_error", json_number(e.naive_error)},
                                 {"jackknife_error", json_number(e.jackknife_error)},
                                 {"bootstrap_error", json_number(e.bootstrap_error)},
                                 {"bootstrap_low", json_number(e.bootstrap_low)},
                                 {"bootstrap_high", json_number(e.bootstrap_high)},
                                 {"confidence_low", json_number(e.confidence_low)},
                                 {"confidence_high", json_number(e.confidence_high)}};
  }
  for (std::size_t r = 0; r < table.records.size(); ++r) {
    nlohmann::json record = {{"name", table.records[r].name}};
    if (table.fit) {
      const identify::RecordFit& f = table.fit->records[r];
      record["spindle_speed_rpm"] = rpm(f.spindle_speed);
      record["phase_deg"] = core::deg_from_rad(f.phase);
      record["runout_offset_mm"] = f.runout.offset;
      record["runout_angle_deg"] = core::deg_from_rad(f.runout.angle);
      for (int axis = 0; axis < 3; ++axis) {
        record["r_squared"].push_back(json_number(f.agreement.r_squared[axis]));
        record["rmse_N"].push_back(json_number(f.agreement.rmse[axis]));
        if (table.fit->left_out.empty()) continue;
        record["left_out_r_squared"].push_back(json_number(table.fit->left_out[r].r_squared[axis]));
      }
    } else {
      record["revolutions"] = table.average->records[r].revolutions;
    }
    json["records"].push_back(record);
  }
  if (table.fit) {
    json["converged"] = table.fit->converged;
    json["iterations"] = table.fit->iterations;
    json["seconds"] = {{"start", table.fit->start_seconds},
                       {"solve", table.fit->solve_seconds},
                       {"errors", table.fit->error_seconds}};
    json["prediction_error"] = json_number(table.fit->prediction_error);
  } else {
    for (const double r2 : table.average->r_squared) json["r_squared"].push_back(json_number(r2));
  }
  return json.dump(2);
}

std::string coefficients_toml(const FitTable& table, const std::string& result) {
  const force::Coefficients& k =
      table.average ? table.average->coefficients : table.fit->coefficients;
  std::string text;
  const auto quoted = [](const std::string& s) { return nlohmann::json(s).dump(); };
  text += fmt::format(
      "name = {}\n",
      quoted(table.file.description.empty() ? table.file.name : table.file.description));
  text += fmt::format(
      "source = {}\n",
      quoted(fmt::format("fit {} of {} record{} by {} to {}", table.file.name, table.records.size(),
                         table.records.size() == 1 ? "" : "s", version_text(), result)));
  text += "units = \"N/mm2 for the chip, N/mm for the edge\"\n\n";
  const std::array<std::pair<const char*, double>, 6> values = {{{"Ktc_N_per_mm2", k.Ktc},
                                                                 {"Krc_N_per_mm2", k.Krc},
                                                                 {"Kac_N_per_mm2", k.Kac},
                                                                 {"Kte_N_per_mm", k.Kte},
                                                                 {"Kre_N_per_mm", k.Kre},
                                                                 {"Kae_N_per_mm", k.Kae}}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto estimate = std::find_if(
        table.estimates.begin(), table.estimates.end(),
        [&](const auto& e) { return std::string(values[i].first).starts_with(e.name + "_"); });
    const std::string interval =
        estimate == table.estimates.end()
            ? "known"
            : fmt::format("95 % interval {} .. {}", number(estimate->confidence_low, 3),
                          number(estimate->confidence_high, 3));
    text += fmt::format("{} = {}  # {}\n", values[i].first, values[i].second, interval);
  }
  if (table.fit && table.fit->settings.model == identify::Model::exponential) {
    for (const char* name : {"Ktc", "Krc", "Kac"}) {
      text += fmt::format("{}_exponent = {}\n", name, table.fit->size_exponent);
    }
    text += fmt::format("reference_chip_thickness_mm = {}\n",
                        table.fit->settings.reference_chip_thickness);
  }
  if (table.fit && table.fit->settings.model == identify::Model::per_height) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      text += fmt::format("{}_polynomial = [{}]\n", std::string(values[i].first).substr(0, 3),
                          table.fit->height_slope[i] / values[i].second);
    }
  }
  double low_feed = INFINITY, high_feed = 0.0, low_depth = INFINITY, high_depth = 0.0;
  for (std::size_t r = 0; r < table.records.size(); ++r) {
    const identify::Record& record = table.records[r];
    const double feed =
        record.feed_rate * core::kTurn / (record.spindle_speed * table.file.cutter.flutes);
    low_feed = std::min(low_feed, feed);
    high_feed = std::max(high_feed, feed);
    low_depth = std::min(low_depth, record.engagement.axial_depth);
    high_depth = std::max(high_depth, record.engagement.axial_depth);
  }
  text += fmt::format("\n# Range of the records; outside it a study warns.\n");
  text += fmt::format("valid_feed_per_tooth_mm = [{:.6g}, {:.6g}]\n", low_feed, high_feed);
  text += fmt::format("valid_axial_depth_mm = [{:.6g}, {:.6g}]\n", low_depth, high_depth);
  return text;
}

}  // namespace millstudy::cli
