// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "force/chip_law.h"
#include "force/edge.h"
#include "force/edge_moments.h"
#include "force/engagement.h"
#include "force/harmonics.h"
#include "force/lagging_piece.h"
#include "force/part_series.h"
#include "force/sampling_run.h"

/// Geometry of one tooth prepared for the sampler, for each way of integrating it. All are
/// immutable and know nothing of engagement, feed and coefficients; add_to() adds the passes of
/// teeth to a run.
namespace millstudy::force {

inline Harmonics shifted(const Harmonics& p, const Angle& shift) {
  return shifted(p, shift.cosine, shift.sine);
}

/// A cylindrical piece in closed form (F9), (F13).
class CylinderEdge {
 public:
  CylinderEdge(const CuttingEdges& edges, int flute, const EdgePiece& piece);

  /// One engagement with what the closed forms need of it.
  struct AtArc {
    Angle entry;
    Angle exit;
    double ramp;  ///< tip angle from the first contact to the fullest [rad]
  };
  AtArc at(const Arc& arc) const;
  void add_to(SamplingRun& run, const Combination& with, const AtArc& engaged) const;

 private:
  void add_short_ramps(SamplingRun& run, const Harmonics& density, const AtArc& engaged) const;
  void add_long_ramps(SamplingRun& run, const Harmonics& density, const AtArc& engaged) const;

  Angle high_shift_;  ///< largest immersion angle on the edge, less that of the tip
  Angle low_shift_;   ///< smallest, likewise
  double lag_;        ///< their difference [rad], > 0
  double per_lag_;    ///< height over lag [mm/rad]
  Closed closed_;
  HarmonicBasis density_;  ///< per height [1/mm], in the angle of the point itself
  HarmonicBasis whole_;    ///< the edge all in cut, in the angle of the tip
};

/// Any piece, as Chebyshev series (F14).
class SeriesEdge {
 public:
  SeriesEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece);

  /// The series for one engagement.
  struct AtArc {
    Arc arc;
    PreparedRows entry;  ///< U_entry(l): the piece from its lower end to the lag l, with the point
                         ///< at l at the entry angle
    PreparedRows exit;   ///< U_exit(l)
  };
  AtArc at(const Arc& arc) const;
  void add_to(SamplingRun& run, const Combination& with, const AtArc& engaged) const;

 private:
  PreparedRows series_at(double limit) const;

  Rows rows_;
  double hand_;
  double shift_;  ///< immersion angle of the tip less that of the lower end [rad]
  double lag_;    ///< of the upper end behind the lower [rad], > 0
  MomentSeries series_;
  HarmonicBasis whole_;  ///< in the angle of the tip
};

/// Any piece of teeth whose chip coefficients go with a power of the chip thickness, for one
/// engagement (F26): the whole pass of a tooth as series of the angle of its tip. Chip loads are
/// those of unit feed.
class SizeEffectEdge {
 public:
  SizeEffectEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece,
                 const Arc& arc);
  void add_to(SamplingRun& run, const Combination& with) const;

  /// False where a root is too steep for a series, as with m near 1 and hardly any helix.
  bool is_resolved() const { return resolved_; }

 private:
  /// Tip angles origin .. origin + sign length.
  struct Stretch {
    double origin;  ///< [rad]
    double sign;
    double length;  ///< [rad]
    PreparedRows series;
  };
  Closed closed_;
  std::vector<Stretch> stretches_;
  bool resolved_ = true;
};

/// Any piece of teeth whose axis is offset from the spindle's, (F25): of flutes that have one helix
/// angle, without tilt, fed in the plane.
class RunoutEdge {
 public:
  /// @param edges  of the cutter without its runout and pitch
  RunoutEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece);

  /// Adds flutes first .. last.
  /// @param edges  of the cutter as it is
  void add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
              const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const;

  /// Beyond so many flutes their pairs would take longer than the integral.
  static constexpr int kMostFlutes = 16;

 private:
  class Sweep;
  Rows rows_;
  LaggingPiece piece_;
  MomentSeries series_;
};

/// Any piece of teeth whose axis is tilted against the spindle's, or offset, or both, (F28): else
/// as RunoutEdge.
class TiltedEdge {
 public:
  /// @param edges  of the cutter without its runout and pitch
  TiltedEdge(const CuttingEdges& edges, Rows rows, const EdgePiece& piece);

  /// Adds flutes first .. last.
  /// @param edges  of the cutter as it is
  void add_to(SamplingRun& run, const CuttingEdges& edges, int first, int last,
              const Coefficients& k, const Feed& feed, std::span<const Arc> arcs) const;

 private:
  struct Node;
  class Sweep;
  Rows rows_;
  LaggingPiece piece_;
  double middle_;  ///< height above the tip [mm]
  PartSeries heights_;
  /// Plain, and with the height above the middle as a factor of the chip.
  std::vector<MomentSeries> series_;
};

/// Any piece of one tooth of a cutter with runout whose helix angles differ, (F33): its axis offset
/// or tilted or both, fed in the plane.
class ReachEdge {
 public:
  /// @param edges  of the cutter as it is
  ReachEdge(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece);

  int flute() const { return flute_; }

  void add_to(SamplingRun& run, const Coefficients& k, const Feed& feed,
              std::span<const Arc> arcs) const;

 private:
  /// One of the teeth before, (F22).
  struct Reach {
    double ratio;        ///< at the lower end
    double ratio_slope;  ///< over the part
    PartSeries ahead;    ///< [mm]
    MomentSeries moments;
  };
  /// What bounds how fast the phase of a chip, or of the difference of two, turns.
  struct Apart {
    std::array<double, 2> ratio;   ///< least and largest of the feed since that one passed
    double ratio_speed;            ///< at most, over the lag [1/rad]
    std::array<double, 2> radius;  ///< least and largest of the vector by which it stands out [mm]
    double radius_speed;           ///< [mm/rad]
  };
  double fastest_turn(double feed) const;
  struct Node;
  class Sweep;

  Rows rows_;
  int flute_;
  Angle position_;
  LaggingPiece piece_;
  double longest_lag_;  ///< of the piece, of the steepest flute [rad]
  double size_;         ///< what still moments are over [mm]
  std::vector<Reach> reaches_;
  std::vector<Apart> apart_;
};

/// Equal-height discs (F12).
class DiscEdge {
 public:
  DiscEdge(std::shared_ptr<const CuttingEdges> edges, Rows rows, int flute, int discs);
  void add_to(SamplingRun& run, const Combination& with, const Arc& arc) const;

 private:
  struct Disc {
    EdgeNode node;
    Angle lag;
  };

  std::shared_ptr<const CuttingEdges> edges_;
  Rows rows_;
  int flute_;
  Closed closed_;
  std::vector<Disc> discs_;
};

}  // namespace millstudy::force
