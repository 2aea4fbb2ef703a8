// SPDX-License-Identifier: MIT
#include "identify/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

#include "core/units.h"
#include "identify/scaled_eigen.h"

namespace millstudy::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Inverse of a symmetric matrix, directions without information left out.
MatrixXd inverse_of(const MatrixXd& matrix) {
  if (matrix.rows() == 0) return matrix;
  const ScaledEigen eigen = scaled_eigen(matrix);
  const double least = 1e-13 * std::max(1e-300, eigen.values.cwiseAbs().maxCoeff());
  VectorXd inverse = eigen.values;
  for (double& value : inverse) value = value > least ? 1.0 / value : 0.0;
  const MatrixXd turned = eigen.scale.asDiagonal() * eigen.vectors;
  return turned * inverse.asDiagonal() * turned.transpose();
}

/// Sums over whole revolutions of one record.
struct Clusters {
  std::vector<NormalEquations> sums;
  NormalEquations all;
  double squares = 0.0;     ///< of the residuals
  double neighbours = 0.0;  ///< sum of products of neighbouring residuals
  std::size_t residuals = 0;
};

/// Fewest parts that a record is taken in: below so many revolutions they are parts of one.
constexpr int kFewestClusters = 8;

Clusters clusters_of(const JointProblem& problem, std::size_t record) {
  const RecordModel& model = problem.model(record);
  const RecordState& state = problem.states()[record];
  const std::vector<Parameter> parameters = problem.parameters();
  const auto size = static_cast<Index>(parameters.size());
  const double residuals = static_cast<double>(model.residuals());
  const double turns = static_cast<double>(model.samples()) / model.record().trace.sampling_rate *
                       state.spindle_speed / core::kTurn;
  const int count = std::max(kFewestClusters, static_cast<int>(turns));
  const NormalEquations none{MatrixXd::Zero(size, size), VectorXd::Zero(size)};
  Clusters out{std::vector<NormalEquations>(count, none), none};
  model.for_each_stretch(state, parameters, [&](Stretch& stretch) {
    problem.weigh(record, stretch);
    const auto cluster_of = [&](int i) {
      return std::min(count - 1,
                      static_cast<int>(static_cast<double>(stretch.first + i) / residuals * count));
    };
    for (int from = 0; from < stretch.samples;) {
      const int cluster = cluster_of(from);
      int to = from + 1;
      while (to < stretch.samples && cluster_of(to) == cluster) ++to;
      NormalEquations& sums = out.sums[cluster];
      for (std::size_t a = 0; a < model.axes().size(); ++a) {
        const Index row = static_cast<Index>(a) * stretch.samples + from;
        const auto j = stretch.jacobian.middleRows(row, to - from);
        const auto r = stretch.residual.segment(row, to - from);
        sums.gram.noalias() += j.transpose() * j;
        sums.gradient.noalias() += j.transpose() * r;
        sums.squares += r.squaredNorm();
        for (int i = 1; i < to - from; ++i) out.neighbours += r[i] * r[i - 1];
      }
      from = to;
    }
    out.residuals += static_cast<std::size_t>(stretch.residual.size());
  });
  for (const NormalEquations& sums : out.sums) {
    out.all.gram += sums.gram;
    out.all.gradient += sums.gradient;
    out.squares += sums.squares;
  }
  return out;
}

/// What is known of the shared parameters from one record once its own are free.
struct Reduced {
  MatrixXd own_inverse;
  MatrixXd own_from_shared;  ///< own parameters move by minus this times the shared ones
  MatrixXd information;
};

Reduced reduce(const MatrixXd& gram, Index shared) {
  const Index own = gram.rows() - shared;
  Reduced out;
  out.own_inverse = inverse_of(gram.bottomRightCorner(own, own));
  out.own_from_shared = out.own_inverse * gram.bottomLeftCorner(own, shared);
  out.information =
      gram.topLeftCorner(shared, shared) - gram.topRightCorner(shared, own) * out.own_from_shared;
  return out;
}

}  // namespace

Uncertainty uncertainty(const JointProblem& problem, double prior_noise) {
  const auto shared = static_cast<Index>(problem.shared().size());
  const auto own = static_cast<Index>(problem.own().size());
  const std::size_t records = problem.records();
  std::vector<Clusters> clusters(records);
  tbb::parallel_for(std::size_t{0}, records,
                    [&](std::size_t r) { clusters[r] = clusters_of(problem, r); });

  Uncertainty out;
  MatrixXd information = MatrixXd::Zero(shared, shared);
  MatrixXd coefficient_gram = MatrixXd::Zero(shared, shared);
  std::vector<Reduced> reduced;
  double squares = 0.0, neighbours = 0.0, residuals = 0.0, groups = 0.0;
  for (const Clusters& of : clusters) {
    reduced.push_back(reduce(of.all.gram, shared));
    information += reduced.back().information;
    coefficient_gram += of.all.gram.topLeftCorner(shared, shared);
    squares += of.squares;
    neighbours += of.neighbours;
    residuals += static_cast<double>(of.residuals);
    groups += static_cast<double>(of.sums.size());
  }
  MatrixXd prior = MatrixXd::Zero(shared, shared);
  for (Index i = 0; i < shared && prior_noise > 0.0; ++i) {
    const Parameter& p = problem.shared()[i];
    if (p.kind != Parameter::Kind::coefficient || p.index >= 6) continue;
    const Known& known = problem.settings().known[p.index];
    if (known.mean) prior(i, i) = std::pow(prior_noise / *known.deviation, 2);
  }
  information += prior;
  const MatrixXd inverse = inverse_of(information);
  const double freedom =
      std::max(1.0, residuals - static_cast<double>(shared + own * static_cast<Index>(records)));
  out.noise = std::sqrt(squares / freedom);
  out.correlation = squares > 0.0 ? neighbours / squares : 0.0;
  out.degrees_of_freedom = std::max(1.0, groups - 1.0);
  out.shared_naive = out.noise * inverse.diagonal().cwiseMax(0.0).cwiseSqrt();

  // What the parameters would be without a revolution: the solution of the linearised problem that
  // lacks it. The sum of the squares of these moves is their variance, whatever correlation there
  // is within revolutions (Bell and McCaffrey's CR3).
  out.shared_covariance = prior_noise * prior_noise * inverse * prior * inverse;
  std::vector<MatrixXd> own_variance(records, MatrixXd::Zero(own, own));
  const double spread = (groups - 1.0) / groups;
  const bool can_leave_out = problem.settings().phase_drift_knots == 0;
  for (std::size_t r = 0; r < records; ++r) {
    for (const NormalEquations& sums : clusters[r].sums) {
      const VectorXd g = sums.gradient;
      MatrixXd left = inverse;
      Reduced without = reduced[r];
      if (can_leave_out) {
        without = reduce(clusters[r].all.gram - sums.gram, shared);
        left = inverse_of(information - reduced[r].information + without.information);
      }
      // Of the others the gradient is zero, so what is left has minus this one's.
      const VectorXd score = g.head(shared) - without.own_from_shared.transpose() * g.tail(own);
      const VectorXd moved = left * score;
      out.shared_covariance += spread * moved * moved.transpose();
      for (std::size_t other = 0; other < records; ++other) {
        VectorXd own_moved = -(other == r ? without : reduced[other]).own_from_shared * moved;
        if (other == r) own_moved += without.own_inverse * g.tail(own);
        own_variance[other] += spread * own_moved * own_moved.transpose();
      }
    }
  }
  for (std::size_t r = 0; r < records; ++r) {
    out.own_error.push_back(own_variance[r].diagonal().cwiseSqrt());
    const MatrixXd& from = reduced[r].own_from_shared;
    const MatrixXd naive = reduced[r].own_inverse + from * inverse * from.transpose();
    out.own_naive.push_back(out.noise * naive.diagonal().cwiseMax(0.0).cwiseSqrt());
  }

  // (I7)
  std::vector<Index> coefficients;
  for (Index i = 0; i < shared; ++i) {
    const Parameter& p = problem.shared()[i];
    if (p.kind == Parameter::Kind::coefficient && p.index < 6) coefficients.push_back(i);
  }
  if (!coefficients.empty()) {
    const ScaledEigen eigen = scaled_eigen(coefficient_gram(coefficients, coefficients));
    const double low = eigen.values.minCoeff(), high = eigen.values.maxCoeff();
    out.condition_number = low > 1e-15 * high ? std::sqrt(high / low) : 1e8;
    out.weakest = eigen.vectors.col(0);
  }
  return out;
}

}  // namespace millstudy::identify
