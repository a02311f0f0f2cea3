#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "support/body_pairs.h"
#include "thesis/src/partition/convex_distance.h"
#include "thesis/src/partition/convex_hull.h"
#include "thesis/src/partition/pair_program.h"
#include "thesis/src/partition/piece_solvers.h"

namespace concave_distance::piece_distance_test {
namespace {

using test::randomPose;
using test::translation;
using test::turned;

ConvexPiece box(const Eigen::Vector3d& size) {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 8; ++k) {
    corners.push_back(
        size.cwiseProduct(Eigen::Vector3d((k & 1) - 0.5, ((k >> 1) & 1) - 0.5, ((k >> 2) & 1) - 0.5)));
  }
  return convexHull(corners, "box");
}

ConvexPiece prism(int sides, double radius, double height) {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / sides;
    for (const double z : {-0.5 * height, 0.5 * height}) {
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return convexHull(corners, "prism");
}

PieceDistance byQuadraticProgram(const ConvexPiece& a, const ConvexPiece& b,
                                 const Eigen::Isometry3d& a_from_b) {
  return judgeProposal(a, b, a_from_b, QuadraticPieceSolver(a, b).solve(a_from_b, nullptr));
}

PieceDistance byGjk(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b) {
  return judgeProposal(a, b, a_from_b, solveGjk(GjkShape(a), GjkShape(b), a_from_b));
}

/// The same program in exact arithmetic: CGAL's solver.
double exactDistance(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b) {
  const PieceObjective objective = makePairObjective(a_from_b);
  const PairConstraints constraints = makePairConstraints(a, b);
  CGAL::Quadratic_program<double> program(CGAL::LARGER, false, 0, false, 0);
  for (int row = 0; row < constraints.rows.rows(); ++row) {
    for (int column = 0; column < 6; ++column) program.set_a(column, row, constraints.rows(row, column));
    program.set_b(row, -constraints.offsets[row]);
  }
  for (int i = 0; i < 6; ++i) {
    program.set_c(i, objective.linear[i]);
    for (int j = 0; j <= i; ++j) program.set_d(i, j, 2.0 * objective.weights(i, j));
  }
  program.set_c0(objective.constant);
  const auto solution = CGAL::solve_quadratic_program(program, CGAL::Gmpzf());
  return std::sqrt(std::max(0.0, CGAL::to_double(solution.objective_value())));
}

void expectSound(const PieceDistance& answer, const ConvexPiece& a, const ConvexPiece& b,
                 const Eigen::Isometry3d& a_from_b) {
  const double scale = pieceScale(a, b, a_from_b);
  EXPECT_TRUE(answer.proven) << answer.distance << " " << answer.lower_bound;
  EXPECT_LE(answer.distance - answer.lower_bound, kPieceDistanceTolerance * scale);
  EXPECT_GE(depth(a, answer.points.on_a), -1e-12 * scale);
  EXPECT_GE(depth(b, answer.points.on_b), -1e-12 * scale);
  EXPECT_NEAR((a_from_b * answer.points.on_b - answer.points.on_a).norm(), answer.distance, 1e-12 * scale);
}

TEST(PieceObjective, IsTheSquaredDistanceOfTheTwoPoints) {
  RandomEngine engine(3);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Isometry3d pose = randomPose(engine, 2.0);
    const PieceObjective objective = makePairObjective(pose);
    Vector6 x;
    for (Eigen::Index i = 0; i < 6; ++i) x[i] = 2.0 * uniformUnit(engine) - 1.0;
    const double squared = (x.head<3>() - pose * Eigen::Vector3d(x.tail<3>())).squaredNorm();
    EXPECT_NEAR(value(objective, x), squared, 1e-14);
  }
}

TEST(PieceObjective, HasRankThree) {
  RandomEngine engine(4);
  const PieceObjective objective = makePairObjective(randomPose(engine, 2.0));
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(objective.weights);
  EXPECT_LT(eigen.eigenvalues().head<3>().cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((eigen.eigenvalues().tail<3>().array() - 2.0).abs().maxCoeff(), 1e-14);
}

struct Case {
  const char* name;
  Eigen::Isometry3d pose;  ///< of a box 1 x 2 x 3 in the frame of a cube of side 1
  double distance;
};

TEST(PieceDistance, OfBoxesAtKnownDistancesIsExactByBothSolvers) {
  const ConvexPiece cube = box({1, 1, 1});
  const ConvexPiece bar = box({1, 2, 3});
  const double quarter = 0.25 * 3.14159265358979323846;
  const std::vector<Case> cases = {
      {"parallel faces: a weak minimum of two dimensions", translation({1.25, 0.0, 0.0}), 0.25},
      {"parallel edges: a weak minimum of one dimension", translation({1.3, 1.9, 0.0}), 0.5},
      {"corner to corner", translation({1.0 + 0.2, 1.5 + 0.2, 2.0 + 0.1}), 0.3},
      {"edge to face", turned(quarter, Eigen::Vector3d::UnitZ(), {0.5 + 1.5 / std::sqrt(2.0) + 0.125, 0, 0}),
       0.125},
      {"far", translation({1000.0, 0.0, 0.0}), 999.0},
      {"near", translation({1.0 + 1e-6, 0.1, 0.2}), 1e-6},
      {"touching", translation({1.0, 0.0, 0.0}), 0.0},
      {"overlapping", translation({0.9, 0.1, 0.0}), 0.0},
      {"one in the other", translation({0.0, 0.0, 0.0}), 0.0}};
  for (const Case& c : cases) {
    for (const auto& solve : {byQuadraticProgram, byGjk}) {
      const PieceDistance answer = solve(cube, bar, c.pose);
      EXPECT_NEAR(answer.distance, c.distance, 1e-12 * (1.0 + c.pose.translation().norm())) << c.name;
      expectSound(answer, cube, bar, c.pose);
    }
  }
}

TEST(PieceDistance, AgreesWithExactQuadraticProgrammingAtRandomPoses) {
  const ConvexPiece a = prism(6, 0.1, 0.4);
  const ConvexPiece b = prism(5, 0.07, 0.5);
  RandomEngine engine(11);
  int apart = 0;
  for (int k = 0; k < 150; ++k) {
    const Eigen::Isometry3d pose = randomPose(engine, 0.8);
    const double exact = exactDistance(a, b, pose);
    for (const auto& solve : {byQuadraticProgram, byGjk}) {
      const PieceDistance answer = solve(a, b, pose);
      EXPECT_NEAR(answer.distance, exact, 2e-10) << k;
      if (exact > 1e-6) expectSound(answer, a, b, pose);
    }
    apart += exact > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
}

TEST(PieceDistance, FacesThatAreParallelUpToATinyAngleAreStillProven) {
  // The tilt shortens the distance by less than an active-set solver's own tolerance.
  const ConvexPiece a = box({1, 1, 1});
  const ConvexPiece b = box({1, 2, 3});
  RandomEngine engine(12);
  for (const double tilt : {1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-4}) {
    for (int k = 0; k < 10; ++k) {
      Eigen::Isometry3d pose =
          turned(tilt, Eigen::Vector3d(1.0, uniformUnit(engine), uniformUnit(engine)).normalized(),
                 {0.3 * uniformUnit(engine), 0.2, 2.0 + 0.1 * uniformUnit(engine)});
      const double exact = exactDistance(a, b, pose);
      for (const auto& solve : {byQuadraticProgram, byGjk}) {
        const PieceDistance answer = solve(a, b, pose);
        EXPECT_NEAR(answer.distance, exact, 1e-9) << tilt;
        expectSound(answer, a, b, pose);
      }
    }
  }
}

TEST(PieceDistance, AWarmStartGivesTheSameAnswerWithFewerIterations) {
  const ConvexPiece a = prism(6, 0.1, 0.4);
  const ConvexPiece b = box({0.2, 0.3, 0.1});
  QuadraticPieceSolver solver(a, b);
  std::uint64_t cold = 0;
  std::uint64_t warm = 0;
  PiecePoints last{a.centre, b.centre};
  for (int k = 0; k < 200; ++k) {
    const Eigen::Isometry3d pose =
        turned(0.005 * k, Eigen::Vector3d(1, 2, 3).normalized(), {0.4 - 0.001 * k, 0.1 + 0.0005 * k, 0.2});
    const PieceDistance from_centres = judgeProposal(a, b, pose, solver.solve(pose, nullptr));
    const PieceDistance from_last = judgeProposal(a, b, pose, solver.solve(pose, &last));
    EXPECT_NEAR(from_last.distance, from_centres.distance, 2e-10);
    cold += from_centres.iterations;
    warm += from_last.iterations;
    last = from_last.points;
  }
  EXPECT_LT(warm, 0.8 * static_cast<double>(cold));
}

TEST(PieceDistance, ScalingTheSceneScalesTheAnswerAndFarFramesChangeNothing) {
  RandomEngine engine(13);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Isometry3d pose = randomPose(engine, 1.5);
    const double reference = byQuadraticProgram(box({1, 1, 1}), box({1, 2, 3}), pose).distance;
    Eigen::Isometry3d scaled = pose;
    scaled.translation() *= 1e-4;
    const double small =
        byQuadraticProgram(box(Eigen::Vector3d(1, 1, 1) * 1e-4), box(Eigen::Vector3d(1, 2, 3) * 1e-4), scaled)
            .distance;
    EXPECT_NEAR(small, 1e-4 * reference, 1e-13);
    ConvexPiece moved = box({1, 2, 3});
    const Eigen::Vector3d shift(1e5, -2e5, 1e5);
    for (Eigen::Vector3d& corner : moved.vertices) corner += shift;
    moved = makeConvexPiece(moved.vertices, moved.facets, "moved");
    const Eigen::Isometry3d back = pose * translation(-shift);
    // 4 rounding units of the frame's distance from the body.
    EXPECT_NEAR(byQuadraticProgram(box({1, 1, 1}), moved, back).distance, reference, 1e-9);
  }
}

TEST(PieceDistance, OfASolverThatFailedTheFacetsDecide) {
  const ConvexPiece cube = box({1, 1, 1});
  const Eigen::Isometry3d pose = translation({1.25, 0.0, 0.0});
  PieceProposal failed;
  failed.points = {cube.centre, cube.centre};
  failed.failed = true;
  const PieceDistance answer = judgeProposal(cube, cube, pose, failed);
  EXPECT_DOUBLE_EQ(answer.distance, 0.25);
  EXPECT_TRUE(answer.finished);
  EXPECT_TRUE(answer.proven);
}

}  // namespace
}  // namespace concave_distance::piece_distance_test
