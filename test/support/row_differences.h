#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "concave_distance/kinematics/constraint_rows.h"
#include "concave_distance/loading/load_scene.h"
#include "distance/kernels/pair_frame.h"
#include "distance/kernels/triangle_distance.h"
#include "support/corner_distance.h"
#include "support/robots.h"

namespace concave_distance::test {

/// Compares rows with differences of distances. Each is computed from the two triangles that the niche's
/// points are on, and from nothing else of the rows: near a local minimum their distance is the niche's; for
/// corners of what is level, by brute force (CornerDistance).
class RowDifferences {
 public:
  static constexpr double kLeastDistance = 1e-3;  // metres; below it rounding is too much of a difference

  /// A row of two bodies that hardly move against each other is compared as if its largest entry were this,
  /// m/rad: the kernel's error of 7e-15 m over a step of 1e-3 of a distance of mm is more than 1e-9.
  static constexpr double kLeastLargest = 1e-3;

  static constexpr std::size_t kCornerShare = 8;  ///< of the rows of corners, one in this is compared

  std::size_t rows = 0;       ///< of closest points, compared
  std::size_t entries = 0;    ///< compared, of rows
  std::size_t one_sided = 0;  ///< of these: the features change within a step, so one side counts
  std::size_t unclear = 0;    ///< entries not compared: the features change on both sides
  std::size_t corners = 0;    ///< rows of corners compared, one in kCornerShare
  std::size_t unknown = 0;    ///< rows of corners not compared: on no vertex and no two edges
  std::size_t near = 0;       ///< rows not compared: nearer than kLeastDistance
  double worst = 0.0;         ///< of all differences, as a share of the row's largest entry

  void add(const ConstraintRows& all, const SceneKinematics& joints, const Eigen::VectorXd& positions,
           SceneState& scratch) {
    for (std::size_t slot = 0; slot < all.rows().size(); ++slot) {
      const ConstraintRow& row = all.rows()[slot];
      if (row.state != SlotState::Used) continue;
      const auto& niches = row.pair->solution.niches;
      const auto niche = std::find_if(niches.begin(), niches.end(),
                                      [&](const TrackedNiche& other) { return other.id == row.niche_id; });
      const Eigen::RowVectorXd gradient = all.jacobian().row(static_cast<Eigen::Index>(slot));
      if (row.is_overlapping || row.value < kLeastDistance) {
        ++near;
      } else if (niche->kind != NicheKind::Point || std::abs(row.value - niche->distance) > 1e-12) {
        if (seen_corners_++ % kCornerShare == 0) addCorner(row, joints, positions, gradient, scratch);
      } else {
        const WitnessPair& witness = niche->witness;
        const auto measure = [&](const Eigen::Isometry3d& a_from_b) {
          return ofTriangles(*row.pair->body_a->mesh, *row.pair->body_b->mesh, witness, a_from_b);
        };
        compare(row.pair, measure, joints, positions, gradient, scratch);
        ++rows;
      }
    }
  }

 private:
  using Measure = CornerDistance::Measure;

  static Measure ofTriangles(const BodyMesh& a, const BodyMesh& b, const WitnessPair& witness,
                             const Eigen::Isometry3d& a_from_b) {
    const detail::PairFrame frame(a, b, a_from_b, witness.triangle_a, witness.triangle_b);
    const TrianglePairDistance found =
        triangleDistance(frame.cornersOfA(witness.triangle_a), frame.cornersOfB(witness.triangle_b));
    return {std::sqrt(found.squared_distance), found.feature_a, found.feature_b};
  }

  static Eigen::Isometry3d relativePose(const TrackedPair& pair, const SceneKinematics& joints,
                                        const Eigen::VectorXd& positions, SceneState& scratch) {
    joints.evaluate(positions, scratch);
    return scratch.world_from_body[pair.origin->body_a]->inverse() *
           *scratch.world_from_body[pair.origin->body_b];
  }

  void addCorner(const ConstraintRow& row, const SceneKinematics& joints, const Eigen::VectorXd& positions,
                 const Eigen::RowVectorXd& gradient, SceneState& scratch) {
    const std::size_t a = row.pair->origin->body_a;
    const std::size_t b = row.pair->origin->body_b;
    const auto corner = CornerDistance::find(*row.pair->body_a->mesh, *row.pair->body_b->mesh,
                                             joints.frameFromBody(a).inverse() * row.point_a_in_frame,
                                             joints.frameFromBody(b).inverse() * row.point_b_in_frame,
                                             relativePose(*row.pair, joints, positions, scratch), row.value);
    if (!corner) {
      ++unknown;
      return;
    }
    ++corners;
    const auto measure = [&](const Eigen::Isometry3d& a_from_b) { return corner->at(a_from_b); };
    compare(row.pair, measure, joints, positions, gradient, scratch);
  }

  enum class Found { Nothing, OneSided, TwoSided };

  /// The derivative by differences of fourth order, or of third order on the side on which the features stay.
  template <typename At>
  static Found slopeAt(const Measure& here, const At& at, double& slope) {
    const auto is_same = [&](const Measure& other) {
      return other.feature_a == here.feature_a && other.feature_b == here.feature_b;
    };
    for (const double share : {1e-3, 1e-4}) {
      const double step = share * std::min(here.distance, 0.1);
      const Measure ahead = at(step);
      const Measure ahead2 = at(2.0 * step);
      const Measure behind = at(-step);
      const Measure behind2 = at(-2.0 * step);
      const bool is_ahead = is_same(ahead) && is_same(ahead2);
      const bool is_behind = is_same(behind) && is_same(behind2);
      if (is_ahead && is_behind) {
        slope =
            (8.0 * (ahead.distance - behind.distance) - ahead2.distance + behind2.distance) / (12.0 * step);
        return Found::TwoSided;
      }
      if (share > 1e-4) continue;  // a shorter step may stay within the features
      for (const double side : {1.0, -1.0}) {
        if (!(side > 0.0 ? is_ahead : is_behind)) continue;
        const Measure first = side > 0.0 ? ahead : behind;
        const Measure second = side > 0.0 ? ahead2 : behind2;
        const Measure third = at(3.0 * side * step);
        if (!is_same(third)) continue;
        slope =
            side *
            (18.0 * first.distance - 11.0 * here.distance - 9.0 * second.distance + 2.0 * third.distance) /
            (6.0 * step);
        return Found::OneSided;
      }
    }
    return Found::Nothing;
  }

  template <typename MeasureAt>
  void compare(const std::shared_ptr<const TrackedPair>& pair, const MeasureAt& measure,
               const SceneKinematics& joints, const Eigen::VectorXd& positions, const Eigen::RowVectorXd& row,
               SceneState& scratch) {
    const double largest = std::max(row.cwiseAbs().maxCoeff(), kLeastLargest);
    const Measure here = measure(relativePose(*pair, joints, positions, scratch));
    const auto at = [&](Eigen::Index velocity, double step) {
      std::size_t robot = 0;
      const auto index = static_cast<std::size_t>(velocity);
      while (robot + 1 < joints.robots().size() && joints.firstVelocity(robot + 1) <= index) ++robot;
      const auto first = static_cast<Eigen::Index>(joints.firstPosition(robot));
      const auto count = static_cast<Eigen::Index>(joints.robots()[robot]->positionNames().size());
      Eigen::VectorXd moved = positions;
      moved.segment(first, count) = stepped(*joints.robots()[robot], positions.segment(first, count),
                                            index - joints.firstVelocity(robot), step);
      return measure(relativePose(*pair, joints, moved, scratch));
    };
    for (Eigen::Index i = 0; i < row.size(); ++i) {
      double slope = 0.0;
      const Found found = slopeAt(
          here, [&](double step) { return at(i, step); }, slope);
      unclear += found == Found::Nothing ? 1 : 0;
      one_sided += found == Found::OneSided ? 1 : 0;
      if (found == Found::Nothing) continue;
      ++entries;
      worst = std::max(worst, std::abs(slope - row[i]) / largest);
    }
  }

  std::size_t seen_corners_ = 0;
};

/// A scene of a robot and what is around it, at random states.
struct RowScene {
  std::string name;
  Scene scene;
  std::shared_ptr<const SceneKinematics> joints;
};

inline RowScene rowScene(const std::string& name, const std::string& urdf, double distance) {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  options.descriptions["robot"] = urdf;
  RowScene made;
  made.name = name;
  made.scene =
      loadSceneText("defaults: {cutoff: " + std::to_string(distance) +
                        ", largest_niche_count: 6}\n"
                        "robots:\n  - {description: robot}\n"
                        "bodies:\n  - {name: board, frame: world, box: {size: [0.4, 0.6, 0.03]}, pose: {xyz: "
                        "[0.6, 0.1, 0.3], rpy: [0.1, 0.2, 0.3]}}\n"
                        "  - {name: back, frame: world, box: {size: [0.03, 0.6, 0.5]}, pose: {xyz: "
                        "[0.8, 0.1, 0.5], rpy: [0.1, 0.2, 0.3]}}\n"
                        "  - {name: post, frame: world, box: {size: [0.1, 0.12, 1.5]}, pose: {xyz: "
                        "[-0.4, 0.4, 0.7], rpy: [0.2, 0.1, 0]}}\n",
                    name, ".", options);
  made.joints = std::make_shared<const SceneKinematics>(made.scene);
  return made;
}

inline std::vector<RowScene> rowScenes(double distance) {
  std::vector<RowScene> scenes;
  scenes.push_back(rowScene("kr5", packageFile("urdf/kr5.urdf"), distance));
  scenes.push_back(rowScene("wam", packageFile("urdf/wam.urdf"), distance));
  scenes.push_back(rowScene("mobile", mobileRobot(), distance));
  return scenes;
}

inline RowDifferences differencesAtRandom(const RowScene& given, double distance, int states, unsigned seed) {
  SceneTracker tracker;
  tracker.setScene(given.scene);
  ConstraintSettings settings;
  settings.distance = distance;
  settings.capacity = 256;
  ConstraintRows rows(given.joints, settings);
  SceneState state = given.joints->startState();
  SceneState scratch = state;
  std::mt19937 engine(seed);
  RowDifferences differences;
  for (int i = 0; i < states; ++i) {
    const Eigen::VectorXd positions = randomPositions(*given.joints->robots().front(), engine);
    given.joints->evaluate(positions, state);
    tracker.update(state.world_from_body, i);
    rows.update(tracker.pairs(), state, i);
    differences.add(rows, *given.joints, positions, scratch);
  }
  return differences;
}

}  // namespace concave_distance::test
