// SPDX-License-Identifier: MIT
#include "force/unit_circle.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace millstudy::force {
namespace {

std::shared_ptr<const UnitCircle> make(int angular_steps, int count) {
  auto circle = std::make_shared<UnitCircle>();
  circle->cosine.reserve(count);
  circle->sine.reserve(count);
  for (int n = 0; n < count; ++n) {
    const double angle = core::kTurn * n / angular_steps;
    circle->cosine.push_back(std::cos(angle));
    circle->sine.push_back(std::sin(angle));
  }
  return circle;
}

}  // namespace

std::shared_ptr<const UnitCircle> UnitCircle::of(int angular_steps, int count) {
  constexpr int kMostShared = 1 << 16;
  constexpr int kBeyond = 16;  // a vector after the last is asked for
  if (angular_steps > kMostShared || count > angular_steps + kBeyond) {
    return make(angular_steps, count);
  }
  thread_local int steps = 0;
  thread_local std::shared_ptr<const UnitCircle> circle;
  if (steps != angular_steps) {
    circle = make(angular_steps, angular_steps + kBeyond);
    steps = angular_steps;
  }
  return circle;
}

}  // namespace millstudy::force
