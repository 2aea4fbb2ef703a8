// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "cutter/cutter.h"
#include "force/discs.h"
#include "force/engagement.h"
#include "force/harmonics.h"
#include "force/sampling_run.h"

/// Geometry of one tooth prepared for the sampler, for each way of integrating it. All three are
/// immutable; add_to() adds the tooth's passes to a run.
namespace millstudy::force {

/// A cylindrical edge between two heights, in closed form (F9), (F13).
class CylinderEdge {
 public:
  /// @param z1, z2  heights on the cylinder [mm], z1 < z2
  CylinderEdge(const cutter::Cutter& cutter, const Engagement& engagement, double z1, double z2);
  void add_to(SamplingRun& run, const Combination& with) const;

 private:
  void add_ramps(SamplingRun& run, const Combination& with, const Harmonics& density) const;
  void add_short_ramps(SamplingRun& run, const Harmonics& density) const;
  void add_long_ramps(SamplingRun& run, const Harmonics& density) const;

  Engagement engagement_;
  double height_;
  double lag_;         ///< of the top behind the bottom [rad], > 0
  double high_shift_;  ///< largest immersion angle on the edge, less that of the tip [rad]
  double low_shift_;   ///< smallest, likewise
  Closed closed_;
  HarmonicBasis density_;  ///< per height [1/mm], in the angle of the point itself
  HarmonicBasis whole_;    ///< the edge all in cut, in the angle of the tip
};

/// The ball's edge from the tip to a height, as Chebyshev series (F14).
class CurvedEdge {
 public:
  /// @param top  [mm], 0 < top <= R
  CurvedEdge(const cutter::Cutter& cutter, const Engagement& engagement, double top);
  void add_to(SamplingRun& run, const Combination& with) const;

 private:
  using Series = std::vector<Basis<double>>;

  double entry_angle_;
  double exit_angle_;
  double hand_;
  double lag_;
  HarmonicBasis whole_;
  Series at_entry_;  ///< U_entry(l): edge from the tip up to where it stands at the entry angle
  Series at_exit_;   ///< U_exit(l)
};

/// Equal-height discs (F12).
class DiscEdge {
 public:
  DiscEdge(const cutter::Cutter& cutter, const Engagement& engagement, int discs);
  void add_to(SamplingRun& run, const Combination& with) const;

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
