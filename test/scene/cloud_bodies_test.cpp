// Bodies of voxels: their distances against those of the cubes one by one, and which points are left out.
#include "scene/cloud_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "scene/scene_edits.h"
#include "support/box_scene.h"
#include "support/case_seed.h"

namespace concave_distance::cloud_bodies_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

double boxDistance(const Vector3d& low_a, const Vector3d& high_a, const Vector3d& low_b,
                   const Vector3d& high_b) {
  return (low_a - high_b).cwiseMax(low_b - high_a).cwiseMax(0.0).norm();
}

/// Returns the distance of an axis-aligned box to the nearest cell.
double nearestCell(const VoxelGrid& grid, const Vector3d& low, const Vector3d& high) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const VoxelCell& cell : grid.cells()) {
    const Vector3d corner = grid.size() * Vector3d(cell[0], cell[1], cell[2]);
    nearest = std::min(nearest, boxDistance(low, high, corner, corner + Vector3d::Constant(grid.size())));
  }
  return nearest;
}

PairSolution solve(const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b,
                   const Vector3d& at, bool niches = false) {
  TrackerParameters parameters;
  parameters.niches_wanted = niches;
  return solveOnce("cloud/probe", a, b, parameters, Isometry3d(Eigen::Translation3d(at)));
}

std::shared_ptr<const BodyMesh> box(const Vector3d& sizes) {
  return std::make_shared<const BodyMesh>("box", makeBox(sizes));
}

TEST(CloudBodies, DistancesAreThoseOfTheNearestCell) {
  RandomEngine engine(test::caseSeed(21));
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.5);
  const Vector3d half(0.05, 0.08, 0.02);
  const auto probe = box(2.0 * half);
  for (const double share : {0.05, 0.2, 0.5}) {
    VoxelGrid grid(0.1);
    for (int i = 0; i < 125; ++i) {
      if (chance(engine) < share) grid.insert({i % 5, i / 5 % 5, i / 25});
    }
    const auto cloud = detail::makeCloudMesh("cloud", grid);
    for (int i = 0; i < 200; ++i) {
      const Vector3d at(coordinate(engine), coordinate(engine), coordinate(engine));
      const double expected = nearestCell(grid, at - half, at + half);
      const PairSolution solution = solve(cloud, probe, at);
      EXPECT_NEAR(solution.distance, expected, 1e-12) << at.transpose();
      EXPECT_NEAR(solution.lower_bound, expected, 1e-9) << at.transpose();
      EXPECT_LE(solution.lower_bound, expected + 1e-12);
      EXPECT_EQ(solution.status == SolveStatus::Penetrating, expected == 0.0) << at.transpose();
      if (expected > 0.0) {
        EXPECT_NEAR((solution.point_b_in_a - solution.point_a_in_a).norm(), expected, 1e-12);
      }
    }
  }
}

// As reported for octrees and boxes at fcl#640 (9 m too far), #639 (points that are not that far apart):
// three voxels of 0.1 m around points, a box of 1 m, and one of 0.1 m.
TEST(CloudBodies, ReportedCasesOfOctreesAreRight) {
  VoxelGrid grid(0.1);
  for (const Vector3d& point : {Vector3d(1.0, 0.0, 0.0), Vector3d(9.0, 0.0, 0.0), Vector3d(12.0, 0.0, 1.0)}) {
    VoxelCell cell{};
    ASSERT_TRUE(grid.locate(point + Vector3d::Constant(1e-6), cell));
    grid.insert(cell);
  }
  const auto cloud = detail::makeCloudMesh("cloud", grid);
  for (const auto& [edge, at] : {std::pair(1.0, Vector3d(10.0, 0.0, 0.0)), {0.1, Vector3d(10.0, 0.0, 5.0)}}) {
    const Vector3d half = Vector3d::Constant(0.5 * edge);
    const PairSolution solution = solve(cloud, box(2.0 * half), at);
    EXPECT_NEAR(solution.distance, nearestCell(grid, at - half, at + half), 1e-12);
    const Vector3d& on_cloud = solution.point_a_in_a;
    const Vector3d& on_box = solution.point_b_in_a;
    EXPECT_NEAR((on_cloud - on_box).norm(), solution.distance, 1e-12);
    EXPECT_LE(boxDistance(on_box, on_box, at - half, at + half), 1e-12);
    EXPECT_LE(nearestCell(grid, on_cloud, on_cloud), 1e-12);
  }
}

// As reported at moveit#3038 and #3456, where the closest point stays the same wherever the robot is.
TEST(CloudBodies, TheClosestVoxelChangesAsALinkMovesAlongAMap) {
  VoxelGrid grid(0.05);
  for (int x = 0; x < 60; ++x) {
    for (int z = 0; z < 20; ++z) grid.insert({x, 10 + (x * 7 + z * 3) % 5, z});
  }
  const auto cloud = detail::makeCloudMesh("cloud", grid);
  const Vector3d half(0.03, 0.1, 0.03);
  const auto link = box(2.0 * half);
  PairTracker tracker("cloud/link", cloud, link, TrackerParameters());
  PairSolution solution;
  double least_x = 10.0;
  double most_x = -10.0;
  for (int i = 0; i <= 300; ++i) {
    const Vector3d at(0.01 * i, 0.2, 0.3 + 0.2 * std::sin(0.1 * i));
    tracker.update(Isometry3d(Eigen::Translation3d(at)), 0.02 * i, solution);
    EXPECT_NEAR(solution.distance, nearestCell(grid, at - half, at + half), 1e-12) << i;
    least_x = std::min(least_x, solution.point_a_in_a.x());
    most_x = std::max(most_x, solution.point_a_in_a.x());
  }
  EXPECT_LT(least_x, 0.1);
  EXPECT_GT(most_x, 2.8);
}

TEST(CloudBodies, CellsThatTouchAtAnEdgeOrCornerHaveTheGapBetweenThem) {
  for (const VoxelCell& other : {VoxelCell{1, 1, 0}, VoxelCell{1, 1, 1}}) {
    VoxelGrid grid(1.0);
    grid.insert({0, 0, 0});
    grid.insert(other);
    const auto cloud = detail::makeCloudMesh("cloud", grid);
    const Vector3d half = Vector3d::Constant(0.2);
    const auto probe = box(2.0 * half);
    // In the free corner beside the edge at x = 1, y = 1, as near to both cells.
    for (const double gap : {0.3, 1e-3, 1e-9}) {
      const Vector3d at(1.2 + gap, 0.8 - gap, 0.5);
      const PairSolution solution = solve(cloud, probe, at, true);
      EXPECT_NEAR(solution.distance, nearestCell(grid, at - half, at + half), 1e-12) << gap;
      EXPECT_EQ(solution.status, SolveStatus::Ok) << gap;
      EXPECT_TRUE(solution.niches_complete) << gap;
      EXPECT_FALSE(solution.niches.empty()) << gap;
    }
    // A probe across the edge overlaps both.
    EXPECT_EQ(solve(cloud, probe, Vector3d(1.0, 1.0, 0.5)).status, SolveStatus::Penetrating);
  }
}

/// Bodies for the filter, with the signed distance of a point.
struct Solid {
  std::shared_ptr<const BodyMesh> mesh;
  std::function<double(const Vector3d&)> signed_distance;
};

std::vector<Solid> solids() {
  const Vector3d half(0.3, 0.2, 0.1);
  const auto to_box = [half](const Vector3d& p) {
    const Vector3d outside = p.cwiseAbs() - half;
    return outside.cwiseMax(0.0).norm() + std::min(outside.maxCoeff(), 0.0);
  };
  BodyMeshOptions ball;
  ball.shape.emplace();
  ball.shape->kind = RoundKind::Sphere;
  ball.shape->radius = 0.25;
  ball.shape->chord_error = 0.01;
  return {{box(2.0 * half), to_box},
          {std::make_shared<const BodyMesh>("ball", inscribedMesh(*ball.shape, "ball"), ball),
           [](const Vector3d& p) { return p.norm() - 0.25; }}};
}

TEST(CloudBodies, PointsOnBodiesAreToldFromOthers) {
  RandomEngine engine(test::caseSeed(22));
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5);
  for (const Solid& solid : solids()) {
    const double slack = solid.mesh->shape() != nullptr ? 2.0 * solid.mesh->shape()->chord_error : 1e-12;
    for (const double padding : {0.0, 0.02, 0.1}) {
      const Isometry3d body_from_points =
          Eigen::Translation3d(0.1, -0.05, 0.02) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
      detail::PointFilter filter;
      filter.add(solid.mesh, body_from_points, padding);
      std::size_t on = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vector3d point(coordinate(engine), coordinate(engine), coordinate(engine));
        const double distance = solid.signed_distance(body_from_points * point);
        if (distance <= padding) {
          EXPECT_TRUE(filter.isOnBody(point)) << distance;
          ++on;
        } else if (distance > padding + slack) {
          EXPECT_FALSE(filter.isOnBody(point)) << distance;
        }
      }
      EXPECT_GT(on, 20U);
    }
  }
}

SceneBody cloudBody(std::vector<std::string> leave_out = {}) {
  SceneBody body = unitBox("cloud");
  CloudSettings settings;
  settings.topic = "points";
  settings.leave_out = std::move(leave_out);
  CloudState state;
  state.settings = std::make_shared<const CloudSettings>(std::move(settings));
  body.cloud = std::make_shared<const CloudState>(std::move(state));
  return body;
}

TEST(CloudBodies, LinksAndWhatTheyHoldAreLeftOut) {
  Scene scene;
  for (const char* name : {"link", "held", "table", "shelf_1", "shelf_2"}) {
    SceneBody body = unitBox(name);
    body.is_robot_link = std::string(name) == "link";
    if (std::string(name) == "held") body.attachment = std::make_shared<const Attachment>();
    addBody(scene, body, {}, {});
  }
  addBody(scene, cloudBody({"shelf_*", "ghost"}), {}, {});
  std::vector<std::string> unknown;
  const std::vector<std::size_t> left_out =
      detail::bodiesLeftOut(scene, scene.bodies[*scene.findBody("cloud")], unknown);
  EXPECT_EQ(left_out, (std::vector<std::size_t>{0, 1, 3, 4}));
  EXPECT_EQ(unknown, std::vector<std::string>{"ghost"});
}

TEST(CloudBodies, AnEmptyCloudIsInfinitelyFarAndComesBack) {
  Scene scene;
  SceneBody link = unitBox("link");
  link.is_robot_link = true;
  addBody(scene, link, {}, {});
  addBody(scene, cloudBody(), {}, {});
  VoxelGrid grid(1.0);
  grid.insert({0, 0, 0});
  SceneTracker tracker;
  const std::vector<std::optional<Isometry3d>> poses{Isometry3d(Eigen::Translation3d(4.5, 0.5, 0.5)),
                                                     Isometry3d::Identity()};
  const auto serve = [&](bool has_voxels, std::int64_t stamp) {
    CloudState state = *scene.bodies[1].cloud;
    state.stamp = stamp;
    state.cells =
        std::make_shared<const std::vector<VoxelCell>>(has_voxels ? grid.cells() : std::vector<VoxelCell>());
    detail::takeCloud(scene.bodies.edit(1), state,
                      has_voxels ? detail::makeCloudMesh("cloud", grid) : nullptr, Isometry3d::Identity());
    tracker.setScene(scene, false);
    tracker.update(poses, 1e-9 * static_cast<double>(stamp), {true, true, true, false});
    return tracker.pairs().at(0);
  };
  EXPECT_NEAR(serve(true, 1)->solution.distance, 3.0, 1e-12);
  const auto empty = serve(false, 2);
  EXPECT_EQ(empty->state, PairState::BeyondCutoff);
  EXPECT_EQ(empty->box_bound, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(serve(true, 3)->solution.distance, 3.0, 1e-12);
}

}  // namespace
}  // namespace concave_distance::cloud_bodies_test
