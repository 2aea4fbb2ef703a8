// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <iostream>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "force/nonlinear_force.h"
#include "force/sampler.h"
#include "unit/force/cases.h"

namespace millstudy::force {
namespace {

using testing::distance;
using testing::Force;
using testing::uniform;

/// Unlike: with helix angles that differ from flute to flute, the axes parallel or not.
enum class Axes { parallel, tilted, unlike };

/// A cutter whose axis is offset or tilted, and everything else that a sampler has to do with.
struct RunoutCase {
  cutter::Cutter cutter;
  Engagement engagement;
  std::vector<Arc> arcs;  ///< the engagement's, or with a gap in it
  Coefficients coefficients;
  Feed feed;

  ForceSampler sampler(int steps, bool with_moments = false) const {
    return ForceSampler(cutter, engagement, {}, steps, {}, with_moments).with_arcs(arcs);
  }
};

std::ostream& operator<<(std::ostream& out, const RunoutCase& c) {
  return out << "shape=" << static_cast<int>(c.cutter.shape) << " N=" << c.cutter.flutes
             << " helix_deg=" << core::deg_from_rad(c.cutter.helix_angle)
             << " pitch_angles=" << c.cutter.pitch_angles.size()
             << " offset=" << c.cutter.runout.offset << " angle=" << c.cutter.runout.angle
             << " tilt=" << c.cutter.runout.tilt << " tilt_angle=" << c.cutter.runout.tilt_angle
             << " entry=" << c.engagement.entry_angle << " exit=" << c.engagement.exit_angle
             << " arcs=" << c.arcs.size() << " depth=" << c.engagement.axial_depth
             << " feed=" << c.feed.per_tooth << " direction=" << c.feed.direction;
}

bool flutes_nearly_cross(const cutter::Cutter& cutter, double depth) {
  const CuttingEdges edges(cutter, depth, {});
  double least = 1.0;
  for (int j = 0; j < cutter.flutes; ++j) {
    least = std::min(least, edges.pitch_ratio(j, edges.envelope().lag(depth)));
  }
  return least < 0.1;
}

/// Offsets from a fiftieth of the feed, where every tooth cuts, to five times of it, where most
/// miss their cut; of tilted axes the same at the top of the cut, and some without offset.
RunoutCase random_runout_case(std::mt19937_64& random, Axes axes) {
  using cutter::Shape;
  constexpr std::array<Shape, 4> kShapes = {Shape::flat, Shape::ball, Shape::bull_nose,
                                            Shape::taper};
  RunoutCase c;
  c.cutter = {kShapes[random() % 4], uniform(random, 4.0, 20.0),
              1 + static_cast<int>(random() % 5)};
  if (axes == Axes::unlike) c.cutter.flutes += static_cast<int>(random() % 4);
  const double radius = cutter::radius(c.cutter);
  if (random() % 5) c.cutter.helix_angle = core::rad_from_deg(uniform(random, 2.0, 55.0));
  if (random() % 2) c.cutter.helix_angle = -c.cutter.helix_angle;
  if (c.cutter.shape == Shape::bull_nose) {
    c.cutter.corner_radius = radius * uniform(random, 0.1, 0.9);
  }
  if (c.cutter.shape == Shape::taper) {
    c.cutter.taper_angle = core::rad_from_deg(uniform(random, 1.0, 20.0));
    if (random() % 2) c.cutter.corner_radius = radius * uniform(random, 0.1, 0.5);
  }
  if (random() % 2) {
    std::vector<double>& pitch = c.cutter.pitch_angles;
    for (int j = 0; j < c.cutter.flutes; ++j) pitch.push_back(uniform(random, 0.5, 1.5));
    const double sum = std::accumulate(pitch.begin(), pitch.end(), 0.0);
    for (double& angle : pitch) angle *= 2.0 * core::kPi / sum;
  }
  const double depth = radius * std::pow(10.0, uniform(random, -2.0, 0.5));
  const double a = uniform(random, 0.0, core::kPi), b = uniform(random, 0.0, core::kPi);
  switch (random() % 3) {
    case 0:
      c.engagement = slot(depth);
      break;
    case 1:
      c.engagement = random() % 2
                         ? up_milling(radius, radius * uniform(random, 0.01, 1.9), depth)
                         : down_milling(radius, radius * uniform(random, 0.01, 1.9), depth);
      break;
    default:
      c.engagement = {std::min(a, b), std::max(a, b) + 1e-3 * (core::kPi - std::max(a, b)), depth};
  }
  const Arc arc = c.engagement.arc();
  c.arcs = {arc};
  if (random() % 4 == 0) {
    const double width = arc.exit_angle - arc.entry_angle;
    const double from = arc.entry_angle + width * uniform(random, 0.2, 0.5);
    c.arcs = {{arc.entry_angle, from}, {from + width * uniform(random, 0.1, 0.4), arc.exit_angle}};
  }
  for (double* k : {&c.coefficients.Ktc, &c.coefficients.Krc, &c.coefficients.Kac}) {
    *k = uniform(random, 100.0, 2500.0);
  }
  for (double* k : {&c.coefficients.Kte, &c.coefficients.Kre, &c.coefficients.Kae}) {
    *k = uniform(random, 0.0, 20.0);
  }
  c.feed = {uniform(random, 0.01, 0.2), uniform(random, -10.0, 10.0)};
  c.cutter.runout = {c.feed.per_tooth * std::pow(10.0, uniform(random, -1.7, 0.7)),
                     uniform(random, -4.0, 4.0)};
  if (axes == Axes::unlike) {
    const double middle = core::rad_from_deg(uniform(random, 15.0, 45.0));
    const double range = core::rad_from_deg(uniform(random, 0.1, 5.0));
    const double hand = c.cutter.helix_angle < 0.0 ? -1.0 : 1.0;
    std::vector<double>& helix = c.cutter.helix_angles;
    for (int j = 0; j < c.cutter.flutes; ++j) {
      const bool as_before = j > 0 && random() % 4 == 0;
      helix.push_back(as_before ? helix.back() : hand * (middle + uniform(random, -range, range)));
    }
    if (hand > 0.0 && random() % 10 == 0) helix[random() % helix.size()] = 0.0;
    if (random() % 2) c.cutter.lead = cutter::Lead::constant_helix;
    while (flutes_nearly_cross(c.cutter, depth)) {
      for (double& angle : helix) angle += 0.5 * (hand * middle - angle);
    }
    if (random() % 2) return c;
  } else if (axes == Axes::parallel) {
    return c;
  }
  const double at_top = c.feed.per_tooth * std::pow(10.0, uniform(random, -1.7, 0.7));
  c.cutter.runout.tilt = std::min(std::atan(at_top / depth), core::rad_from_deg(9.9));
  c.cutter.runout.tilt_angle = uniform(random, -4.0, 4.0);
  if (random() % 4 == 0) c.cutter.runout.offset = 0.0;
  if (random() % 2) c.cutter.lead = cutter::Lead::constant_helix;
  return c;
}

/// The sum of all flutes by quadrature, in machine axes.
class Reference {
 public:
  Reference(const RunoutCase& c, Rows rows)
      : case_(c),
        rows_(rows),
        edges_(
            std::make_shared<const CuttingEdges>(c.cutter, c.engagement.axial_depth, Variation{})),
        force_(edges_, {}) {}

  Force at(double spindle_angle) const {
    const double theta = case_.feed.direction;
    Force sum{};
    for (int j = 0; j < case_.cutter.flutes; ++j) {
      const Force flute = force_.of_flute(j, spindle_angle + theta + edges_->flutes()[j].position,
                                          case_.arcs, case_.coefficients, case_.feed, rows_);
      for (int row = 0; row < kRows; ++row) sum[row] += flute[row];
    }
    return {sum[0] * std::cos(theta) - sum[1] * std::sin(theta),
            sum[0] * std::sin(theta) + sum[1] * std::cos(theta), sum[2], sum[3]};
  }

 private:
  const RunoutCase& case_;
  Rows rows_;
  std::shared_ptr<const CuttingEdges> edges_;
  NonlinearForce force_;
};

Force sample_at(const ForceSamples& samples, std::size_t i) {
  return {samples.x[i], samples.y[i], samples.z[i], samples.torque[i]};
}

class ForceSamplerWithRunout : public ::testing::TestWithParam<Axes> {};

std::string name_of(const ::testing::TestParamInfo<Axes>& axes) {
  return axes.param == Axes::parallel ? "Parallel"
         : axes.param == Axes::tilted ? "Tilted"
                                      : "OfUnlikeHelix";
}

INSTANTIATE_TEST_SUITE_P(OfAxes, ForceSamplerWithRunout,
                         ::testing::Values(Axes::parallel, Axes::tilted, Axes::unlike), name_of);

/// Largest disagreement with the reference over the peak, where it is more than what rounding the
/// angle by 4e-15 rad does to the reference.
double disagreement(const RunoutCase& c, const ForceSamples& samples, Rows rows, int steps) {
  const Reference reference(c, rows);
  const double radius = cutter::radius(c.cutter);
  std::vector<Force> expected;
  double peak = 0.0;
  for (int i = 0; i < steps; ++i) {
    expected.push_back(reference.at(2.0 * core::kPi * i / steps));
    peak = std::max(peak, distance(expected.back(), Force{}, radius));
  }
  double worst = 0.0;
  for (int i = 0; i < steps; ++i) {
    double off = distance(sample_at(samples, i), expected[i], radius);
    if (off > 1e-13 * peak) {
      const double angle = 2.0 * core::kPi * i / steps;
      off -= distance(reference.at(angle - 4e-15), reference.at(angle + 4e-15), radius);
    }
    worst = std::max(worst, off);
  }
  return peak > 0.0 ? worst / peak : worst;
}

TEST_P(ForceSamplerWithRunout, IsTheSumOfTheFlutesByQuadrature) {
  constexpr int kCases = 3000;
  std::mt19937_64 random(20261125);
  double worst = 0.0;
  for (int round = 0; round < kCases; ++round) {
    const RunoutCase c = random_runout_case(random, GetParam());
    const int steps = 24 + static_cast<int>(random() % 40);
    ForceSamples samples;
    c.sampler(steps).sample(c.coefficients, c.feed, 0, steps, samples);
    const double found = disagreement(c, samples, Rows::forces, steps);
    EXPECT_LT(found, 1e-12) << c << " steps=" << steps;
    worst = std::max(worst, found);
  }
  std::cout << "runout against quadrature, " << kCases << " cases: " << worst << " of the peak\n";
}

/// So many angles that within every stretch of the revolution some are far from its ends.
TEST_P(ForceSamplerWithRunout, IsTheSumOfTheFlutesAtManyAngles) {
  std::mt19937_64 random(5);
  double worst = 0.0;
  for (int round = 0; round < 200; ++round) {
    const RunoutCase c = random_runout_case(random, GetParam());
    const int steps = 720;
    ForceSamples samples;
    c.sampler(steps).sample(c.coefficients, c.feed, 0, steps, samples);
    const double found = disagreement(c, samples, Rows::forces, steps);
    EXPECT_LT(found, 1e-12) << c << " steps=" << steps;
    worst = std::max(worst, found);
  }
  std::cout << "runout against quadrature, 720 angles: " << worst << " of the peak\n";
}

TEST_P(ForceSamplerWithRunout, MomentsAreTheSumOfTheFlutesByQuadrature) {
  std::mt19937_64 random(3);
  double worst = 0.0;
  for (int round = 0; round < 500; ++round) {
    const RunoutCase c = random_runout_case(random, GetParam());
    const int steps = 24 + static_cast<int>(random() % 40);
    ForceSamples samples;
    c.sampler(steps, true).sample_moments(c.coefficients, c.feed, 0, steps, samples);
    const double found = disagreement(c, samples, Rows::moments, steps);
    EXPECT_LT(found, 1e-12) << c << " steps=" << steps;
    worst = std::max(worst, found);
  }
  std::cout << "moments with runout against quadrature: " << worst << " of the peak\n";
}

TEST_P(ForceSamplerWithRunout, TendsToTheCutterWithoutIt) {
  std::mt19937_64 random(17);
  for (int round = 0; round < 200; ++round) {
    RunoutCase c = random_runout_case(random, GetParam());
    ForceSamples with, without;
    c.cutter.runout.offset = 1e-15;
    if (c.cutter.runout.tilt != 0.0) c.cutter.runout.tilt = 1e-15 / c.engagement.axial_depth;
    c.sampler(90).sample(c.coefficients, c.feed, 0, 90, with);
    c.cutter.runout.offset = c.cutter.runout.tilt = 0.0;
    c.sampler(90).sample(c.coefficients, c.feed, 0, 90, without);
    const double radius = cutter::radius(c.cutter);
    double peak = 0.0, off = 0.0;
    for (int i = 0; i < 90; ++i) {
      peak = std::max(peak, distance(sample_at(without, i), Force{}, radius));
      off = std::max(off, distance(sample_at(with, i), sample_at(without, i), radius));
    }
    EXPECT_LE(off, 2e-11 * peak) << c;
  }
}

bool same_bits(const ForceSamples& a, std::size_t at_a, const ForceSamples& b, std::size_t at_b,
               std::size_t count) {
  const auto same = [&](const std::vector<double>& u, const std::vector<double>& v) {
    return std::memcmp(u.data() + at_a, v.data() + at_b, count * sizeof(double)) == 0;
  };
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.torque, b.torque);
}

TEST_P(ForceSamplerWithRunout, SamplesInPiecesAreThoseAtOnceBitForBit) {
  std::mt19937_64 random(29);
  for (int round = 0; round < 300; ++round) {
    const RunoutCase c = random_runout_case(random, GetParam());
    const int steps = 1 + static_cast<int>(random() % 400);
    const ForceSampler sampler = c.sampler(steps);
    const std::int64_t first = static_cast<std::int64_t>(random() % 2000) - 1000;
    const std::int64_t count = 1 + static_cast<std::int64_t>(random() % 900);
    ForceSamples whole, piece;
    sampler.sample(c.coefficients, c.feed, first, count, whole);
    for (std::int64_t done = 0; done < count;) {
      const std::int64_t part = std::min<std::int64_t>(count - done, random() % 60);
      sampler.sample(c.coefficients, c.feed, first + done, part, piece);
      ASSERT_TRUE(same_bits(whole, done, piece, 0, part)) << c << " at " << done;
      done += part;
    }
  }
}

TEST_P(ForceSamplerWithRunout, IsTheSumOfItsFlutes) {
  std::mt19937_64 random(31);
  for (int round = 0; round < 200; ++round) {
    const RunoutCase c = random_runout_case(random, GetParam());
    const ForceSampler sampler = c.sampler(120);
    ForceSamples all, flute;
    sampler.sample(c.coefficients, c.feed, 7, 120, all);
    std::vector<Force> sum(120);
    double peak = 0.0;
    for (int j = 0; j < c.cutter.flutes; ++j) {
      sampler.sample_flute(j, c.coefficients, c.feed, 7, 120, flute);
      for (int i = 0; i < 120; ++i) {
        const Force of_flute = sample_at(flute, i);
        for (int row = 0; row < kRows; ++row) sum[i][row] += of_flute[row];
        peak = std::max(peak, distance(of_flute, Force{}, cutter::radius(c.cutter)));
      }
    }
    for (int i = 0; i < 120; ++i) {
      // Parts of a flute's force, larger than it is, are added in another order.
      EXPECT_LE(distance(sample_at(all, i), sum[i], cutter::radius(c.cutter)), 4e-14 * peak) << c;
    }
  }
}

/// Of a cutter whose tooth 1 takes over from tooth 2 and gives back within a sixteenth of the edge:
/// the ends of stretches do not tell. Discs ask every tooth at each of their heights.
TEST(TiltedAxis, AToothThatTakesOverForAShortStretchIsNotMissed) {
  cutter::Cutter cutter{cutter::Shape::flat, 15.136921423092065, 4,
                        core::rad_from_deg(23.08241237979032)};
  cutter.pitch_angles = {1.7715132254734351, 1.2235617276148945, 2.2949600300581294,
                         0.99315032403312742};
  cutter.runout = {0.015540814879883361, 2.8247105081220516, 0.0015954260880096667,
                   0.27033885381573164};
  const double depth = 23.372439081950571;
  const std::vector<Arc> arcs = {{2.0116285582847482, 2.52326772580364},
                                 {2.903212242273141, 3.1415926535897931}};
  const Coefficients tangential{1000.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const Feed feed{0.016637744769548431, 3.5935410812799273};
  constexpr int kSteps = 720, kStep = 44, kFlute = 3;

  const auto edges = std::make_shared<const CuttingEdges>(cutter, depth, Variation{});
  const double tip =
      2.0 * core::kPi * kStep / kSteps + feed.direction + edges->flutes()[kFlute].position;
  const auto torque_by = [&](const EdgeRule& rule) {
    return NonlinearForce(edges, rule)
        .of_flute(kFlute, tip, arcs, tangential, feed, Rows::forces)[3];
  };
  ForceSamples samples;
  ForceSampler(cutter, {arcs[0].entry_angle, arcs[1].exit_angle, depth}, {}, kSteps)
      .with_arcs(arcs)
      .sample_flute(kFlute, tangential, feed, kStep, 1, samples);
  const double by_discs = torque_by({Rule::discs, 1000000});
  EXPECT_NEAR(torque_by({}), by_discs, 2e-6 * by_discs);  // 1.5e-5 if it is missed
  EXPECT_NEAR(samples.torque[0], by_discs, 2e-6 * by_discs);
}

/// Of a tooth that misses its cut along a part of its edge. @return the torque by discs
double expect_discs_agree(const cutter::Cutter& cutter, double depth, const Feed& feed, int flute,
                          double tip_angle) {
  const auto edges = std::make_shared<const CuttingEdges>(cutter, depth, Variation{});
  const std::vector<Arc> slot_arc = {{0.0, core::kPi}};
  const Coefficients edge_alone{0.0, 0.0, 0.0, 10.0, 0.0, 0.0};
  const auto torque_by = [&](const EdgeRule& rule) {
    return NonlinearForce(edges, rule)
        .of_flute(flute, tip_angle, slot_arc, edge_alone, feed, Rows::forces)[3];
  };
  const double by_discs = torque_by({Rule::discs, 1000000});
  EXPECT_NEAR(torque_by({}), by_discs, 1e-5 * by_discs);
  return by_discs;
}

TEST(ShortStretch, WithoutChipIsFoundWhereHelixAnglesDiffer) {
  cutter::Cutter cutter{cutter::Shape::flat, 12.0, 5};
  cutter.helix_angles = {0.94062152688782175, 0.80641112527413417, 0.95183665477285595,
                         0.86937988490255436, 0.79356652895868207};
  cutter.runout = {0.11417513258204781, 1.749667241838236};
  expect_discs_agree(cutter, 21.693492728641559, {0.05}, 4, 5.2836278784231583);
}

/// Of edge forces alone, in a slot.
double torque_by_sampler(const cutter::Cutter& cutter, double depth, double feed, int flute,
                         double tip_angle) {
  const double position = CuttingEdges(cutter, depth, {}).flutes()[flute].position;
  ForceSamples samples;
  ForceSampler(cutter, slot(depth), {}, 1)
      .sample_flute(flute, {0.0, 0.0, 0.0, 10.0, 0.0, 0.0}, {feed, tip_angle - position}, 0, 1,
                    samples);
  return samples.torque[0];
}

/// It enters under its own chip of a turn ago, which is zero there, goes over to that of another
/// tooth, loses it, and has it again at the top.
TEST(ShortStretch, WithoutChipIsFoundAfterAnEndWithoutChip) {
  cutter::Cutter cutter{cutter::Shape::flat, 8.22419109203814, 4};
  cutter.pitch_angles = {1.3902748126918212, 1.1247512589704209, 2.2975383352207377,
                         1.4706209002966062};
  cutter.helix_angles = {-0.31271431388296739, -0.2980741760747837, -0.35555633689612753,
                         -0.33311075591624834};
  cutter.runout = {0.0095704535271221702, -0.26755360297137631, 0.032345027891061584,
                   1.1315743646815362};
  const double depth = 11.475762523571351, feed = 0.16182278530822472, tip_angle = -0.05173187;
  const double by_discs = expect_discs_agree(cutter, depth, {feed}, 0, tip_angle);
  EXPECT_NEAR(torque_by_sampler(cutter, depth, feed, 0, tip_angle), by_discs, 1e-7 * by_discs);
}

/// It loses its chip, has it again, goes over to that of another tooth, and loses that.
TEST(ShortStretch, WithoutChipIsFoundBeforeAnEndWithoutChip) {
  cutter::Cutter cutter{cutter::Shape::flat, 13.393653173182177, 5};
  cutter.helix_angles = {1.0057162067651388, 0.98043817076575568, 0.9809431600479025,
                         0.9805115816235197, 0.97762300141606595};
  cutter.runout = {0.0, 2.5168384760209426, 0.015336845511182867, 2.6382648931130674};
  const double depth = 28.488007586844663, feed = 0.063105519234824617,
               tip_angle = 2.5622584229071608;
  const double by_discs = expect_discs_agree(cutter, depth, {feed}, 0, tip_angle);
  EXPECT_NEAR(torque_by_sampler(cutter, depth, feed, 0, tip_angle), by_discs, 1e-7 * by_discs);
}

TEST(ShortStretch, WithoutChipIsFoundWhereTheFeedFalls) {
  cutter::Cutter cutter{cutter::Shape::ball, 12.0, 5, 0.84491558495209385};
  cutter.runout = {0.10128853595906753, 4.3233477356028418};
  expect_discs_agree(cutter, 4.5788620419951762, {0.05, 0.0, -0.073327028905646838}, 0,
                     2.6132741228718346);
}

}  // namespace
}  // namespace millstudy::force
