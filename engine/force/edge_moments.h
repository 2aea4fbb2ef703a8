// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "force/edge.h"
#include "force/harmonics.h"
#include "force/series.h"
#include "force/slice.h"

namespace millstudy::force {

/// What a node of an edge has of each kind of load.
struct NodeLoads {
  double chip;   ///< chip area over sin(phi) [mm^2]
  double still;  ///< chip area whatever phi [mm^2], of the kind of a plunge
  double edge;   ///< edge length [mm]
};

/// Those of unit feeds in the plane and upward, (F1), (F21).
NodeLoads loads_of_feeds(const CuttingEdges& edges, int flute, const EdgeNode& node);

/// Integrals along an edge from the lower end of a piece up to a point, (F14): all that the force
/// of that stretch needs, whatever the angle at which the point stands.
///
/// With delta the lag of a place on the stretch behind the upper point (so that it stands at
/// phi = b - delta, b the angle of the upper point), for each of the columns t, r, a:
///   chip     planar weight times 1, cos(2 delta), sin(2 delta); axial weight times cos, sin(delta)
///   edge     planar weight times cos(delta), sin(delta); axial weight
///   plunge   likewise
class EdgeMoments {
 public:
  static constexpr int kChip = 5;
  static constexpr int kStill = 3;
  static constexpr int kCount = kColumns * (kChip + 2 * kStill);

  double chip(int column, int i) const { return values_[kChip * column + i]; }
  double edge(int column, int i) const { return values_[kEdge + kStill * column + i]; }
  double plunge(int column, int i) const { return values_[kPlunge + kStill * column + i]; }
  const std::array<double, kCount>& values() const { return values_; }
  std::array<double, kCount>& values() { return values_; }

  /// Those of a node of unit loads that is delta behind the point.
  static EdgeMoments of(const CuttingEdges& edges, Rows rows, int flute, const EdgeNode& node,
                        double delta);

  /// Adds those of a node of unit loads, times its loads.
  void add(const EdgeMoments& unit, const NodeLoads& loads);

  /// Goes on to a point that is further up by a lag: what is there falls behind by it.
  void turn(double cos_lag, double sin_lag);

  /// The force of the stretch with its upper point at b, (F3), (F14); rows in feed axes.
  Basis<double> basis(Rows rows, double cos_b, double sin_b) const;

 private:
  static constexpr int kEdge = kColumns * kChip;
  static constexpr int kPlunge = kEdge + kColumns * kStill;
  std::array<double, kCount> values_{};
};

/// The moments of a piece as functions of how far up it goes: series of the part of its lag.
struct MomentSeries {
  /// The root of an arc, sqrt(z - z_lowest), where it is nearly singular in the piece; linear where
  /// that is far, and on lines.
  SeriesVariable variable;
  Terms kind;
  std::vector<EdgeMoments> terms;
  EdgeMoments whole;  ///< at part = 1
};

/// (F14): terms below 3e-16 of the largest are dropped; 24 or 48 are prepared, a whole ball at 80
/// deg takes 96. Of a ball at 30 deg about 21 remain.
MomentSeries moment_series(const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece);

/// So many series of one piece that differ in the loads of its nodes, prepared from as many points
/// as the one that needs most.
/// @param loads  writes those of a node, in the order of the series
std::vector<MomentSeries> moment_series(
    const CuttingEdges& edges, Rows rows, int flute, const EdgePiece& piece, int count,
    const std::function<void(const EdgeNode&, std::span<NodeLoads>)>& loads);

}  // namespace millstudy::force
