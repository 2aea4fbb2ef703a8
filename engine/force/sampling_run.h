// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "force/harmonics.h"
#include "force/lanes.h"
#include "force/series.h"
#include "force/unit_circle.h"

namespace millstudy::force {

/// An angle with its cosine and sine.
struct Angle {
  explicit Angle(double angle) : value(angle), cosine(std::cos(angle)), sine(std::sin(angle)) {}
  double value;  ///< [rad]
  double cosine;
  double sine;
};

/// Cosines and sines of 2 pi n / S and of its double, for the n after which the force repeats,
/// padded by one vector.
struct AngleTables {
  /// @param teeth  that are alike and equally spaced: the force repeats so often in a revolution
  AngleTables(int angular_steps, int teeth);

  int teeth;
  int period;   ///< S / gcd(S, teeth): the force at n and n + period is the same
  double step;  ///< 2 pi / S [rad]
  double steps_per_rad;
  std::shared_ptr<const UnitCircle> circle;
  const double* cos1;
  const double* sin1;
  std::vector<double> cos2;
  std::vector<double> sin2;
  std::vector<double> cos_pitch;  ///< of 2 pi q / teeth, shape (teeth)
  std::vector<double> sin_pitch;
};

/// One tooth passing through the tables: at index n its tip stands at offset + n step.
struct Pass {
  double offset;  ///< [rad], not reduced
  double cosine;  ///< of the offset
  double sine;
};

/// Indices first .. last - 1.
struct IndexRange {
  int first;
  int last;
};

/// Which end of an interval of angles belongs to it; it only matters at zero helix.
enum class Closed { above, below };

/// One contiguous run of samples being added up: what the prepared edges write to.
///
/// Every add_ function evaluates its formula at the indices given, a vector at a time, and adds it
/// to the rows. Sample n gets the same bits whatever else is in the run.
class SamplingRun {
 public:
  using Row = Harmonics::Row;

  /// @param direction  feed direction theta, reduced to +-pi
  /// @param rows       x, y, z, torque of index `first`: last - first values, to be overwritten,
  ///                   and then room for one vector
  SamplingRun(const AngleTables& tables, const Angle& direction, IndexRange indices,
              std::array<double*, kRows> rows);

  /// The teeth that follow stand at this angle ahead of the tip of flute 0, and at all angles that
  /// differ from it by the pitch of equal teeth.
  void begin_tooth(const Angle& position) {
    zero_ = direction_.value + position.value;
    zero_cosine_ = direction_.cosine * position.cosine - direction_.sine * position.sine;
    zero_sine_ = direction_.sine * position.cosine + direction_.cosine * position.sine;
  }

  const Angle& direction() const { return direction_; }

  /// To be called when all is added: makes samples zero that nothing was added to.
  void finish();

  /// Calls visit(pass) for every pass of a tooth whose tip can be between two angles [rad]: tooth
  /// after tooth, turn after turn, for these differ by multiples of the pitch alone.
  template <class Visit>
  void for_each_pass(double from, double to, const Visit& visit) const {
    constexpr double kMargin = 1e-9;  // an empty pass too many does no harm
    const double whole = tables_.step * tables_.period;
    const auto first =
        static_cast<std::int64_t>(std::ceil((from - zero_ - whole) * per_pitch_ - kMargin));
    const auto last = static_cast<std::int64_t>(std::floor((to - zero_) * per_pitch_ + kMargin));
    for (std::int64_t q = first; q <= last; ++q) visit(pass(q));
  }

  const AngleTables& tables() const { return tables_; }

  /// Runs evaluate(n, x, y, z, torque) over indices and adds the lanes it fills in. The first to
  /// come writes and puts zeros around it: most of a revolution is then touched once, not twice.
  template <class Evaluate>
  void accumulate(IndexRange indices, const Evaluate& evaluate);

  /// Indices of the run at which the tip of a pass is between two angles [rad].
  IndexRange between(const Pass& pass, double from, double to, Closed closed) const;

  /// Adds harmonics of the tip angle of a pass.
  void add(const Pass& pass, IndexRange indices, const Harmonics& force);

  /// Adds harmonics and slope (x, y, z, torque) times (tip angle - origin).
  void add(const Pass& pass, IndexRange indices, const Harmonics& force, const Row& slope,
           double origin);

  static constexpr int kTaylorTerms = 12;
  using Taylor = std::array<Row, kTaylorTerms>;
  /// Adds sum_m terms[m] d^(m+1), d = sign (tip angle - origin).
  void add_taylor(const Pass& pass, IndexRange indices, const Taylor& terms, double sign,
                  double origin);

  /// Adds the series of terms[4 m + row], t the variable of the part d / length, where
  /// d = sign (tip angle - origin) goes from 0 to length.
  void add_series(const Pass& pass, IndexRange indices, const std::vector<double>& terms,
                  Terms kind, double sign, double origin, double length,
                  const SeriesVariable& variable);

  /// The same of Chebyshev series, t going from -1 to 1 with the fourth root of d / length.
  void add_quartic_chebyshev(const Pass& pass, IndexRange indices, const std::vector<double>& terms,
                             double sign, double origin, double length);

 private:
  template <class Variable>
  void add_series_in(const Pass& pass, IndexRange indices, const std::vector<double>& terms,
                     Terms kind, double sign, double origin, double length,
                     const Variable& variable);
  Pass pass(std::int64_t q) const;
  void put_zeros(IndexRange indices);

  const AngleTables& tables_;
  Angle direction_;
  double zero_ = 0.0;  // of the tip at index 0
  double zero_cosine_ = 1.0;
  double zero_sine_ = 0.0;
  double per_pitch_;
  IndexRange indices_;
  std::array<double*, kRows> rows_;
  bool written_ = false;
};

template <class Evaluate>
[[gnu::always_inline]] inline void SamplingRun::accumulate(IndexRange indices,
                                                           const Evaluate& evaluate) {
  if (indices.first >= indices.last) return;
  const bool first = !written_;
  for (int n = indices.first; n < indices.last; n += kLanes) {
    const int count = indices.last - n;
    const int at = n - indices_.first;
    Lanes x, y, z, torque;
    evaluate(n, x, y, z, torque);
    add_to(rows_[0] + at, x, count, first);
    add_to(rows_[1] + at, y, count, first);
    add_to(rows_[2] + at, z, count, first);
    add_to(rows_[3] + at, torque, count, first);
  }
  if (!first) return;
  put_zeros({indices_.first, indices.first});
  put_zeros({indices.last, indices_.last});
  written_ = true;
}

}  // namespace millstudy::force
