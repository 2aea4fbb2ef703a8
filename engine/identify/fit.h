// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cutter/cutter.h"
#include "dynamics/dynamometer.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "identify/trace.h"

/// From force traces to cutting-force coefficients.
namespace millstudy::identify {

/// One measured cut, of one cutter and one material with all others of a fit.
struct Record {
  std::string name;  ///< for tables and messages: "slots.mat, axial_depth_mm 3"
  Trace trace;
  force::Engagement engagement;
  double feed_rate = 0.0;      ///< [mm/s], > 0; feed per tooth follows the actual spindle speed
  double spindle_speed = 0.0;  ///< nominal [rad/s], > 0
};

/// How coefficients vary; see (I2).
enum class Model {
  constant,     ///< six numbers
  per_height,   ///< each K + K' z
  exponential,  ///< K (h/h0)^-m, one exponent for the three of the chip
};

/// How large residuals count, (I6).
enum class Loss { none, huber, cauchy };

/// Whether a quantity is kept or estimated, and for what.
enum class Estimated { no, per_record, shared };

/// What is known of a coefficient beforehand.
struct Known {
  std::optional<double> fixed = std::nullopt;      ///< its value; it is not estimated
  std::optional<double> mean = std::nullopt;       ///< prior: normal, of this mean ...
  std::optional<double> deviation = std::nullopt;  ///< ... and standard deviation, > 0
};

/// A fit was told to stop; there is no result.
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is estimated, and how.
struct FitSettings {
  Model model = Model::constant;
  double reference_chip_thickness = 0.1;  ///< h0 of the exponential model [mm], > 0
  std::array<Known, 6> known = {};        ///< of Ktc Krc Kac Kte Kre Kae

  Estimated phase = Estimated::per_record;  ///< per_record or no
  Estimated spindle_speed = Estimated::per_record;
  Estimated runout = Estimated::per_record;  ///< no: that of the cutter
  /// Largest component of the runout [mm], > 0. Across the direction in which teeth differ, runout
  /// hardly shows, so that without a limit a small cut may ask for a runout that no spindle has.
  double runout_limit = 0.05;
  Estimated offset = Estimated::per_record;  ///< per_record or no
  Estimated drift = Estimated::no;           ///< slopes of the offsets; per_record or no
  /// Knots of a cubic spline for the slow wandering of the spindle angle; 0: it turns evenly.
  int phase_drift_knots = 0;
  /// Phase of flute 0's tip at the first sample of each record [rad]; where it is not estimated.
  std::vector<double> known_phase = {};

  /// Modes of the dynamometer along x, y, z: known, or where the estimate begins.
  std::array<std::vector<dynamics::DynamometerMode>, 3> dynamometer = {};
  bool estimate_dynamometer = false;

  Loss loss = Loss::none;
  double loss_scale = 0.0;           ///< [N], > 0 for huber and cauchy
  bool weigh_records_alike = false;  ///< residuals over the root mean square of their record
  std::array<bool, 3> axes = {true, true, true};  ///< which are fitted, of those measured

  /// Forces are fitted and compared below this frequency only [Hz]; 0: as they are.
  double below = 0.0;

  double tolerance = 1e-8;  ///< relative decrease of the cost at which it has converged
  int max_iterations = 100;

  int bootstrap = 0;  ///< samples of the bootstrap (I13), 0 or at least 20
  int seed = 1;       ///< of the bootstrap, >= 0

  /// Once it is set, fit() throws Stopped.
  const std::atomic<bool>* stop = nullptr;
  /// Told of each iteration of the joint fit: its number and the root mean square residual [N].
  std::function<void(int iteration, double residual)> progress = nullptr;
};

/// A parameter, its value and how sure it is. Errors that were not computed are NaN.
struct Estimate {
  std::string name;  ///< Ktc, Ktc_slope, size_exponent, runout_offset, ...
  std::string unit;  ///< of value, as results write it: "N/mm2"
  int record = -1;   ///< that it belongs to; -1: shared
  double value = 0.0;
  double naive_error = std::numeric_limits<double>::quiet_NaN();     ///< as if residuals were white
  double standard_error = std::numeric_limits<double>::quiet_NaN();  ///< of correlated ones, (I8)
  double jackknife_error = std::numeric_limits<double>::quiet_NaN();  ///< over records, (I9)
  double bootstrap_error = std::numeric_limits<double>::quiet_NaN();  ///< (I13)
  double bootstrap_low = std::numeric_limits<double>::quiet_NaN();    ///< 2.5 % of its samples
  double bootstrap_high = std::numeric_limits<double>::quiet_NaN();   ///< 97.5 %
  double confidence_low =
      std::numeric_limits<double>::quiet_NaN();  ///< 95 %, of the larger of both
  double confidence_high = std::numeric_limits<double>::quiet_NaN();
};

/// How well a model describes a record. NaN for axes that were not measured.
struct Agreement {
  std::array<double, 3> r_squared;  ///< 1 - residual over total sum of squares about the mean
  std::array<double, 3> rmse;       ///< [N]
};

/// What a fit found for one record.
struct RecordFit {
  double phase = 0.0;           ///< immersion angle of flute 0's tip at the first sample [rad]
  double spindle_speed = 0.0;   ///< mean [rad/s]
  double feed_per_tooth = 0.0;  ///< at that speed [mm]
  cutter::Runout runout;
  std::array<double, 3> offset{};   ///< at the middle of the record [N]
  std::array<double, 3> drift{};    ///< [N/s]
  std::vector<double> phase_drift;  ///< spindle angle less an even turn, at the knots [rad]
  Agreement agreement;
  std::array<std::vector<double>, 3> predicted;  ///< [N], as the trace; empty where not measured
};

/// The outcome of fit().
struct FitResult {
  FitSettings settings;
  force::Coefficients coefficients;      ///< at z = 0, and at h0
  std::array<double, 6> height_slope{};  ///< K' of Model::per_height [per mm]
  double size_exponent = 0.0;            ///< m of Model::exponential
  std::array<std::vector<dynamics::DynamometerMode>, 3> dynamometer;
  std::vector<RecordFit> records;

  std::vector<Estimate> estimates;  ///< shared ones first, coefficients at their head
  /// Of the shared estimates, by the standard errors; shape (n, n), row by row.
  std::vector<double> covariance;
  std::vector<double> correlation;
  double condition_number = 0.0;  ///< of the coefficients' columns, scaled to unit length (I7)

  /// How well the coefficients of the other records describe each one, its own parameters fitted;
  /// empty below three records.
  std::vector<Agreement> left_out;
  /// Of these, all together: root of the residual over the total sum of squares [1]; NaN if empty.
  double prediction_error = std::numeric_limits<double>::quiet_NaN();

  bool converged = false;
  int iterations = 0;
  double cost = 0.0;                  ///< half the sum of squared (weighted, robust) residuals
  std::string summary;                ///< how the solver ended
  double start_seconds = 0.0;         ///< wall time of finding where to begin
  double solve_seconds = 0.0;         ///< of the joint fit
  double error_seconds = 0.0;         ///< of errors, records left out and bootstrap
  std::vector<std::string> warnings;  ///< what the user should know, in whole sentences
};

/// Fits all records together, (I1): nonlinear least squares by Levenberg-Marquardt with analytic
/// derivatives; phases are found by looking everywhere, not from a guess.
///
/// Noiseless records return their coefficients to 1e-8. The same bit for bit for any number of
/// threads.
/// @throws core::InputError for records and settings out of range, and for what a cutter has that
///         fits do not know: tilted axes, a measured profile is fine
FitResult fit(const cutter::Cutter& cutter, const std::vector<Record>& records,
              const FitSettings& settings);

}  // namespace millstudy::identify
