// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "io/failure_table.h"
#include "io/hdf5_output.h"
#include "io/packed_points.h"
#include "io/result_variables.h"

namespace millstudy::io {

/// What is in a result file (docs/result_file.md), wherever its bytes go.
///
/// Memory: one chunk (512 KiB) a column and the failure table, whatever the number of points. All
/// functions throw hdf5::Error.
class ResultContent {
 public:
  /// Makes the variables, and the attributes Conventions and those of the layout.
  ///
  /// @param output  must outlive this
  /// @throws core::InputError if the layout has more than 32 dimensions
  ResultContent(hdf5::Output& output, const sweep::Layout& layout);

  /// The next points, wherever they were first.
  void append(const sweep::Block& block);
  /// The same, of a file with chunks of the same shape.
  void append(const PackedPoints& points);
  /// In their place, so many points that are not run.
  void leave_out(std::int64_t count);
  /// Writes what is held back, the reasons of failures, and attributes that replace those of the
  /// same name.
  void finish(const std::vector<sweep::Attribute>& attributes);

  const ResultVariables& variables() const { return variables_; }

 private:
  hdf5::Handle file_;
  ResultVariables variables_;
  FailureTable failures_;
};

}  // namespace millstudy::io
