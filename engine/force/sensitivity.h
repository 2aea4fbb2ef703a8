// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "force/chip_law.h"
#include "force/chip_regimes.h"
#include "force/edge.h"
#include "force/engagement.h"
#include "force/lowest_line.h"
#include "force/stretch_moments.h"

namespace millstudy::force {

/// What a coefficient model multiplies: Ktc Krc Kac Kte Kre Kae, and their slopes over height.
inline constexpr int kFittedColumns = 12;

/// The numbers that forces are linear in, and the size effect.
struct FittedCoefficients {
  std::array<double, kFittedColumns> k{};  ///< six at z = 0 [N/mm2, N/mm], six slopes [per mm]
  double size_exponent = 0.0;              ///< m of (F18), for the three of the chip
  double reference_chip_thickness = 1.0;   ///< h0 [mm]
};

/// Force on the tool along x, y, z [N] at one spindle angle, and its derivatives; see (F30).
struct Sensitivity {
  using Vector = std::array<double, 3>;
  Vector force{};
  std::array<Vector, kFittedColumns> coefficient{};  ///< [mm2 or mm; times mm for the slopes]
  Vector angle{};                                    ///< of the spindle [N/rad]
  Vector feed{};                                     ///< per tooth [N/mm]
  std::array<Vector, 2> runout{};                    ///< offset (e cos, e sin of its angle) [N/mm]
  Vector exponent{};                                 ///< m [N]
};

/// Forces as a fit needs them: exact derivatives, those of the moving limits of the cut included.
///
/// (F30), the derivative of (F24). Parallel axes, a feed along x in the plane, no size effect or
/// height dependence but that of FittedCoefficients. Agrees with NonlinearForce to 1e-14 of the
/// peak and with its finite differences to 3e-12, with a size effect 7e-9 (measured, 100 random
/// cutters each). At the angles at which a derivative jumps it is that of either side: where a
/// limit reaches the tip or the depth, where an edge of no helix enters or leaves, and for the
/// runout of a cutter without any that enters where the chip is zero.
class ForceSensitivity {
 public:
  /// What is asked for besides the six coefficients, which takes longer.
  struct Wanted {
    bool slopes = false;       ///< columns 6 .. 11; without, these coefficients must be zero
    bool size_effect = false;  ///< without, the exponent must be zero
  };

  /// @param cutter      runout is taken from it; its tilt must be zero
  /// @param engagement  check() lets it pass with this cutter
  /// Throws core::InputError for a tilt.
  ForceSensitivity(const cutter::Cutter& cutter, const Engagement& engagement, Wanted wanted);
  ForceSensitivity(const ForceSensitivity&) = delete;
  ForceSensitivity& operator=(const ForceSensitivity&) = delete;

  /// @param angle          immersion angle of the tip of flute 0 [rad], any
  /// @param feed_per_tooth [mm], >= 0
  /// Not to be called concurrently: it has working memory.
  Sensitivity at(double angle, double feed_per_tooth, const FittedCoefficients& coefficients);

 private:
  struct Tooth;
  void begin(Tooth& tooth);
  void add_interval(Tooth& tooth, double z1, double z2);
  void add_by_nodes(Tooth& tooth, const EdgePiece& piece, const Regime& regime);
  int smallest_at(const Tooth& tooth, double z);
  void search_stretches(const Tooth& tooth, const EdgePiece& piece, double from, double to);

  CuttingEdges edges_;
  ChipLaw law_;
  Arc arc_;
  Wanted wanted_;
  bool by_lines_;                            ///< (F23)
  bool by_moments_;                          ///< (F31)
  std::array<double, 2> offset_{};           ///< of the runout
  std::vector<std::array<double, 2>> tips_;  ///< cos and sin of the positions of the flutes
  // Of every piece as a whole.
  std::vector<MomentPair> whole_;               ///< where (F31) serves
  std::vector<std::array<EdgePoint, 2>> ends_;  ///< where (F23) does
  std::vector<ChipLine> lines_;                 ///< of the flute at hand, by reach
  std::vector<LineStretch> stretches_;          ///< of the piece at hand
  std::vector<Regime> regimes_;
  std::vector<Reach> reaches_;
};

}  // namespace millstudy::force
