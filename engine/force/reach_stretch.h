// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "force/runout_stretch.h"

/// (F33): the force of a stretch of edge under one reach.
namespace millstudy::force {

/// Of one coefficient set and feed along one piece, in axes turned by an angle.
class ReachStretch {
 public:
  /// @param series  chip moments under sin(phi), still ones under the distance that the tooth
  ///                stands out, over `size`
  /// @param feed    that the chip moments are times [mm]
  /// @param cosine, sine  of the angle from feed axes to those of the rows
  ReachStretch(const MomentSeries& series, double size, const Coefficients& k, double feed,
               double cosine, double sine)
      : variable_(series.variable), kind_(series.kind) {
    const auto put = [&](const EdgeMoments& moments, Worths& chip, Worths& all) {
      all = worths(moments, k, cosine, sine);
      const auto still = still_worths(
          {size * k.Ktc, size * k.Krc, size * k.Kac},
          [&](int column, int i) { return moments.plunge(column, i); }, cosine, sine);
      for (int i = 0; i < kChipWorths; ++i) chip[i] = all[i] *= feed;
      for (int i = kChipWorths; i < kWorths; ++i) {
        chip[i] = still[i - kChipWorths];
        all[i] += chip[i];
      }
    };
    Worths chip;
    put(series.whole, chip, whole_);
    chip_.resize(series.terms.size());
    all_.resize(series.terms.size());
    for (std::size_t m = 0; m < series.terms.size(); ++m) put(series.terms[m], chip_[m], all_[m]);
  }

  /// All of the piece, its upper end at an immersion angle, with the edge forces.
  [[gnu::always_inline]] ForceLanes whole(const SineAndCosine& upper) const {
    return RunoutStretch::force(whole_, upper, unit());
  }

  /// The piece from its lower end up to a part of it, where the immersion angle is `upper`.
  [[gnu::always_inline]] ForceLanes up_to(const Lanes& part, const SineAndCosine& upper) const {
    return sum(all_, part, upper);
  }
  /// Without the edge forces.
  [[gnu::always_inline]] ForceLanes chip_up_to(const Lanes& part,
                                               const SineAndCosine& upper) const {
    return sum(chip_, part, upper);
  }

 private:
  using Worths = std::array<double, kWorths>;

  [[gnu::always_inline]] ForceLanes sum(const std::vector<Worths>& terms, const Lanes& part,
                                        const SineAndCosine& upper) const {
    return RunoutStretch::force(
        sum_series<kWorths, kWorths>(kind_, terms.front().data(), terms.size(), variable_.at(part)),
        upper, unit());
  }

  static Line unit() { return {{Lanes{}, Lanes{} + 1.0}, Lanes{} + 1.0}; }

  SeriesVariable variable_;
  Terms kind_;
  Worths whole_;
  std::vector<Worths> chip_;  ///< terms, the still part of the chip in the place of the edge
  std::vector<Worths> all_;   ///< and with the edge
};

}  // namespace millstudy::force
