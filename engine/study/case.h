// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "cutter/cutter.h"
#include "dynamics/machine.h"
#include "dynamics/measured_response.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/variation.h"
#include "path/interpolate.h"
#include "process/stock.h"
#include "study/setting.h"

namespace millstudy::dynamics {
struct FrequencyDomain;
}

namespace millstudy::study {

enum class Milling { slot, up, down };

/// Where the chip coefficients come from.
enum class CoefficientModel { constant, orthogonal };

struct PathSection {
  CurvePtr curve;
  path::InterpolationSettings interpolation;  ///< its feed rate is that of the cut
};

struct CutSection {
  double axial_depth = 0.0;              ///< [mm]
  std::optional<Milling> milling;        ///< or entry and exit angle
  std::optional<double> radial_depth;    ///< [mm], up and down milling
  std::optional<double> entry_angle;     ///< [rad]
  std::optional<double> exit_angle;      ///< [rad]
  double spindle_speed = 0.0;            ///< [rev/s]
  std::optional<double> feed_rate;       ///< [mm/s]; this or the next
  std::optional<double> feed_per_tooth;  ///< [mm]
  process::Stock stock = process::Stock::endless;
};

/// How the six coefficients vary; see force::Variation.
struct CoefficientLaw {
  CoefficientModel model = CoefficientModel::constant;
  double cutting_scale = 1.0;                      ///< wear: times the chip coefficients
  double edge_scale = 1.0;                         ///< wear: times the edge coefficients
  double process_damping = 0.0;                    ///< C [N/mm], of a tool that vibrates
  std::array<double, 3> size_exponent{};           ///< of Ktc, Krc, Kac
  std::optional<double> reference_chip_thickness;  ///< [mm], with an exponent
  force::HeightFactors height;                     ///< all empty: the same at every height
  force::OrthogonalData orthogonal;                ///< of model orthogonal
};

/// Where the coefficients hold: least and most; empty where nobody says.
struct Validity {
  std::vector<double> feed_per_tooth;  ///< [mm]
  std::vector<double> cutting_speed;   ///< [mm/s]
  std::vector<double> axial_depth;     ///< [mm]
};

/// How the trace of a point is measured, for records that fits are tried on; lists are x, y, z.
struct MeasurementSection {
  std::optional<double> sampling_rate;  ///< [Hz]; without it nothing is measured
  double duration = 0.0;                ///< [s]
  double phase = 0.0;                   ///< of flute 0's tip at the first sample [rad]
  double spindle_speed_error = 0.0;     ///< actual over commanded speed, less 1
  double noise = 0.0;                   ///< standard deviation [N]
  double noise_correlation = 0.0;       ///< of neighbouring samples
  std::vector<double> offset;           ///< [N]; empty: none
  std::vector<double> drift;            ///< [N/s]; empty: none
  std::vector<double> mode_frequency;   ///< of the dynamometer [Hz], 0: none; empty: none
  std::vector<double> mode_damping_ratio;
  std::vector<double> mode_gain;
  int seed = 0;
};

/// A mode that moves along one axis; without a frequency there is none.
struct AxisModeSection {
  std::optional<double> frequency;  ///< natural [Hz]
  std::optional<double> damping_ratio;
  std::optional<double> mass;       ///< [N s2/mm]; this or the next
  std::optional<double> stiffness;  ///< [N/mm]
};

/// A mode that couples the axes.
struct CoupledModeSection {
  std::optional<double> frequency;  ///< natural [Hz]
  std::optional<double> damping_ratio;
  std::vector<double> residue;  ///< xx, xy, yx, yy [mm/(N s2)]
};

struct ModesSection {
  static constexpr std::size_t kMost = 8;  ///< along an axis
  static constexpr std::size_t kMostCoupled = 4;
  std::array<AxisModeSection, kMost> x;
  std::array<AxisModeSection, kMost> y;
  std::array<CoupledModeSection, kMostCoupled> coupled;
  ResponsePtr response_x;  ///< measured at the tool, null: none
  ResponsePtr response_y;
};

enum class StabilityMethod { semi_discretization, zeroth_order, time_domain };

struct StabilitySection {
  StabilityMethod method = StabilityMethod::semi_discretization;
  double tolerance = 1e-3;
  int intervals = 0;                    ///< 0: by tolerance
  int order = 0;                        ///< with intervals
  std::optional<double> largest_depth;  ///< to which limits are sought [mm]
  int revolutions = 400;                ///< of the time domain
};

enum class FinishMethod { periodic, time_domain };
enum class FinishWall { automatic, up, down };

struct FinishSection {
  FinishMethod method = FinishMethod::periodic;
  double tolerance = 1e-4;
  int revolutions = 400;  ///< of the simulation
  FinishWall wall = FinishWall::automatic;
  std::optional<double> height;    ///< above the tip [mm]
  double sampling_length = 0.8;    ///< [mm]
  std::optional<double> stepover;  ///< [mm]
};

/// One point of a study in native units: what the keys set and the kinds compute from.
struct Case {
  PathSection path;
  cutter::Cutter cutter;
  std::optional<double> stick_out;   ///< from the tip to the holder [mm]
  force::Coefficients coefficients;  ///< as given: see scaled_coefficients()
  CoefficientLaw law;
  Validity valid;
  CutSection cut;
  force::EdgeRule edge_rule;
  int angular_steps = 360;
  MeasurementSection measurement;
  ModesSection modes;
  StabilitySection stability;
  FinishSection finish;
};

/// The six coefficients that forces are computed with: those given times the scales; for model
/// orthogonal the three of the chip are the scale alone, a factor of what variation() gives.
force::Coefficients scaled_coefficients(const Case& point);
/// How these vary along the edge and with the chip.
force::Variation variation(const Case& point);
/// The modes of tool and workpiece: those that are listed, and those fitted to measured responses.
/// @throws core::CaseError where these do not stand for the response
dynamics::Machine machine(const Case& point);
/// The same with measured responses as they are.
dynamics::FrequencyDomain frequency_domain(const Case& point);
/// Feed rate [mm/s], from feed per tooth where that is given; NaN where neither is.
double feed_rate(const Case& point);
/// Feed per tooth [mm], from feed rate where that is given; NaN where neither is.
double feed_per_tooth(const Case& point);
/// Entry, exit and depth. @throws core::CaseError if the depths do not fit the cutter, or exit is
/// not after entry.
force::Engagement engagement(const Case& point);
/// Peripheral cutting speed [mm/s].
double cutting_speed(const Case& point);
/// Radial depth over diameter, 1 in a slot.
double radial_immersion(const Case& point);
/// Discs evaluated for the samples of one revolution and tooth, of all teeth squared with runout; 0
/// for the exact rule.
double disc_samples(const Case& point);
/// Above this many a revolution takes seconds a tooth: refused.
inline constexpr double kMostDiscSamples = 1e9;
inline constexpr const char* kTooManyDiscs =
    "numerics.discs x numerics.angular_steps (with runout times the square of cutter.flutes) must "
    "be "
    "<= 1e9 with rule discs";
/// More samples of a record than this are refused.
inline constexpr double kMostMeasuredSamples = 1e7;
inline constexpr const char* kTooManyMeasuredSamples =
    "measurement.sampling_rate_Hz x measurement.duration_s must be <= 1e7 samples";
/// @throws core::CaseError if feed per tooth exceeds the cutter's radius: no chip is like that, the
/// spindle speed or the feed rate is mistaken
void check_feed(const Case& point);
/// Volume removed per time [mm3/s]: feed rate times the cross-section of the engaged envelope.
double material_removal_rate(const Case& point);

}  // namespace millstudy::study
