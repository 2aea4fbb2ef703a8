// SPDX-License-Identifier: MIT
#pragma once

namespace millstudy::identify {

/// 97.5 % point of Student's t: a 95 % interval is the estimate +- this times its standard error.
///
/// Within 2e-12 of SciPy's from 1 to 1e6 degrees of freedom (measured).
/// @param degrees_of_freedom  >= 1
double student_975(double degrees_of_freedom);

}  // namespace millstudy::identify
