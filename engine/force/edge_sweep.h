// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "core/watch.h"
#include "force/edge_walk.h"
#include "force/lagging_piece.h"
#include "force/lanes_math.h"
#include "force/runout_stretch.h"
#include "force/sampling_run.h"

/// One tooth on its way through an arc, where what its chips are has to be found up the edge at
/// every angle.
namespace millstudy::force {

/// A vector of spindle angles.
struct Spindle {
  int n;  ///< index of the first
  const Pass& pass;
  Lanes cosine;
  Lanes sine;
  Lanes lower_angle;  ///< immersion angle of the lower end of the piece

  SineAndCosine at(const Angle& shift) const { return behind(pass, shift, cosine, sine); }
};

/// A place on a piece, whatever the spindle angle.
struct Place {
  double part;  ///< of the piece's lag that is below it
  Angle shift;  ///< immersion angle of the tip less that of the place
};

/// Parts of equal lag, within each of which a chip, or the difference of two, is zero once while
/// its phase goes one way.
///
/// @tparam Node  a Place, and what is to be known of it
template <class Node>
struct Cells {
  /// @param turn  how fast the phase of a chip turns at most, over the immersion angle: below 1 it
  ///              goes one way all along the piece
  /// @param node  makes a Node of a Place
  template <class MakeNode>
  Cells(const LaggingPiece& piece, double turn, const MakeNode& node) {
    constexpr double kWidest = 3.0;  // of both angles [rad], less than pi
    const int count = 1 + static_cast<int>(piece.lag * (1.0 + std::min(turn, 1.0)) / kWidest);
    const auto place = [&](double part) -> Place {
      return {part, Angle(piece.lower_shift.value + piece.hand * piece.lag * part)};
    };
    for (int k = 0; k < count; ++k) {
      nodes.push_back(node(place(static_cast<double>(k) / count)));
      middles.push_back(place((k + 0.5) / count));
    }
    nodes.push_back(node(place(1.0)));
  }
  int count() const { return static_cast<int>(middles.size()); }

  std::vector<Node> nodes;
  std::vector<Place> middles;
};

/// Where, up the edge at vectors of angles, the chip or the edge forces change. Memory that one
/// sweep leaves to the next.
template <class Walk>
struct Noted {
  struct Change {
    int n;  ///< the first angle of the vector
    typename Walk::Point point;
    typename Walk::Chip chip;  ///< that below less that above
    Lanes edge;                ///< 1 where the edge forces end there, -1 where they begin, else 0
  };
  std::vector<Change> of_teeth;  ///< from the chip of one to that of another
  std::vector<Change> of_chip;   ///< where it begins or ends
};

/// One tooth over one piece within one arc: a vector of spindle angles at a time.
///
/// @tparam Sweep  derives from this and says what the chips are:
///   Walk             an EdgeWalk
///   begin(spindle)   before all else at a vector
///   lowest_at_node(spindle, node), lowest_at_limit(spindle, is_entry)
///   up_to_limit(is_entry, lowest), whole(lowest)
///                    the force of the piece up to there, or of all, under the chip there
///   add_noted(run, last)  the forces of the changes
template <class Sweep, class Node, class Walk>
class EdgeSweep {
 public:
  void add_to(SamplingRun& run) const {
    run.for_each_pass(passage_.first, passage_.last, [&](const Pass& pass) {
      passage_.for_each_cut(piece_.hand, [&]<Cut cut>(double from, double to) {
        add<cut>(run, pass, run.between(pass, from, to, piece_.closed()));
      });
    });
  }

 protected:
  EdgeSweep(const LaggingPiece& piece, const Cells<Node>& cells, const Walk& walk,
            const Angle& entry, const Angle& exit, Noted<Walk>& noted)
      : piece_(piece),
        walk_(walk),
        noted_(noted),
        cells_(cells),
        passage_(piece, {entry.value, exit.value}) {}

  const LaggingPiece& piece_;
  Walk walk_;
  Noted<Walk>& noted_;

 private:
  using At = LowestAt<typename Walk::Point>;

  const Sweep& sweep() const { return static_cast<const Sweep&>(*this); }

  template <Cut cut>
  void add(SamplingRun& run, const Pass& pass, const IndexRange& indices) const {
    constexpr int kTogether = 16 * kLanes;
    const AngleTables& tables = run.tables();
    const double start = pass.offset - piece_.lower_shift.value;
    for (IndexRange part = indices; part.first < indices.last; part.first += kTogether) {
      part.last = std::min(part.first + kTogether, indices.last);
      core::keep_watch();
      noted_.of_teeth.clear();
      noted_.of_chip.clear();
      run.accumulate(part, [&](int n, Lanes& x, Lanes& y, Lanes& z, Lanes& torque) {
        const Spindle spindle = {n, pass, load(&tables.cos1[n]), load(&tables.sin1[n]),
                                 start + tables.step * (static_cast<double>(n) + kLaneIndex)};
        sweep().begin(spindle);
        const ForceLanes force = force_at<cut>(spindle);
        x = force.x, y = force.y, z = force.z, torque = force.torque;
      });
      sweep().add_noted(run, part.last);
    }
  }

  template <Cut cut>
  [[gnu::always_inline]] ForceLanes force_at(const Spindle& spindle) const {
    constexpr bool cut_below = cut == Cut::lower || cut == Cut::both;
    constexpr bool cut_above = cut == Cut::upper || cut == Cut::both;
    const bool right = piece_.hand > 0.0;
    const At bottom = cut_below ? sweep().lowest_at_limit(spindle, !right)
                                : sweep().lowest_at_node(spindle, cells_.nodes.front());
    const At top = cut_above ? sweep().lowest_at_limit(spindle, right)
                             : sweep().lowest_at_node(spindle, cells_.nodes.back());
    ForceLanes force;
    if (cut_below) force -= sweep().up_to_limit(!right, bottom);
    At low = bottom;
    for (int k = 0; k < cells_.count(); ++k) {
      At high = top;
      if (k + 1 < cells_.count()) {
        high = sweep().lowest_at_node(spindle, cells_.nodes[k + 1]);
        if (cut_below) high = select(high.point.part > bottom.point.part, high, bottom);
        if (cut_above) high = select(high.point.part < top.point.part, high, top);
      }
      const auto differs = (low.chip.which != high.chip.which) |
                           ((low.chip.value >= 0.0) != (high.chip.value >= 0.0));
      if (walk_.carefully() || any(differs)) {
        const Cell cell = {spindle.at(cells_.middles[k].shift), cells_.middles[k].part};
        high.chip =
            walk_.go(cell, low, high, [&](const auto& point, const auto& chip, const Lanes& edge) {
              (any(edge != 0.0) ? noted_.of_chip : noted_.of_teeth)
                  .push_back({spindle.n, point, chip, edge});
            });
      }
      low = high;
    }
    return force += cut_above ? sweep().up_to_limit(right, low) : sweep().whole(low);
  }

  const Cells<Node>& cells_;
  Passage passage_;
};

}  // namespace millstudy::force
