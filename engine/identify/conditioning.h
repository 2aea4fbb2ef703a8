// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cutter/cutter.h"
#include "identify/fit.h"
#include "identify/trace.h"

namespace millstudy::identify {

/// Samples first .. first + count - 1 of a trace.
struct Part {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The longest stretch of whole revolutions in which the tool cuts, without the first and the last
/// of them, (I41): where the force varies over a revolution by at least half of what it does in the
/// strongest tenth of them.
///
/// @throws core::InputError if that leaves less than one revolution
Part cutting_part(const Trace& trace, double spindle_speed);

/// Takes the part out of a trace.
Trace part_of(const Trace& trace, const Part& part);

/// Offset and drift of each axis from air cutting before and after the part in which the tool cuts,
/// (I42), taken off the whole trace: a straight line where there is air at both ends, else a
/// constant.
///
/// @throws core::InputError where less than half a revolution of air was recorded
void remove_air_offset(Trace& trace, double spindle_speed);

/// What is odd about a record, in whole sentences: spikes, forces that repeat another number of
/// times a revolution than there are flutes, axes that would describe the forces far better,
/// (I43)-(I45).
///
/// @throws core::InputError where nothing repeats with the spindle: no cutting, or a wrong speed
std::vector<std::string> look_over(const cutter::Cutter& cutter, const Record& record);

}  // namespace millstudy::identify
