// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/quadrature.h"
#include "cutter/cutter.h"
#include "cutter/envelope.h"
#include "cutter/flutes.h"
#include "force/variation.h"

namespace millstudy::force {

/// What the rows of an integral are.
enum class Rows {
  forces,   ///< x, y, z, torque, (F4)
  moments,  ///< about x and y through the tip, (F20)
};

/// A node of the integral along an edge, its weight included in width and length.
struct EdgeNode {
  double z;          ///< height above the tip [mm]
  double radius;     ///< [mm]
  double sin_kappa;  ///< of the axial immersion angle
  double cos_kappa;
  double lag;     ///< lag angle over the tangent of the helix [rad]
  double width;   ///< db [mm]
  double length;  ///< dS [mm]
};

/// A point of the edge of a flute.
struct EdgePoint {
  double z;                         ///< [mm]
  double lag;                       ///< of the envelope: psi over the tangent of the helix [rad]
  std::array<double, 2> direction;  ///< cos and sin of psi
};

/// @param z  [mm], from 0 to the length of the envelope
EdgePoint edge_point(const cutter::Envelope& envelope, double helix_tangent, double z);

/// A stretch of one segment over which integrands are smooth and span a bounded range, so that few
/// nodes or terms are enough.
struct EdgePiece {
  cutter::Segment segment;
  double bottom;  ///< [mm]
  double top;     ///< [mm], > bottom
};

/// The cutting edges of an end mill up to the axial depth: everything about them that does not
/// depend on the engagement, the feed and the values of the coefficients.
class CuttingEdges {
 public:
  /// @param axial_depth  [mm], > 0, at most the length of the envelope
  CuttingEdges(const cutter::Cutter& cutter, double axial_depth, const Variation& variation);

  const cutter::Cutter& cutter() const { return cutter_; }
  const cutter::Envelope& envelope() const { return envelope_; }
  const Variation& variation() const { return variation_; }
  double axial_depth() const { return axial_depth_; }
  const std::vector<cutter::Flute>& flutes() const { return flutes_; }
  /// True if one flute stands for all, turned by the pitch.
  bool equal_flutes() const { return equal_flutes_; }
  bool variable_helix() const { return variable_helix_; }

  /// From the tip up, without gaps. They end where a segment or a coefficient table has a corner.
  std::span<const EdgePiece> pieces() const { return pieces_; }

  /// (F21): chip thickness of a flute relative to the mean feed per tooth, from the pitch at the
  /// lag of a point [1]: the mean over the flutes is 1. From further ahead, (F22), if `teeth`, less
  /// than there are, are looked at instead of one.
  double pitch_ratio(int flute, double lag, int teeth = 1) const;

  /// (F17), (F19): factors of the six coefficients at a node; only for coefficients that do not
  /// depend on the chip.
  std::array<double, 6> factors(int flute, const EdgeNode& node) const;
  /// Local helix angle (inclination) at a node [rad].
  double inclination(int flute, const EdgeNode& node) const;

  /// Node at p, of weight dp: p = kappa on an arc, p = z on a line (C11).
  EdgeNode node(const EdgePiece& piece, double helix_tangent, double p, double dp) const;

  /// How far integrands vary from z1 to z2 within a piece, for choosing the number of nodes [1].
  double span(const EdgePiece& piece, double helix_tangent, double z1, double z2) const;

  /// Calls visit(node) for Gauss-Legendre nodes of z1 .. z2 within a piece, (F10).
  ///
  /// Of 8 to 20 nodes a panel by its span: three more than rounding needs (measured).
  template <class Visit>
  void for_each_node(const EdgePiece& piece, double helix_tangent, double z1, double z2,
                     const Visit& visit) const {
    const double range = span(piece, helix_tangent, z1, z2);
    const int panels = 1 + static_cast<int>(range / kLongestPanel);
    const core::GaussRule& rule = core::gauss_legendre(8 + static_cast<int>(4.0 * range / panels));
    const double p1 = variable(piece, z1);
    const double half = 0.5 * (variable(piece, z2) - p1) / panels;
    for (int panel = 0; panel < panels; ++panel) {
      const double middle = p1 + (2 * panel + 1) * half;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        visit(node(piece, helix_tangent, middle + half * rule.nodes[i], half * rule.weights[i]));
      }
    }
  }

  /// Disc i of n equal heights over the axial depth, taken at its mid-height (F12).
  EdgeNode disc(double helix_tangent, int n, int i) const;

  /// p of a height.
  static double variable(const EdgePiece& piece, double z) {
    return piece.segment.is_arc ? piece.segment.kappa_at(z) : z;
  }

 private:
  static constexpr double kLongestPanel = 3.0;
  void add_pieces(const cutter::Segment& segment, double bottom, double top);

  cutter::Cutter cutter_;
  cutter::Envelope envelope_;
  Variation variation_;
  double axial_depth_;
  std::vector<cutter::Flute> flutes_;
  bool equal_flutes_;
  bool variable_helix_;
  double steepest_ = 0.0;  ///< largest abs(helix tangent)
  std::vector<EdgePiece> pieces_;
};

}  // namespace millstudy::force
