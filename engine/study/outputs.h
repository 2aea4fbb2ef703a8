// SPDX-License-Identifier: MIT
#pragma once

#include "study/canonical_text.h"

namespace millstudy::study {

/// Every setting that a key has at some point of the study, swept or not.
std::vector<Setting> all_settings(const Key& key, const Study& study, const SettingMap& settings,
                                  const Given& given);

/// What the study asks for, over all of its points.
Outputs asked_outputs(const Study& study, const SettingMap& settings, const Given& given);

/// Adds a fault where no point of the study has samples enough for its harmonics. Where flutes or
/// samples are swept, the points that lack them fail.
void check_outputs(const Study& study, const Given& given, Faults& faults);

}  // namespace millstudy::study
