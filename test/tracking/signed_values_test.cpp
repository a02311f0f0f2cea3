// Signed values of niches through contact (SignedPlace).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"
#include "support/random_solids.h"
#include "support/round_bodies.h"

namespace concave_distance::signed_values_test {
namespace {

using namespace test;
using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Scene {
  std::string name;
  Body a;
  Body b;

  double size() const { return std::min(a->diameter(), b->diameter()); }
  double reach() const { return 0.5 * (a->diameter() + b->diameter()); }
};

Body cuboid(double x, double y, double z) {
  return makeBody(makeCuboid(-0.5 * Vector3d(x, y, z), 0.5 * Vector3d(x, y, z)));
}

std::vector<Scene> scenes() {
  RandomEngine engine(5);
  return {{"cuboids", cuboid(1.0, 0.8, 0.6), cuboid(0.5, 0.6, 0.9)},
          {"comb and hook", makeBody(makeComb(3)), makeBody(makeHook())},
          {"stairs and L", makeBody(makeStairs(4)), makeBody(makeLShape())},
          {"star and ring", makeBody(randomStar(engine)), makeBody(randomRing(engine))},
          {"bumpy sphere and cuboid", makeBody(randomBumpySphere(engine)), cuboid(0.8, 0.5, 0.3)},
          {"hook and star", makeBody(makeHook(0.8, 0.5)), makeBody(randomStar(engine))},
          {"sphere and comb", makeRoundBody(sphereOf(0.2)), makeBody(makeComb(3))},
          {"stairs and capsule", makeBody(makeStairs(4)),
           makeRoundBody(roundShape(RoundKind::Capsule, 0.15, 0.4))},
          {"capsules", makeRoundBody(roundShape(RoundKind::Capsule, 0.3, 0.4)),
           makeRoundBody(roundShape(RoundKind::Capsule, 0.2, 0.6))},
          {"cylinder and sphere", makeRoundBody(roundShape(RoundKind::Cylinder, 0.3, 0.3)),
           makeRoundBody(sphereOf(0.3))}};
}

TrackerParameters asked() {
  TrackerParameters parameters;
  parameters.signed_values = true;
  return parameters;
}

Isometry3d movedBy(const Vector3d& linear, const Vector3d& angular, const Isometry3d& pose) {
  Isometry3d motion = Isometry3d::Identity();
  if (angular.norm() > 0.0)
    motion.linear() = Eigen::AngleAxisd(angular.norm(), angular.normalized()).toRotationMatrix();
  motion.translation() = linear;
  return motion * pose;
}

/// The way of B's corners, which no point of it goes farther than.
double wayOf(const BodyMesh& b, const Isometry3d& from, const Isometry3d& to) {
  double way = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Vector3d corner = b.bounds().corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
    way = std::max(way, (from * corner - to * corner).norm());
  }
  return way;
}

/// B comes from where the boxes are apart, goes some way in, and turns meanwhile.
struct Approach {
  Approach(const Scene& scene, std::uint64_t seed) {
    RandomEngine engine(seed);
    start = Isometry3d(randomRotation(engine));
    const Vector3d from = uniformInCube(engine, 1.0).normalized();
    const Vector3d aside = uniformInCube(engine, 0.15 * scene.reach());
    const Vector3d middle = scene.a->bounds().center() - start.linear() * scene.b->bounds().center();
    start.translation() = middle + aside + 1.25 * scene.reach() * from;
    linear = -1.05 * scene.reach() * from;
    turn = uniformInCube(engine, 0.4);
  }
  Isometry3d at(double share) const {
    Isometry3d pose = start;
    pose.linear() =
        Eigen::AngleAxisd(share * turn.norm(), turn.normalized()).toRotationMatrix() * start.linear();
    pose.translation() += share * linear;
    return pose;
  }
  Isometry3d start;
  Vector3d linear;
  Vector3d turn;
};

const TrackedNiche* nicheOf(const PairSolution& solution, std::uint64_t id) {
  for (const TrackedNiche& niche : solution.niches) {
    if (niche.id == id) return &niche;
  }
  return nullptr;
}

TEST(SignedValues, ChangeByNoMoreThanTheBodiesMoveAlongAThousandMotions) {
  constexpr int kSteps = 24;
  std::size_t values = 0;
  std::size_t touches = 0;
  std::size_t jumps = 0;
  std::size_t unknown = 0;
  for (const Scene& scene : scenes()) {
    PairTracker tracker(scene.name, scene.a, scene.b, asked());
    PairSolution before;
    PairSolution now;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const Approach approach(scene, seed);
      tracker.restart();
      for (int k = 0; k <= kSteps; ++k) {
        SCOPED_TRACE(scene.name + ", motion " + std::to_string(seed) + ", step " + std::to_string(k));
        tracker.update(approach.at(static_cast<double>(k) / kSteps), 0.01 * k, now);
        const double way = k == 0 ? 0.0 : wayOf(*scene.b, before.a_from_b, now.a_from_b);
        for (const TrackedNiche& niche : now.niches) {
          const SignedPlace& place = niche.signed_place;
          const TrackedNiche* known = k == 0 ? nullptr : nicheOf(before, niche.id);
          if (place.state != SignedState::Known) {
            ++unknown;
            continue;
          }
          EXPECT_EQ(place.value > 0.0, niche.distance > 0.0);
          EXPECT_EQ(niche.signed_distance, place.value);
          EXPECT_LE(place.gradient_in_a.norm(), 1.0 + 1e-9);
          EXPECT_NEAR((place.point_b_in_a - place.point_a_in_a).norm(), std::abs(place.value), 1e-9);
          if (known == nullptr || known->signed_place.state != SignedState::Known) {
            EXPECT_EQ(place.since_cycle, now.cycle);
            continue;
          }
          ++values;
          if ((place.value > 0.0) != (known->signed_place.value > 0.0)) ++touches;
          const double change = std::abs(place.value - known->signed_place.value);
          if (place.since_cycle < now.cycle) {
            EXPECT_EQ(place.since_cycle, known->signed_place.since_cycle);
            EXPECT_LE(change, way + 2e-9 * scene.size());
            continue;
          }
          ++jumps;
          EXPECT_GT(change, 0.5 * way);
          // Regions or niches have become others.
          const auto solid = [](const Interference& found) {
            return std::count_if(found.regions.begin(), found.regions.end(),
                                 [](const InterferenceRegion& r) { return r.closed; });
          };
          const bool is_explained =
              !now.events.empty() || solid(overlapOf(scene.a, scene.b, before.a_from_b)) !=
                                         solid(overlapOf(scene.a, scene.b, now.a_from_b));
          EXPECT_TRUE(is_explained) << "from " << known->signed_place.value << " to " << place.value
                                    << ", way " << way << ", id " << niche.id;
        }
        std::swap(before, now);
      }
    }
  }
  EXPECT_GE(touches, 1000U);
  EXPECT_GE(jumps, 10U);
  EXPECT_LE(500 * jumps, values);
  EXPECT_LE(20 * unknown, values);
}

TEST(SignedValues, HaveTheGradientOfTheirFiniteDifferences) {
  constexpr double kStep = 3e-5;
  std::size_t smooth = 0;
  std::size_t kinks = 0;
  std::size_t inside = 0;
  for (const Scene& scene : scenes()) {
    PairTracker tracker(scene.name, scene.a, scene.b, asked());
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      RandomEngine engine(1000 + seed);
      const Isometry3d pose = Approach(scene, seed).at(uniformIn(engine, 0.2, 1.0));
      const Vector3d linear = uniformInCube(engine, 0.5);
      const Vector3d angular = uniformInCube(engine, 0.5);
      PairSolution at[3];
      tracker.restart();
      for (const int k : {1, 0, 1, 2}) {
        const double share = (k - 1) * kStep;
        tracker.update(movedBy(share * linear, share * angular, pose), 0.0, at[k]);
      }
      for (const TrackedNiche& niche : at[1].niches) {
        const TrackedNiche* back = nicheOf(at[0], niche.id);
        const TrackedNiche* forth = nicheOf(at[2], niche.id);
        const SignedPlace& place = niche.signed_place;
        if (back == nullptr || forth == nullptr || place.state != SignedState::Known) continue;
        const double rate_back = (place.value - back->signed_place.value) / kStep;
        const double rate_forth = (forth->signed_place.value - place.value) / kStep;
        if (!(std::abs(rate_forth - rate_back) < 3e-4)) {
          ++kinks;
          continue;
        }
        const double rate = place.gradient_in_a.dot(linear + angular.cross(place.pivot_in_a));
        const double error = std::abs(rate - 0.5 * (rate_back + rate_forth));
        EXPECT_LE(error, 1e-5) << scene.name << ", seed " << seed << ", value " << place.value
                               << ", length of the gradient " << place.gradient_in_a.norm() << ", rates "
                               << rate_back << " " << rate_forth << ", expected " << rate;
        ++smooth;
        inside += place.value < 0.0 ? 1U : 0U;
      }
    }
  }
  EXPECT_GE(inside, 250U);
  EXPECT_LE(kinks, smooth / 10);
}

TEST(SignedValues, HaveOneNormalOnBothSidesOfFirstTouch) {
  std::size_t compared = 0;
  double shortest = 1.0;
  for (const Scene& scene : scenes()) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE(scene.name + ", motion " + std::to_string(seed));
      const Approach approach(scene, seed);
      PairTracker tracker(scene.name, scene.a, scene.b, asked());
      PairSolution solution;
      const auto least = [&](double share) {
        tracker.solve(approach.at(share), solution);
        const TrackedNiche* nearest = nullptr;
        for (const TrackedNiche& niche : solution.niches) {
          if (niche.signed_place.state != SignedState::Known) return std::optional<SignedPlace>();
          if (nearest == nullptr || niche.signed_place.value < nearest->signed_place.value) nearest = &niche;
        }
        return nearest != nullptr ? std::optional<SignedPlace>(nearest->signed_place) : std::nullopt;
      };
      double apart = 0.0;
      double touching = 1.0;
      bool is_known = true;
      while (is_known && touching - apart > 1e-7) {
        const double middle = 0.5 * (apart + touching);
        const std::optional<SignedPlace> place = least(middle);
        is_known = place.has_value();
        if (is_known) (place->value > 0.0 ? apart : touching) = middle;
      }
      if (!is_known) continue;
      const std::optional<SignedPlace> outside = least(apart);
      const std::optional<SignedPlace> inside = least(touching);
      if (!outside || !inside || !(inside->value < 0.0)) continue;
      EXPECT_LE(outside->value - inside->value, 1e-6 * scene.reach());
      const double length = inside->gradient_in_a.norm();
      EXPECT_LE((inside->gradient_in_a / length - outside->gradient_in_a).norm(), 1e-4)
          << outside->gradient_in_a.transpose() << ", " << inside->gradient_in_a.transpose();
      shortest = std::min(shortest, length);
      ++compared;
    }
  }
  EXPECT_GE(compared, 150U);
  // An edge goes into an edge: the depth below its walls grows more slowly than the distance fell.
  EXPECT_LT(shortest, 0.9);
}

TEST(SignedValues, OfABoxInAPlateIsItsDepthLessTheMargins) {
  TrackerParameters parameters = asked();
  parameters.margin_a = 0.01;
  parameters.margin_b = 0.02;
  PairTracker tracker("box", cuboid(2.0, 2.0, 1.0), cuboid(0.4, 0.3, 0.2), parameters);
  PairSolution solution;
  for (int k = 0; k <= 40; ++k) {
    const double gap = 0.1 - 0.005 * k;
    tracker.update(translation({0.1, 0.05, 0.6 + gap}), 0.01 * k, solution);
    ASSERT_EQ(solution.niches.size(), 1U);
    const TrackedNiche& niche = solution.niches.front();
    EXPECT_EQ(niche.signed_place.state, SignedState::Known);
    EXPECT_NEAR(niche.signed_place.value, gap, 1e-12);
    EXPECT_NEAR(niche.signed_distance, gap - 0.03, 1e-12);
    EXPECT_NEAR((niche.signed_place.gradient_in_a - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
    EXPECT_EQ(niche.signed_place.since_cycle, 0U);
  }
  // A pair that stands still keeps its answer.
  const SignedPlace before = solution.niches.front().signed_place;
  tracker.update(solution.a_from_b, 1.0, solution);
  ASSERT_EQ(solution.niches.size(), 1U);
  EXPECT_EQ(solution.niches.front().signed_place.value, before.value);
  EXPECT_EQ(solution.niches.front().signed_place.gradient_in_a, before.gradient_in_a);
  EXPECT_EQ(solution.niches.front().signed_place.since_cycle, 0U);
}

/// A table with a long and a short leg, at x = 0 and 0.6 of 0.8.
Body unequalLegs(bool mirrored) {
  Outline outline = {{0.0, 0.0}, {0.2, 0.0}, {0.2, 0.4}, {0.6, 0.4},
                     {0.6, 0.1}, {0.8, 0.1}, {0.8, 0.6}, {0.0, 0.6}};
  if (mirrored) {
    for (Eigen::Vector2d& corner : outline) corner.x() = 0.8 - corner.x();
    std::reverse(outline.begin(), outline.end());
  }
  return makeBody(makeExtrusion(outline, 0.3));
}

TEST(SignedValues, JumpOnlyWherePartsMergeOrSplitAndSaySo) {
  std::size_t jumps = 0;
  std::size_t merges = 0;
  for (const bool mirrored : {false, true}) {
    for (const bool leaves : {false, true}) {
      PairTracker tracker("legs", cuboid(4.0, 2.0, 4.0), unequalLegs(mirrored), asked());
      PairSolution before;
      PairSolution now;
      for (int k = 0; k <= 60; ++k) {
        SCOPED_TRACE(k);
        const double gap = 0.055 - 0.01 * (leaves ? 60 - k : k);
        tracker.update(translation({-0.4, 1.0 + gap, -0.15}), 0.01 * k, now);
        std::vector<double> values;
        const auto at_zero = [](const PairSolution& solution) {
          return std::count_if(solution.niches.begin(), solution.niches.end(),
                               [](const TrackedNiche& niche) { return niche.distance == 0.0; });
        };
        for (const TrackedNiche& niche : now.niches) {
          const SignedPlace& place = niche.signed_place;
          ASSERT_EQ(place.state, SignedState::Known);
          values.push_back(place.value);
          const TrackedNiche* known = k == 0 ? nullptr : nicheOf(before, niche.id);
          if (known == nullptr) continue;
          const double change = std::abs(place.value - known->signed_place.value);
          EXPECT_EQ(place.since_cycle == now.cycle, change > 0.011);
          if (place.since_cycle < now.cycle) continue;
          ++jumps;
          EXPECT_NE(at_zero(before), at_zero(now));
        }
        for (const NicheEvent& event : now.events) merges += event.kind == NicheEvent::Kind::Merge ? 1U : 0U;
        std::sort(values.begin(), values.end());
        ASSERT_FALSE(values.empty());
        EXPECT_NEAR(values.front(), gap, 1e-12);
        if (gap > -0.4 && gap < -0.1) {
          ASSERT_GE(values.size(), 2U);
          EXPECT_NEAR(values[1], gap + 0.1, 1e-12);
        }
        std::swap(before, now);
      }
    }
  }
  EXPECT_GE(jumps, 1U);
  EXPECT_EQ(merges, 2U);
}

TEST(SignedValues, AreTheSameSwappedAndOfBodiesModelledFarAway) {
  std::size_t compared = 0;
  for (const Scene& scene : scenes()) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      SCOPED_TRACE(scene.name + ", motion " + std::to_string(seed));
      const Isometry3d pose = Approach(scene, seed).at(0.75);
      const PairSolution plain = solveOnce(scene.name, scene.a, scene.b, asked(), pose);
      const PairSolution swapped =
          solveOnce(scene.name, scene.b, scene.a, asked(), pose.inverse(Eigen::Isometry));
      ASSERT_EQ(plain.niches.size(), swapped.niches.size());
      const Vector3d far(1e3, -2e3, 500.0);
      std::vector<Vector3d> vertices = scene.b->surface().vertices();
      for (Vector3d& vertex : vertices) vertex += far;
      PairSolution moved;
      if (scene.b->shape() == nullptr) {
        const Body b = makeBody(SurfaceMesh(vertices, scene.b->surface().triangles(), "far"));
        moved = solveOnce(scene.name, scene.a, b, asked(), pose * translation(-far));
        ASSERT_EQ(plain.niches.size(), moved.niches.size());
      }
      for (const TrackedNiche& niche : plain.niches) {
        const SignedPlace& place = niche.signed_place;
        if (place.state != SignedState::Known) continue;
        const auto offIn = [&](const PairSolution& other) {
          double least = std::numeric_limits<double>::infinity();
          for (const TrackedNiche& found : other.niches)
            least = std::min(least, std::abs(found.signed_place.value - place.value));
          return least;
        };
        EXPECT_LE(offIn(swapped), 2e-9 * scene.size());
        if (scene.b->shape() == nullptr) {
          EXPECT_LE(offIn(moved), 2e-9 * scene.size());
        }
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 150U);
}

TEST(SignedValues, SayWhyThereIsNone) {
  const auto state_of = [](const Body& a, const Body& b, const Isometry3d& pose) {
    const PairSolution solution = solveOnce("pair", a, b, asked(), pose);
    for (const TrackedNiche& niche : solution.niches) {
      if (niche.distance > 0.0) continue;
      EXPECT_EQ(std::isnan(niche.signed_place.value), niche.signed_place.state != SignedState::Known);
      EXPECT_EQ(std::isnan(niche.signed_distance), niche.signed_place.state != SignedState::Known);
      return niche.signed_place.state;
    }
    return SignedState::NotAsked;
  };
  const Isometry3d in = translation({0.6, 0.1, 0.05});
  EXPECT_EQ(state_of(cuboid(1.0, 1.0, 1.0), cuboid(0.4, 0.4, 0.4), in), SignedState::Known);
  EXPECT_EQ(state_of(makeBody(makeOpened(makeCuboid(Vector3d::Constant(-0.5), Vector3d::Constant(0.5)), 0)),
                     cuboid(0.4, 0.4, 0.4), in),
            SignedState::OpenSurface);
  const SurfaceMesh cube = makeCuboid(Vector3d::Constant(-0.5), Vector3d::Constant(0.5));
  EXPECT_EQ(state_of(makeBody(makeJoined(cube, cube, {0.5, 0.5, 0.5})), cuboid(0.4, 0.4, 0.4),
                     translation({-0.6, -0.1, -0.05})),
            SignedState::CrossedShells);
  EXPECT_EQ(state_of(cuboid(1.0, 1.0, 1.0), makeRoundBody(roundShape(RoundKind::Cylinder, 0.2, 0.2)), in),
            SignedState::NoClosedForm);
  EXPECT_EQ(state_of(cuboid(1.0, 1.0, 1.0), makeRoundBody(sphereOf(0.2)), in), SignedState::Known);
  EXPECT_EQ(state_of(cuboid(1.0, 1.0, 1.0), makeRoundBody(sphereOf(0.2)), translation({0.4, 0.1, 0.05})),
            SignedState::NoClosedForm);
  // A swallowed body has no place where surfaces meet.
  EXPECT_TRUE(
      solveOnce("pair", cuboid(1.0, 1.0, 1.0), cuboid(0.4, 0.4, 0.4), asked(), translation({0.1, 0.0, 0.0}))
          .niches.empty());
  for (const AccuracyLevel level : {AccuracyLevel::Refined, AccuracyLevel::Nodes}) {
    TrackerParameters parameters = asked();
    parameters.accuracy = level;
    const PairSolution found =
        solveOnce("pair", cuboid(1.0, 1.0, 1.0), cuboid(0.4, 0.4, 0.4), parameters, in);
    ASSERT_FALSE(found.niches.empty());
    const SignedPlace& place = found.niches.front().signed_place;
    EXPECT_EQ(place.state, level == AccuracyLevel::Nodes ? SignedState::NotAsked : SignedState::Known);
    if (level == AccuracyLevel::Refined) {
      EXPECT_NEAR(place.value, -0.1, 1e-12);
    }
  }
  // Nobody has asked.
  const PairSolution plain = solveOnce("pair", cuboid(1.0, 1.0, 1.0), cuboid(0.4, 0.4, 0.4), {}, in);
  EXPECT_EQ(plain.niches.front().signed_place.state, SignedState::NotAsked);
  EXPECT_TRUE(std::isnan(plain.niches.front().signed_distance));
}

TEST(SignedValues, AllocateNothingOnceWarm) {
  const Body hook = makeBody(makeHook(0.8, 0.5));
  PairTracker tracker("hook", makeBody(makeComb(4)), hook, asked());
  PairSolution solution;
  const Scene scene{"hook", makeBody(makeComb(4)), hook};
  const Approach approach(scene, 3);
  std::size_t overlaps = 0;
  std::size_t allocated = 0;
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k <= 40; ++k) {
      const std::size_t before = allocations;
      tracker.update(approach.at(0.4 + 0.015 * (k <= 20 ? k : 40 - k)), 0.01 * (41 * round + k), solution);
      if (round < 2) continue;
      allocated += allocations - before;
      overlaps += solution.status == SolveStatus::Penetrating ? 1U : 0U;
    }
  }
  EXPECT_GE(overlaps, 10U);
  EXPECT_EQ(allocated, 0U);
}

}  // namespace
}  // namespace concave_distance::signed_values_test
