// Whole queries on hard cases against 100 digits: the table of cases times the accuracy levels. What a level
// promises beyond the distance is asked of it below.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <string>
#include <tuple>

#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "numerics/numeric_cases.h"
#include "support/body_pairs.h"
#include "support/exact_query.h"
#include "support/query_bound.h"

namespace concave_distance::query_accuracy_test {
namespace {

using test::NumericCase;
using test::Relation;

const AccuracyLevel kLevels[] = {AccuracyLevel::Refined, AccuracyLevel::Certified};

std::string suiteName() {
  return testing::UnitTest::GetInstance()->current_test_info()->test_suite_name();
}

/// "Contacts" of "Contacts/HardCase": what a case's name is unique within.
std::string keyOf(const NumericCase& numeric_case) {
  const std::string suite = suiteName();
  return suite.substr(0, suite.find('/')) + '/' + numeric_case.name;
}

/// The distance of the surfaces in 100 digits, computed once for all tests of a case.
const test::Wide& truthOf(const NumericCase& numeric_case) {
  static std::map<std::string, test::Wide> known;
  const auto [entry, is_new] = known.try_emplace(keyOf(numeric_case));
  if (is_new) {
    entry->second = test::exactSurfaceDistance(numeric_case.a, numeric_case.b, numeric_case.b_in_a);
  }
  return entry->second;
}

struct Bodies {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
};

/// Ready for the search; those of the last case are kept, since its levels come one after the other.
const Bodies& bodiesOf(const NumericCase& numeric_case) {
  static std::string key;
  static Bodies bodies;
  if (key == keyOf(numeric_case)) return bodies;
  const auto body_of = [&](const SurfaceMesh& surface) {
    BodyMeshOptions options;
    if (numeric_case.coarse_grid) options.max_edge_length = 0.2 * surface.diameter();
    return std::make_shared<const BodyMesh>(numeric_case.name, surface, options);
  };
  bodies = {body_of(numeric_case.a), body_of(numeric_case.b)};
  key = keyOf(numeric_case);
  return bodies;
}

/// One solve, cold and once more warm at the same pose, with the truth.
struct Solved {
  PairSolution cold;
  PairSolution warm;
  double truth;  ///< distance of the surfaces, metres
  test::Wide wide_truth;
  double bound;        ///< metres
  double proof_error;  ///< E of certificate.h, metres
};

Solved solve(const NumericCase& numeric_case, AccuracyLevel level) {
  TrackerParameters parameters;
  parameters.accuracy = level;
  const auto& [a, b] = bodiesOf(numeric_case);
  PairTracker tracker(numeric_case.name, a, b, parameters);
  Solved solved;
  solved.proof_error = kProofError * proofScale(*a, *b, numeric_case.b_in_a.isometry());
  tracker.update(numeric_case.b_in_a.isometry(), 0.0, solved.cold);
  tracker.update(numeric_case.b_in_a.isometry(), 0.1, solved.warm);
  solved.wide_truth = truthOf(numeric_case);
  solved.truth = static_cast<double>(solved.wide_truth);
  solved.bound =
      test::queryBound(numeric_case.a, numeric_case.b, numeric_case.b_in_a.translation, solved.truth);
  return solved;
}

/// Worst errors by suite, printed at the end: what doc/numerics.md keeps. In machine epsilons of the scales.
class WorstErrors : public testing::Environment {
 public:
  static void note(const std::string& suite, const NumericCase& numeric_case, double error,
                   const Solved& solved) {
    constexpr double kEpsilon = 0x1.0p-52;
    const Eigen::Vector3d& shift = numeric_case.b_in_a.translation;
    const double scale = test::localScale(numeric_case.a, numeric_case.b, solved.truth) +
                         0.25 * test::poseScale(numeric_case.a, numeric_case.b, shift);
    Worst& worst = all()[suite];
    if (error / (kEpsilon * scale) >= worst.error) worst = {error / (kEpsilon * scale), numeric_case.name};
  }
  void TearDown() override {
    for (const auto& [suite, worst] : all()) {
      std::cout << "worst: " << suite << ' ' << worst.error << " (" << worst.name << ")\n";
    }
  }

 private:
  struct Worst {
    double error = 0.0;
    std::string name;
  };
  static std::map<std::string, Worst>& all() {
    static std::map<std::string, Worst> worst;
    return worst;
  }
};

const testing::Environment* const kWorstErrors = testing::AddGlobalTestEnvironment(new WorstErrors);

void expectTheTruth(const NumericCase& numeric_case, const PairSolution& solution, const Solved& solved) {
  const double surfaces =
      numeric_case.relation == Relation::Swallowed ? solution.surface_distance : solution.distance;
  const double error =
      static_cast<double>(boost::multiprecision::abs(solved.wide_truth - test::Wide(surfaces)));
  WorstErrors::note(suiteName() + "/" + std::string(toString(solution.accuracy)), numeric_case, error,
                    solved);
  EXPECT_LE(error, solved.bound) << "reported " << surfaces << ", true " << solved.truth;
  // Nearer than the bound nothing tells apart from touching.
  switch (numeric_case.relation) {
    case Relation::Apart:
      EXPECT_TRUE(solution.status == SolveStatus::Ok || solved.truth <= solved.bound) << solved.truth;
      break;
    case Relation::Meeting:
      EXPECT_EQ(solution.status, solution.distance == 0.0 ? SolveStatus::Penetrating : SolveStatus::Ok);
      break;
    case Relation::Swallowed:
      EXPECT_EQ(solution.status, SolveStatus::Penetrating);
      EXPECT_EQ(solution.distance, 0.0);
      break;
  }
}

/// Points on the surfaces, and as far apart as the distance says.
void expectWitnesses(const NumericCase& numeric_case, const PairSolution& solution, const Solved& solved) {
  const double surfaces =
      numeric_case.relation == Relation::Swallowed ? solution.surface_distance : solution.distance;
  // The points are given in A's frame, rounded there.
  const double rounding = 0x1.0p-51 * test::reachOf(numeric_case.a) + 2.0 * solved.bound;
  EXPECT_NEAR((solution.point_b_in_a - solution.point_a_in_a).norm(), surfaces, rounding);
  EXPECT_LE(test::surfaceOffset(solution.point_a_in_a, numeric_case.a), rounding);
  const Eigen::Isometry3d pose = numeric_case.b_in_a.isometry();
  EXPECT_LE(test::surfaceOffset(pose.inverse() * solution.point_b_in_a, numeric_case.b), rounding);
}

void expectBounds(const PairSolution& solution, const Solved& solved) {
  if (solution.accuracy < AccuracyLevel::Refined) return;
  for (const TrackedNiche& niche : solution.niches) {
    EXPECT_GE(niche.distance, solution.distance);
    EXPECT_GE(test::Wide(niche.distance), solved.wide_truth - test::Wide(solved.bound));
    EXPECT_TRUE(niche.proven_local_minimum);
    EXPECT_TRUE(niche.point_a_in_a.allFinite() && niche.point_b_in_a.allFinite());
  }
  if (solution.accuracy < AccuracyLevel::Certified) return;
  EXPECT_LE(test::Wide(solution.lower_bound), solved.wide_truth);
  EXPECT_GE(solution.lower_bound, solution.distance - 1.01 * solved.proof_error - solved.bound);
}

class HardCase : public testing::TestWithParam<std::tuple<NumericCase, AccuracyLevel>> {};

TEST_P(HardCase, IsAnsweredWithinTheStatedBound) {
  const auto& [numeric_case, level] = GetParam();
  const Solved solved = solve(numeric_case, level);
  if (numeric_case.closed_form) {
    EXPECT_NEAR(solved.truth, *numeric_case.closed_form, solved.bound) << "the case is not what it claims";
  }
  if (solved.truth == 0.0) {
    EXPECT_EQ(numeric_case.relation, Relation::Meeting) << "the case is not what it claims";
  }
  for (const PairSolution* solution : {&solved.cold, &solved.warm}) {
    SCOPED_TRACE(solution == &solved.cold ? "cold" : "warm");
    expectTheTruth(numeric_case, *solution, solved);
    expectWitnesses(numeric_case, *solution, solved);
    expectBounds(*solution, solved);
  }
}

/// The proof alone, from no seed, from a bad one and with a tolerance.
class HardProof : public testing::TestWithParam<NumericCase> {};

TEST_P(HardProof, EnclosesTheTruth) {
  const NumericCase& numeric_case = GetParam();
  const auto a = test::makeBody(numeric_case.a);  // a proof needs no search
  const auto b = test::makeBody(numeric_case.b);
  const Eigen::Isometry3d pose = numeric_case.b_in_a.isometry();
  const test::Wide& truth = truthOf(numeric_case);
  const double bound = test::queryBound(numeric_case.a, numeric_case.b, numeric_case.b_in_a.translation,
                                        static_cast<double>(truth));
  const double error = kProofError * proofScale(*a, *b, pose);
  CertificateWorkspace workspace;
  const TrianglePair bad_seed{TriangleIndex{0}, TriangleIndex{b->surface().triangleCount() - 1}};
  for (const double tolerance : {0.0, 1e-3}) {
    for (const std::size_t seed_count : {0U, 1U}) {
      CertificateRequest request;
      request.relative_tolerance = tolerance;
      const DistanceCertificate found =
          certifyDistance(*a, *b, pose, &bad_seed, seed_count, request, workspace);
      EXPECT_LE(test::Wide(found.lower_bound), truth) << found.distance;
      EXPECT_LE(truth, test::Wide(found.distance) + test::Wide(bound));
      EXPECT_GE(found.lower_bound, found.distance - std::max(1.01 * error, tolerance * found.distance));
      if (tolerance == 0.0) {
        EXPECT_LE(static_cast<double>(test::Wide(found.distance) - truth), bound);
        EXPECT_NE(found.status, CertificateStatus::Tolerance);
      }
      EXPECT_EQ(found.status == CertificateStatus::Penetrating, found.distance == 0.0);
    }
  }
}

std::string nameOfProof(const testing::TestParamInfo<NumericCase>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Contacts, HardProof, testing::ValuesIn(test::contactCases()), nameOfProof);
INSTANTIATE_TEST_SUITE_P(Meshes, HardProof, testing::ValuesIn(test::meshCases()), nameOfProof);
INSTANTIATE_TEST_SUITE_P(Poses, HardProof, testing::ValuesIn(test::poseCases()), nameOfProof);
INSTANTIATE_TEST_SUITE_P(ConcaveBodies, HardProof, testing::ValuesIn(test::concaveCases()), nameOfProof);

std::string nameOf(const testing::TestParamInfo<HardCase::ParamType>& info) {
  return std::get<0>(info.param).name + "_" + std::string(toString(std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(Contacts, HardCase,
                         testing::Combine(testing::ValuesIn(test::contactCases()),
                                          testing::ValuesIn(kLevels)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Meshes, HardCase,
                         testing::Combine(testing::ValuesIn(test::meshCases()), testing::ValuesIn(kLevels)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Poses, HardCase,
                         testing::Combine(testing::ValuesIn(test::poseCases()), testing::ValuesIn(kLevels)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(ConcaveBodies, HardCase,
                         testing::Combine(testing::ValuesIn(test::concaveCases()),
                                          testing::ValuesIn(kLevels)),
                         nameOf);

}  // namespace
}  // namespace concave_distance::query_accuracy_test
