#include "thesis/benchmark/support/continuous_scenes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "distance/niches/local_minima.h"
#include "support/plain_shapes.h"
#include "support/thesis_scenes.h"
#include "thesis/src/continuous/build_constraint_tree.h"
#include "thesis/test/continuous/tree_shapes.h"

namespace concave_distance::benchmark {
namespace {

constexpr const char* kPit = "pit";

std::shared_ptr<const BodyMesh> loadBody(const std::string& file) {
  const std::string path = std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/" + file + ".stl";
  return std::make_shared<const BodyMesh>(file, repairMesh(importMesh(path), {}, path).mesh,
                                          BodyMeshOptions{});
}

ConstraintTree treeOf(const BodyMesh& body, const std::string& name) {
  return buildConstraintTree(body.surface(), {}, name).tree;
}

/// d* and where its region ends. Symmetric bodies have the global minimum in several places, to the files'
/// single precision.
std::pair<double, double> minimumAndRegion(const BodyMesh& a, const BodyMesh& b,
                                           const Eigen::Isometry3d& a_from_b) {
  constexpr double kSame = 1e-5;
  LocalMinimaRequest request;
  request.cutoff = 0.5 * (a.surface().diameter() + b.surface().diameter());
  const std::vector<LocalMinimum> niches = findLocalMinima(a, b, a_from_b, request).niches;
  if (niches.empty()) return {std::numeric_limits<double>::infinity(), 0.0};
  const double minimum = niches.front().distance;
  double region = 1.1 * minimum;
  for (const LocalMinimum& niche : niches) {
    if (niche.distance > (1.0 + kSame) * minimum) region = std::min(region, niche.distance);
  }
  return {minimum, region};
}

Eigen::Isometry3d randomPose(const SurfaceMesh& a, const SurfaceMesh& b, RandomEngine& engine) {
  const Eigen::Vector3d axis = test::uniformInCube(engine, 1.0).normalized();
  Eigen::Isometry3d a_from_b(Eigen::AngleAxisd(2.0 * M_PI * uniformUnit(engine), axis));
  const double apart = 0.45 * (a.diameter() + b.diameter());
  a_from_b.translation() = a.boundingBox().center() + apart * test::uniformInCube(engine, 1.0).normalized() -
                           a_from_b.linear() * b.boundingBox().center();
  return a_from_b;
}

}  // namespace

std::vector<std::string> continuousSceneNames() {
  return {"boxes_position_1",    "boxes_position_2", "cylinder_position_1",
          "cylinder_position_2", "battery_static",   kPit};
}

ContinuousScene loadContinuousScene(const std::string& name) {
  if (name == kPit) {
    Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
    a_from_b.translation() = Eigen::Vector3d(1.25, 1.25, 1.1);
    const double to_floor = 0.1;
    return {name,     test::pitWithPost(), test::boxTree({-0.1, -0.1, 0}, {0.1, 0.1, 3}), a_from_b,
            to_floor, 1.1 * to_floor};
  }
  const test::ThesisScene s = test::loadThesisScene(name, 0.1);
  const auto [minimum, region] = minimumAndRegion(*s.a, *s.b, s.a_from_b);
  return {name, treeOf(*s.a, name + ", a"), treeOf(*s.b, name + ", b"), s.a_from_b, minimum, region};
}

std::vector<HeldOutPair> heldOutPairs(std::uint32_t poses) {
  constexpr double kContact = 1e-3;  // of both diameters: closer poses are not used
  std::vector<HeldOutPair> pairs;
  for (const auto& [file_a, file_b] :
       {std::pair("kr5/wrist", "kr5/wrist"), std::pair("wam/wam4_collision", "wam/wam6_collision"),
        std::pair("wam/wam1_collision", "kr5/wrist"), std::pair("thesis/semi_extruded", "thesis/battery"),
        std::pair("thesis/fixture", "thesis/grooved_cylinder")}) {
    const std::shared_ptr<const BodyMesh> a = loadBody(file_a);
    const std::shared_ptr<const BodyMesh> b = loadBody(file_b);
    const double both = a->surface().diameter() + b->surface().diameter();
    HeldOutPair pair{std::string(file_a) + " and " + file_b, 0.5 * both, {}};
    const ConstraintTree tree_a = treeOf(*a, file_a);
    const ConstraintTree tree_b = treeOf(*b, file_b);
    RandomEngine engine(streamSeed(0, pair.name, 0));
    while (pair.scenes.size() < poses) {
      const Eigen::Isometry3d pose = randomPose(a->surface(), b->surface(), engine);
      const auto [minimum, region] = minimumAndRegion(*a, *b, pose);
      if (std::isfinite(minimum) && minimum > kContact * both) {
        const std::string name = pair.name + " " + std::to_string(pair.scenes.size());
        pair.scenes.push_back({name, tree_a, tree_b, pose, minimum, region});
      }
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace concave_distance::benchmark
