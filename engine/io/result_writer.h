// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "io/packed_points.h"
#include "io/row_major.h"
#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::io {

/// A sink that takes points as they are packed in another file, too.
class ResultSink : public sweep::Sink {
 public:
  using sweep::Sink::write;
  /// The next points.
  /// @param points  of a file whose chunks have the shape chunk(), that begin where a chunk does
  /// @throws core::ResourceError when the disk is full or fails
  virtual void write(const PackedPoints& points) = 0;
  /// Shape of the chunks of the variables that take a value for every point.
  virtual const Shape& chunk() const = 0;
};

/// A sink that writes the result file of a study (docs/result_file.md), complete or not at all.
///
/// Blocks are streamed into path + ".tmp"; finish() makes it durable and renames it to path. A
/// writer destroyed before that removes the temporary file. It adds the attribute Conventions and
/// everything the layout says; attributes of finish() are added to, or replace, those of the
/// layout.
///
/// Memory: one chunk (512 KiB) a column, the failure table and 4 MiB on their way to the disk,
/// whatever the number of points.
///
/// @param path    folder must exist; an existing file is replaced by finish()
/// @param layout  copied where it is needed later; its chunks are taken, unless they are too small
///                or too large
/// @throws core::InputError if the file cannot be written there, or the layout has more than 32
///         dimensions; write() and finish() throw core::ResourceError when the disk is full or
///         fails
std::unique_ptr<ResultSink> make_result_writer(const std::string& path,
                                               const sweep::Layout& layout);

}  // namespace millstudy::io
