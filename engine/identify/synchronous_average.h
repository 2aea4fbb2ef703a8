// SPDX-License-Identifier: MIT
#pragma once

#include "identify/trace.h"

namespace millstudy::identify {

/// One revolution of the spindle, averaged over all of a record, (I40).
///
/// As many bins as samples in a revolution, 24 to 360; those that no sample falls into are filled
/// from both sides. Bin i is at the angle (i + 1/2) 2 pi / bins past the spindle's position at the
/// middle of the record.
///
/// @param spindle_speed  the actual one [rad/s]
/// @return a trace of one sample a bin, over one revolution
Trace synchronous_average(const Trace& trace, double spindle_speed);

}  // namespace millstudy::identify
