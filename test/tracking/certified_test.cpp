// Level `certified`: the distance is the enumerated one whatever the search has met, with its proof.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "concave_distance/base/error.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "distance/kernels/surface_walk.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"

namespace concave_distance::certified_test {
namespace {

using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::translation;

TrackerParameters certified(bool with_niches = true) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = with_niches;
  return parameters;
}

// As good as no search: two random starts at the beginning and nothing afterwards.
TrackerParameters blind(AccuracyLevel level) {
  TrackerParameters parameters;
  parameters.accuracy = level;
  for (GeneticParameters* genetic : {&parameters.cold, &parameters.warm}) {
    genetic->population_size = 2;
    genetic->max_generations = 0;
    genetic->random_immigrants = 0;
  }
  parameters.random_starts = 0;
  return parameters;
}

using test::fiveTeeth;

Isometry3d swaying(double t) {
  return test::swayingComb(t);
}

double exactDistance(const Body& a, const Body& b, const Isometry3d& pose) {
  return std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
}

void expectProven(const PairSolution& solution, double exact, double error) {
  EXPECT_EQ(solution.status, SolveStatus::Ok);
  EXPECT_EQ(solution.accuracy, AccuracyLevel::Certified);
  EXPECT_NEAR(solution.distance, exact, error);
  EXPECT_LE(solution.lower_bound, exact);
  EXPECT_GE(solution.lower_bound, std::max(0.0, solution.distance - 1.01 * error));
  EXPECT_NEAR((solution.point_b_in_a - solution.point_a_in_a).norm(), solution.distance, 1e-9);
}

TEST(Certified, ProvesTheBruteForceDistanceAlongAMotion) {
  for (const bool with_niches : {true, false}) {
    PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), certified(with_niches));
    PairSolution solution;
    for (int k = 0; k < 60; ++k) {
      const Isometry3d pose = swaying(0.02 * k);
      tracker.update(pose, 0.02 * k, solution);
      expectProven(solution, exactDistance(fiveTeeth(), fiveTeeth(), pose),
                   kProofError * proofScale(*fiveTeeth(), *fiveTeeth(), pose));
      ASSERT_EQ(solution.niches.empty(), !with_niches);
      if (with_niches) {
        EXPECT_EQ(solution.niches.front().distance, solution.distance);
      }
    }
  }
}

TEST(Certified, ProvesTheBruteForceDistanceAtRandomPoses) {
  RandomEngine engine(1);
  int apart = 0;
  int crossing = 0;
  for (std::uint32_t round = 0; round < 60; ++round) {
    const Body a = makeBody(test::concaveShape(round), 0.2);
    const Body b = makeBody(test::concaveShape(round / 6), 0.2);
    const Isometry3d pose = test::randomPose(engine, round % 2 == 0 ? 0.5 : 1.5);
    const double exact = exactDistance(a, b, pose);
    for (const bool with_niches : {true, false}) {
      const PairSolution solution = solveOnce("pair", a, b, certified(with_niches), pose);
      if (exact == 0.0) {
        ++crossing;
        EXPECT_EQ(solution.status, SolveStatus::Penetrating);
        EXPECT_EQ(solution.distance, 0.0);
        EXPECT_EQ(solution.lower_bound, 0.0);
        ASSERT_TRUE(solution.meeting_triangles);
        EXPECT_EQ(triangleDistance(trianglePoints(a->surface(), solution.meeting_triangles->a),
                                   [&] {
                                     TrianglePoints t =
                                         trianglePoints(b->surface(), solution.meeting_triangles->b);
                                     for (Vector3d& p : t) p = pose * p;
                                     return t;
                                   }())
                      .squared_distance,
                  0.0);
      } else if (solution.status == SolveStatus::Ok) {
        ++apart;
        expectProven(solution, exact, kProofError * proofScale(*a, *b, pose));
      } else {  // swallowed
        EXPECT_NEAR(solution.surface_distance, exact, 1e-12);
      }
    }
  }
  EXPECT_GT(apart, 20);
  EXPECT_GT(crossing, 20);
}

TEST(Certified, IsRightWhereTheSearchIsBlindAndCountsItsMisses) {
  PairTracker refined("combs", fiveTeeth(), fiveTeeth(), blind(AccuracyLevel::Refined));
  PairTracker proven("combs", fiveTeeth(), fiveTeeth(), blind(AccuracyLevel::Certified));
  PairSolution by_search;
  PairSolution by_proof;
  int wrong = 0;
  int misses = 0;
  int born = 0;
  for (int k = 0; k < 100; ++k) {
    const Isometry3d pose = swaying(0.05 * k);
    refined.update(pose, 0.05 * k, by_search);
    proven.update(pose, 0.05 * k, by_proof);
    const double exact = exactDistance(fiveTeeth(), fiveTeeth(), pose);
    wrong += by_search.distance > exact + 1e-9 ? 1 : 0;
    misses += by_proof.search_miss ? 1 : 0;
    expectProven(by_proof, exact, kProofError * proofScale(*fiveTeeth(), *fiveTeeth(), pose));
    ASSERT_FALSE(by_proof.niches.empty());
    EXPECT_NEAR(by_proof.niches.front().distance, exact, 1e-12);
    EXPECT_TRUE(by_proof.niches.front().proven_local_minimum);
    EXPECT_GT(by_proof.niches.front().id, 0U);
    for (const NicheEvent& event : by_proof.events) {
      born += event.kind == NicheEvent::Kind::Birth && event.id == by_proof.niches.front().id ? 1 : 0;
    }
    if (!by_proof.search_miss) continue;
    // What was missed once is followed from then on.
    proven.update(pose, 0.05 * k, by_proof);
    EXPECT_FALSE(by_proof.search_miss);
  }
  EXPECT_GT(wrong, 0);
  EXPECT_GT(misses, 0);
  EXPECT_GT(born, 0);
}

/// New niches that the search has not proposed, along a motion in leaps.
int missedBy(const TrackerParameters& parameters) {
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), parameters);
  PairSolution solution;
  int missed = 0;
  for (int k = 0; k < 200; ++k) {
    tracker.update(swaying(0.3 * k), 0.02 * k, solution);
    int now = 0;
    for (const TrackedNiche& niche : solution.niches) {
      now += niche.origin == NicheOrigin::FromCones || niche.origin == NicheOrigin::Proven ? 1 : 0;
    }
    EXPECT_EQ(solution.search_miss, k > 0 && now > 0);
    missed += k > 0 ? now : 0;
  }
  return missed;
}

TEST(Certified, ASearchThatSeesMissesLess) {
  TrackerParameters seeing = certified();
  seeing.search_share = 1.0;
  const int by_default = missedBy(certified());
  EXPECT_LT(missedBy(seeing), by_default);
  EXPECT_LT(by_default, missedBy(blind(AccuracyLevel::Certified)));
}

/// One generation with a child of two parents, its population inherited where niches were known; or none.
void expectGeneration(const SearchCost& cost, bool runs, std::size_t known) {
  EXPECT_EQ(cost.generations, runs ? 1U : 0U);
  EXPECT_EQ(cost.children > 0, runs);
  EXPECT_EQ(cost.inherited > 0, runs && known > 0);
}

TEST(Certified, EveryCycleThatMovesBreedsFromTheLastNiches) {
  const Body hook = makeBody(test::makeLShape(), 0.3);
  for (const auto& [a, b] : {std::pair{fiveTeeth(), fiveTeeth()}, std::pair{hook, hook}}) {
    const Isometry3d offset = a == hook ? translation({1.5, 0.1, 0.2}) : Isometry3d::Identity();
    PairTracker tracker("pair", a, b, certified());
    PairSolution solution;
    for (int k = 0; k < 60; ++k) {
      const std::size_t known = k == 0 || k == 30 ? 0 : solution.niches.size();
      if (k == 30) tracker.reset();
      tracker.update(offset * swaying(0.02 * k), 0.02 * k, solution);
      ASSERT_FALSE(solution.niches.empty());
      expectGeneration(solution.cost, true, known);
      // Nothing has moved.
      tracker.update(offset * swaying(0.02 * k), 0.02 * k + 0.01, solution);
      expectGeneration(solution.cost, false, solution.niches.size());
    }
  }
}

TEST(Certified, NoGenerationRunsWhereNoneIsDue) {
  PairSolution solution;
  TrackerParameters near = certified();
  near.cutoff = 1e-3;
  TrackerParameters idle = certified();
  idle.search_share = 0.0;
  for (const TrackerParameters& parameters : {near, idle, certified(false)}) {
    PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), parameters);
    for (int k = 0; k < 3; ++k) {
      tracker.update(translation({0.01 * k, 0.0, 4.0}), 0.01 * k, solution);
      expectGeneration(solution.cost, false, 0);
    }
  }
  const Body box = makeBody(makeBox({1.0, 1.0, 1.0}), 0.3);
  PairTracker convex("boxes", box, box, certified());
  convex.update(translation({1.5, 0.1, 0.2}), 0.0, solution);
  expectGeneration(solution.cost, false, 0);
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), certified());
  tracker.solve(swaying(0.0), solution);
  expectGeneration(solution.cost, false, 0);
  expectGeneration(solveOnce("combs", fiveTeeth(), fiveTeeth(), certified(), swaying(0.0)).cost, false, 0);
}

TEST(Certified, ABudgetThatIsSpentEndsNoGeneration) {
  TrackerParameters hasty = certified();
  hasty.time_budget = 1e-9;
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), hasty);
  PairSolution solution;
  for (int k = 0; k < 10; ++k) {
    tracker.update(swaying(0.02 * k), 0.02 * k, solution);
    EXPECT_EQ(solution.status, SolveStatus::BudgetExhausted);
    EXPECT_EQ(solution.cost.generations, 1U);
    EXPECT_GT(solution.cost.children, 0U);
  }
}

TEST(Certified, TheSearchChangesNoAnswer) {
  for (const double prominence_limit : {0.0, 0.3}) {
    TrackerParameters parameters = certified();
    parameters.prominence_limit = prominence_limit;
    PairTracker with("combs", fiveTeeth(), fiveTeeth(), parameters);
    parameters.search_share = 1.0;
    PairTracker with_more("combs", fiveTeeth(), fiveTeeth(), parameters);
    parameters.search_share = 0.0;
    PairTracker without("combs", fiveTeeth(), fiveTeeth(), parameters);
    PairSolution expected;
    PairSolution solution;
    int evolved = 0;
    for (int k = 0; k < 60; ++k) {
      without.update(swaying(0.05 * k), 0.05 * k, expected);
      for (PairTracker* tracker : {&with, &with_more}) {
        tracker->update(swaying(0.05 * k), 0.05 * k, solution);
        EXPECT_TRUE(solution.niches_complete);
        EXPECT_EQ(solution.distance, expected.distance);
        ASSERT_EQ(solution.niches.size(), expected.niches.size());
        for (std::size_t i = 0; i < solution.niches.size(); ++i) {
          EXPECT_EQ(solution.niches[i].id, expected.niches[i].id);
          EXPECT_EQ(solution.niches[i].point_a_in_a, expected.niches[i].point_a_in_a);
          EXPECT_EQ(solution.niches[i].point_b_in_a, expected.niches[i].point_b_in_a);
          evolved += solution.niches[i].origin == NicheOrigin::Evolved ? 1 : 0;
        }
      }
    }
    EXPECT_GT(evolved, 0) << "prominence limit " << prominence_limit;
  }
}

TEST(Certified, BoundsHoldForEveryToleranceAndBudget) {
  RandomEngine engine(2);
  int within = 0;
  int stopped = 0;
  // A ball in the middle of a hollow one: nearly everything is nearly as near as the nearest.
  const Body hollow = makeBody(test::makeTurned(makeSphere(1.0, 3e-3)), 0.5);
  const Body ball = makeBody(makeSphere(0.5, 3e-3), 0.25);
  for (std::uint32_t round = 0; round < 40; ++round) {
    const bool nested = round % 2 == 0;
    const Body a = nested ? hollow : makeBody(test::concaveShape(round));
    const Body b = nested ? ball : makeBody(test::concaveShape(round + 2));
    Isometry3d pose = test::randomPose(engine, nested ? 0.01 : 0.3);
    if (!nested) pose.translation().x() += 2.5;
    const PairSolution full = solveOnce("pair", a, b, certified(false), pose);
    ASSERT_EQ(full.status, SolveStatus::Ok);
    for (int choice = 0; choice < 4; ++choice) {
      for (const bool with_niches : {false, true}) {
        if (with_niches && round >= 4) continue;
        TrackerParameters parameters = certified(with_niches);
        if (choice == 0) parameters.absolute_tolerance = 0.01;
        if (choice == 1) parameters.relative_tolerance = 0.3;
        if (choice == 2) parameters.time_budget = 1e-9;
        if (choice == 3) parameters.time_budget = 1000.0;  // never, also with a sanitizer
        const PairSolution solution = solveOnce("pair", a, b, parameters, pose);
        EXPECT_LE(solution.lower_bound, full.distance);
        EXPECT_GE(solution.distance, full.distance - 1e-12);
        within += solution.status == SolveStatus::WithinTolerance ? 1 : 0;
        stopped += solution.status == SolveStatus::BudgetExhausted ? 1 : 0;
        if (choice < 2) {
          const double tolerance =
              std::max(parameters.absolute_tolerance, parameters.relative_tolerance * solution.distance);
          EXPECT_GE(solution.lower_bound, solution.distance - tolerance - 1e-12);
          EXPECT_EQ(solution.accuracy, AccuracyLevel::Certified);
          EXPECT_NE(solution.status, SolveStatus::BudgetExhausted);
        }
        if (solution.status == SolveStatus::BudgetExhausted) {
          // What was cut may be the niches alone, after a proof that was finished.
          const bool proven = with_niches && solution.accuracy == AccuracyLevel::Certified;
          EXPECT_TRUE(proven || solution.accuracy == AccuracyLevel::Refined);
          EXPECT_TRUE(!proven || solution.lower_bound >= solution.distance - 1e-12);
          EXPECT_EQ(choice, 2);
        }
      }
    }
  }
  EXPECT_GT(within, 0);
  EXPECT_GT(stopped, 0);
}

TEST(Certified, TellsASwallowedBodyWithAndWithoutNiches) {
  const Body big = makeBody(makeBox({2.0, 2.0, 2.0}), 0.5);
  const Body small = makeBody(makeBox({0.2, 0.2, 0.2}), 0.1);
  for (const bool with_niches : {true, false}) {
    PairTracker tracker("swallowed", big, small, certified(with_niches));
    PairSolution solution;
    double time = 0.0;
    // Out, in by one leap, on in small steps, out by one leap.
    for (const double x : {1.5, 0.5, 0.51, 0.52, -1.2, -1.25, 0.0}) {
      tracker.update(translation({x, 0.0, 0.1}), time += 0.1, solution);
      const double gap = std::abs(std::abs(x) - 1.0) - 0.1;
      if (std::abs(x) > 1.0) {
        EXPECT_EQ(solution.status, SolveStatus::Ok) << x;
        EXPECT_NEAR(solution.distance, gap, 1e-12) << x;
        EXPECT_TRUE(std::isnan(solution.surface_distance));
        continue;
      }
      EXPECT_EQ(solution.status, SolveStatus::Penetrating) << x;
      EXPECT_EQ(solution.distance, 0.0);
      EXPECT_EQ(solution.lower_bound, 0.0);
      EXPECT_NEAR(solution.surface_distance, x == 0.0 ? 0.8 : gap, 1e-12) << x;
      EXPECT_FALSE(solution.meeting_triangles);
      EXPECT_TRUE(solution.niches.empty());
    }
  }
}

TEST(Certified, TellsThatOneOfManyPiecesIsSwallowedThoughAnotherIsNearer) {
  // A holds B's first cube; the second one hovers outside, nearer to the surface than the first.
  const Body a = makeBody(makeBox({2.0, 2.0, 2.0}), 0.5);
  const Body b = makeBody(
      test::makeJoined(makeBox({0.2, 0.2, 0.2}), makeBox({0.2, 0.2, 0.2}), Vector3d(1.15, 0, 0)), 0.1);
  for (const bool with_niches : {true, false}) {
    const PairSolution solution = solveOnce("pieces", a, b, certified(with_niches), Isometry3d::Identity());
    EXPECT_EQ(solution.status, SolveStatus::Penetrating);
    EXPECT_EQ(solution.distance, 0.0);
    EXPECT_NEAR(solution.surface_distance, 0.05, 1e-12);
  }
  const PairSolution swapped = solveOnce("pieces", b, a, certified(), Isometry3d::Identity());
  EXPECT_EQ(swapped.status, SolveStatus::Penetrating);
}

TEST(Certified, AnOpenShellHoldsNothingButCanBeSwallowed) {
  SurfaceMesh box = makeBox({2.0, 2.0, 2.0});
  std::vector<TriangleNodes> open = box.triangles();
  open.pop_back();
  const Body lidless = makeBody(SurfaceMesh(box.vertices(), open, "a box with a hole"), 0.5);
  const Body small = makeBody(makeBox({0.2, 0.2, 0.2}), 0.1);
  const Body sheet = makeBody(test::makeSheet(5, 4, 0.15, 0.1), 0.2);
  const Body solid = makeBody(box, 0.5);
  const Isometry3d inside = translation({0.4, 0.1, -0.1});
  for (const bool with_niches : {true, false}) {
    const PairSolution held = solveOnce("held", lidless, small, certified(with_niches), inside);
    expectProven(held, exactDistance(lidless, small, inside),
                 kProofError * proofScale(*lidless, *small, inside));
    const Isometry3d centred = translation(-sheet->surface().boundingBox().center());
    const PairSolution swallowed = solveOnce("swallowed", solid, sheet, certified(with_niches), centred);
    EXPECT_EQ(swallowed.status, SolveStatus::Penetrating);
    EXPECT_NEAR(swallowed.surface_distance, exactDistance(solid, sheet, centred), 1e-12);
  }
}

TEST(Certified, MayBeAskedForNichesAndNotInTurn) {
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), certified());
  PairSolution solution;
  std::uint64_t largest = 0;
  for (int k = 0; k < 40; ++k) {
    const bool with_niches = k / 5 % 2 == 0;
    tracker.setParameters(certified(with_niches));
    const Isometry3d pose = swaying(0.02 * k);
    tracker.update(pose, 0.02 * k, solution);
    expectProven(solution, exactDistance(fiveTeeth(), fiveTeeth(), pose),
                 kProofError * proofScale(*fiveTeeth(), *fiveTeeth(), pose));
    EXPECT_EQ(solution.niches.size() > 1, with_niches);
    EXPECT_EQ(solution.niches.empty(), !with_niches);
    const std::uint64_t before = largest;
    for (const NicheEvent& event : solution.events) {
      if (event.kind == NicheEvent::Kind::Birth) {
        EXPECT_GT(event.id, before);
        largest = std::max(largest, event.id);
      }
    }
    // At rest nothing is proven again.
    tracker.update(pose, 0.02 * k + 0.01, solution);
    EXPECT_EQ(solution.proof_cost.box_bounds, 0U);
    EXPECT_EQ(solution.status, SolveStatus::Ok);
  }
}

TEST(Certified, RefusesTolerancesAndBudgetsThatMeanNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_refused = [](double TrackerParameters::*value, std::initializer_list<double> wrong) {
    for (const double number : wrong) {
      TrackerParameters parameters = certified();
      parameters.*value = number;
      EXPECT_THROW(parameters.validate("pair"), std::exception) << number;
    }
  };
  expect_refused(&TrackerParameters::absolute_tolerance, {-1e-9, nan, kInfinity});
  expect_refused(&TrackerParameters::relative_tolerance, {-0.1, 1.1, nan});
  expect_refused(&TrackerParameters::time_budget, {-1.0, 0.0, nan});
}

TEST(Certified, SaysWhichTimeBudgetsThereAre) {
  for (const double seconds : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN(), -kInfinity}) {
    TrackerParameters parameters = certified();
    parameters.time_budget = seconds;
    try {
      parameters.validate("pair p");
      ADD_FAILURE() << seconds << " was taken";
    } catch (const Error& error) {
      const std::string message = error.what();
      for (const char* part : {"pair p", "time_budget", "greater than 0 (s)"}) {
        EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
      }
    }
  }
}

}  // namespace
}  // namespace concave_distance::certified_test
