// SPDX-License-Identifier: MIT
#pragma once

#include "identify/fit_parameters.h"

namespace millstudy::identify {

/// Where the search of a record begins: near its global optimum, found without a guess, (I3).
///
/// Of the force over one revolution, averaged over all of them: every phase is tried with the
/// coefficients that fit it best, then the most promising phases with runouts in eight directions
/// are each followed to their least.
///
/// @param spindle_speed  the actual one [rad/s]
RecordState find_start(const cutter::Cutter& cutter, const Record& record,
                       const FitSettings& settings, double known_phase, double spindle_speed);

/// Part of the variance of one averaged revolution that the model leaves at the phase and with the
/// coefficients that fit it best, 0 .. 1; 1 where the tangential coefficient would be negative.
///
/// @param turn  its trace is a synchronous_average()
double unexplained_part(const cutter::Cutter& cutter, const Record& turn);

/// Counts flutes from another one, `steps` ahead: of equal flutes the same cut.
void renumber_flutes(RecordState& state, int flutes, int steps);

}  // namespace millstudy::identify
