// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "study/study.h"

namespace millstudy::study {

/// Settings by dotted path, defaults included.
using SettingMap = std::map<std::string_view, Setting>;

/// Everything that decides the values of a result, as text: two studies with the same text have
/// the same result. study_hash is the hash of this.
///
/// Keys in alphabetical order, so that their order in the file does not count; axes in theirs,
/// because it does. Numbers are written so that they read back exactly.
std::string canonical_text(const Study& study, const SettingMap& settings, const Given& given);

/// The same without the values of the axes: of two studies with the same text here, points with the
/// same parameters have the same results.
std::string settings_text(const Study& study, const SettingMap& settings, const Given& given);

}  // namespace millstudy::study
