// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "cutter/cutter.h"
#include "force/discs.h"
#include "force/engagement.h"
#include "force/harmonics.h"
#include "force/sampling_run.h"

/// Geometry of one tooth prepared for the sampler, for each way of integrating it. All three are
/// immutable; add_to() adds the tooth's passes to a run.
namespace millstudy::force {

/// An angle with its cosine and sine.
struct Angle {
  explicit Angle(double angle) : value(angle), cosine(std::cos(angle)), sine(std::sin(angle)) {}
  double value;  ///< [rad]
  double cosine;
  double sine;
};

inline Harmonics shifted(const Harmonics& p, const Angle& shift) {
  return shifted(p, shift.cosine, shift.sine);
}

/// A cylindrical edge between two heights, in closed form (F9), (F13).
class CylinderEdge {
 public:
  /// @param z1, z2  heights on the cylinder [mm], z1 < z2
  CylinderEdge(const cutter::Cutter& cutter, const Engagement& engagement, double z1, double z2);
  void add_to(SamplingRun& run) const;

 private:
  void add_short_ramps(SamplingRun& run, const Harmonics& density) const;
  void add_long_ramps(SamplingRun& run, const Harmonics& density) const;

  Angle entry_;
  Angle exit_;
  Angle high_shift_;  ///< largest immersion angle on the edge, less that of the tip
  Angle low_shift_;   ///< smallest, likewise
  double lag_;        ///< their difference [rad], > 0
  double ramp_;       ///< tip angle from the first contact to the fullest [rad]
  double per_lag_;    ///< height over lag [mm/rad]
  Closed closed_;
  HarmonicBasis density_;  ///< per height [1/mm], in the angle of the point itself
  HarmonicBasis whole_;    ///< the edge all in cut, in the angle of the tip
};

/// The curved edge from the tip to a height, as Chebyshev series (F14). They are series in the root
/// of the height, which is the ball's: other shapes have to be smooth in it too.
class CurvedEdge {
 public:
  /// @param top  [mm], 0 < top <= R
  CurvedEdge(const cutter::Cutter& cutter, const Engagement& engagement, double top);
  void add_to(SamplingRun& run) const;

 private:
  double entry_angle_;
  double exit_angle_;
  double hand_;
  double lag_;
  HarmonicBasis whole_;
  PreparedRows
      at_entry_;  ///< U_entry(l): edge from the tip up to where it stands at the entry angle
  PreparedRows at_exit_;  ///< U_exit(l)
};

/// Equal-height discs (F12).
class DiscEdge {
 public:
  DiscEdge(const cutter::Cutter& cutter, const Engagement& engagement, int discs);
  void add_to(SamplingRun& run) const;

 private:
  struct Turned {
    Disc disc;
    double cos_lag;
    double sin_lag;
  };

  double entry_angle_;
  double exit_angle_;
  Closed closed_;
  std::vector<Turned> discs_;
};

}  // namespace millstudy::force
