// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "dynamics/periodic_motion.h"
#include "force/edge.h"

namespace millstudy::dynamics {

/// The wall that a side cut leaves: at immersion 0 by up-milling, at pi by down-milling.
enum class Wall { up, down };

/// The surface that vibrating teeth leave on a wall; offsets from the wall of a rigid tool without
/// runout [mm], positive where too much was removed.
class MachinedWall {
 public:
  /// @param motion          its time 0 is the tip of flute 0 at immersion 0
  /// @param spindle_speed   [rad/s], > 0
  /// @param feed_per_tooth  mean [mm], > 0
  MachinedWall(const force::CuttingEdges& edges, const PeriodicMotion& motion, double spindle_speed,
               double feed_per_tooth, Wall wall);

  /// (D32): surface location error at a height: offset where the tooth that cuts deepest passes the
  /// wall [mm]. Exact to the motion.
  double location_error(double z) const;

  /// (D33): offsets over the feed of one revolution, equally spaced [mm]; shape (samples). The
  /// deepest of all passes, by cubics through places solved for to rounding: 1e-6 of the largest.
  std::vector<double> profile(double z, int samples) const;

  /// Feed of one revolution [mm].
  double feed_per_turn() const { return feed_per_turn_; }

 private:
  struct Pass {
    double time;    ///< at which the tooth passes the wall [s], in the first turn
    double radius;  ///< [mm], runout included
  };
  std::vector<Pass> passes(double z) const;
  double offset(const Pass& pass, double z, double time) const;
  double time_at(const Pass& pass, double x) const;

  const force::CuttingEdges& edges_;
  const PeriodicMotion& motion_;
  double speed_;
  double feed_per_turn_;
  double side_;  ///< 1: +y, up-milling; -1: -y
};

/// Parameters of ISO 4287, of the primary profile: the mean over five sampling lengths, each with
/// the mean of its own as mean line. [mm]
struct Roughness {
  double ra = 0.0;  ///< mean deviation
  double rq = 0.0;  ///< root mean square
  double rz = 0.0;  ///< highest peak above deepest valley
};

/// (D34)
/// @param profile         one period, equally spaced; shape (samples >= 2)
/// @param period          its length [mm], > 0
/// @param sampling_length [mm], > 0
Roughness roughness(const std::vector<double>& profile, double period, double sampling_length);

/// (D35): height of the cusps that passes beside one another leave on the floor [mm]: that of the
/// envelope at half the stepover from the axis.
///
/// Exact to 1e-12 of the height. Throws core::CaseError for a stepover wider than the envelope.
double cusp_height(const cutter::Envelope& envelope, double stepover);

}  // namespace millstudy::dynamics
