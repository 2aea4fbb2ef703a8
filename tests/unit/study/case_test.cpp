// SPDX-License-Identifier: MIT
#include "study/case.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"

namespace millstudy::study {
namespace {

Case slot_case() {
  Case point;
  point.cutter = {cutter::Shape::flat, 12.0, 2, 0.5};
  point.cut.axial_depth = 0.5;
  point.cut.milling = Milling::slot;
  point.cut.spindle_speed = 14500.0 / 60.0;
  point.cut.feed_rate = 29.0;
  return point;
}

TEST(Case, FeedRateAndFeedPerToothAreTwoNamesOfOneThing) {
  Case point = slot_case();
  EXPECT_DOUBLE_EQ(feed_per_tooth(point), 0.06);
  point.cut.feed_rate.reset();
  point.cut.feed_per_tooth = 0.06;
  EXPECT_DOUBLE_EQ(feed_rate(point), 29.0);
}

TEST(Case, RemovesDepthTimesWidthTimesFeed) {
  Case point = slot_case();
  EXPECT_DOUBLE_EQ(material_removal_rate(point), 0.5 * 12.0 * 29.0);
  point.cut.milling = Milling::up;
  point.cut.radial_depth = 3.0;
  EXPECT_NEAR(material_removal_rate(point), 0.5 * 3.0 * 29.0, 1e-12);
  EXPECT_NEAR(radial_immersion(point), 0.25, 1e-15);
  point.cut.milling = Milling::down;
  EXPECT_NEAR(material_removal_rate(point), 0.5 * 3.0 * 29.0, 1e-12);
}

TEST(Case, BallRemovesTheSegmentOfItsCircle) {
  Case point = slot_case();
  point.cutter.shape = cutter::Shape::ball;
  point.cut.axial_depth = 6.0;
  EXPECT_NEAR(material_removal_rate(point), 0.5 * core::kPi * 36.0 * 29.0, 1e-10);
}

TEST(Case, RefusesARadialDepthBeyondTheDiameter) {
  Case point = slot_case();
  point.cut.milling = Milling::up;
  point.cut.radial_depth = 12.5;
  EXPECT_THROW(engagement(point), core::CaseError);
}

}  // namespace
}  // namespace millstudy::study
