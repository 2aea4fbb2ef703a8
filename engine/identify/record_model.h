// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "identify/fit_parameters.h"

namespace millstudy::identify {

/// Some samples of a record: what the model says there less what was measured, and its
/// derivatives. Rows: all samples along the first fitted axis, then along the next.
struct Stretch {
  std::size_t first = 0;  ///< residual of each axis
  int samples = 0;
  Eigen::VectorXd residual;   ///< [N]; shape (axes * samples)
  Eigen::MatrixXd jacobian;   ///< shape (axes * samples, parameters)
  Eigen::VectorXd predicted;  ///< [N]; shape (axes * samples)
};

/// The forces of one record by the model (I1), and their derivatives.
class RecordModel {
 public:
  RecordModel(const cutter::Cutter& cutter, const Record& record, const FitSettings& settings);

  /// Axes that are measured and fitted, ascending.
  const std::vector<int>& axes() const { return axes_; }
  std::size_t samples() const { return record_.trace.size(); }
  const Record& record() const { return record_; }
  /// Middle of the record after its first sample [s].
  double middle() const;
  /// Mean feed per tooth at a spindle speed [mm].
  double feed_per_tooth(double spindle_speed) const;
  /// Immersion angle of flute 0's tip at a sample, which may be before the first [rad].
  double angle_at(const RecordState& state, double sample) const;

  /// Residuals per axis that for_each_stretch() has in all: the samples, or fewer below a
  /// frequency.
  std::size_t residuals() const {
    return below_ > 0.0 ? measured_below_.front().size() : samples();
  }

  /// Visits stretches of residuals from the first to the last; kernels run on all threads, visits
  /// one by one. Below a frequency (FitSettings::below) residuals are those of filtered forces,
  /// four for each period of that frequency.
  void for_each_stretch(const RecordState& state, std::span<const Parameter> parameters,
                        const std::function<void(Stretch&)>& visit) const;

  /// The same of the forces as they are, sample by sample.
  void for_each_sample(const RecordState& state, std::span<const Parameter> parameters,
                       const std::function<void(Stretch&)>& visit) const;

 private:
  std::vector<double> thinned(std::span<const double> signal) const;
  cutter::Cutter cutter_;
  const Record& record_;
  force::ForceSensitivity::Wanted wanted_;
  std::vector<int> axes_;
  double below_;
  std::vector<std::vector<double>> measured_below_;  ///< by fitted axis
};

}  // namespace millstudy::identify
