// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "sweep/block.h"
#include "sweep/layout.h"

namespace millstudy::io {

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
/// @param layout  copied where it is needed later
/// @throws core::InputError if the file cannot be written there, or the layout has more than 32
///         dimensions; write() and finish() throw core::ResourceError when the disk is full or
///         fails
std::unique_ptr<sweep::Sink> make_result_writer(const std::string& path,
                                                const sweep::Layout& layout);

}  // namespace millstudy::io
