// SPDX-License-Identifier: MIT
#pragma once

#include "cutter/cutter.h"
#include "force/coefficients.h"
#include "force/engagement.h"
#include "force/figures.h"
#include "process/immersion.h"
#include "process/stock.h"

namespace millstudy::process {

/// The spindle, the cutter it turns and the stock it meets, along a path.
struct Machining {
  cutter::Cutter cutter;
  force::Engagement engagement;  ///< where the path is straight, within the stock
  force::Coefficients coefficients;
  double spindle_speed = 0.0;  ///< n [rev/s], > 0
  int angular_steps = 360;     ///< force samples per revolution
  Immersion immersion{};       ///< how the engagement follows the path
  Stock stock = Stock::endless;
  force::FigureRequest figures{};
};

}  // namespace millstudy::process
