// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/open_study.h"
#include "sweep/journal.h"

/// A study whose axes have got more values: what was computed before is used again.
namespace millstudy::cli {

/// Attributes of a result by which a later study finds out whether its points are the same.
std::vector<sweep::Attribute> extension_attributes(const study::Study& study);

/// @throws core::InputError if a result is of another study than this one with other values on its
/// axes, or of another program
void check_extends(const std::string& result, const OpenStudy& open);

/// Puts every point of the study that an old result has into the journal, where its block is not
/// there yet. @return how many
std::int64_t reuse_points(sweep::Journal& journal, const std::string& result,
                          const study::Study& study);

}  // namespace millstudy::cli
