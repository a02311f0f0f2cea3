#include "benchmark/support/interference_scenes.h"

#include <fcl/narrowphase/collision-inl.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/shapes.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "distance/bound/closest_point.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"
#include "support/thesis_scenes.h"

namespace concave_distance::benchmark {
namespace {

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

InterferenceScene crossedEdges() {
  const SurfaceMesh box = makeBox({1, 1, 1});
  // Each stands on an edge, the edges at right angles, 0.1 deep.
  const Eigen::Isometry3d lower(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitX()));
  Eigen::Isometry3d upper(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitY()));
  upper.pretranslate(Eigen::Vector3d(0.03, 0.02, 2.0 * std::sqrt(0.5) - 0.1));
  return {"edge over edge", {moved(box, lower), box, upper}};
}

/// Two rods at right angles, 0.02 deep; the edges of their mantles cross.
InterferenceScene crossedRods() {
  const SurfaceMesh rod = makeCylinder(0.25, 2.0, 4e-3);
  const Eigen::Isometry3d lower(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  Eigen::Isometry3d upper(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  upper.pretranslate(Eigen::Vector3d(0.05, 0.07, 0.48));
  return {"rod across rod", {moved(rod, lower), rod, upper}};
}

InterferenceScene batteryPushed() {
  const auto fixture = test::loadThesisBody("fixture", 10.0);
  const auto battery = test::loadThesisBody("battery", 10.0);
  Eigen::Isometry3d pose = test::readThesisPoses("battery_static.csv").front();
  InterferenceWorkspace workspace;
  Interference found;
  // Down until it touches, and a hundredth of its size on.
  const double step = 1e-3 * battery->diameter();
  for (int i = 0; i < 2000 && found.regions.empty(); ++i) {
    pose.translation().z() -= step;
    findInterference(*fixture, *battery, pose, workspace, found);
  }
  pose.translation().z() -= 10.0 * step;
  return {"battery pushed", {fixture->surface(), battery->surface(), pose}};
}

InterferenceScene rings(std::size_t triangles) {
  const SurfaceMesh ring = makeBumpyRing(triangles);
  // Towards the other until they touch, and sixteen thousandths of a diameter on.
  const auto body = test::makeBody(ring);
  Eigen::Isometry3d pose = ringPassingBy(0.5);
  InterferenceWorkspace workspace;
  Interference found;
  const Eigen::Vector3d step = -4e-3 * ring.diameter() * pose.translation().normalized();
  for (int i = 0; i < 250 && found.regions.empty(); ++i) {
    pose.translation() += step;
    findInterference(*body, *body, pose, workspace, found);
  }
  pose.translation() += 4.0 * step;
  return {"rings of " + std::to_string(triangles), {ring, ring, pose}};
}

bool holds(const BodyMesh& body, const Eigen::Vector3d& point) {
  return containsPoint(body.tree(), body.surface(), body.topology().shell_is_closed,
                       body.topology().shell_of_triangle, point);
}

double deepestVertexIn(const BodyMesh& holder, const BodyMesh& other,
                       const Eigen::Isometry3d& holder_from_other) {
  double deepest = 0.0;
  for (const Eigen::Vector3d& vertex : other.surface().vertices()) {
    const Eigen::Vector3d point = holder_from_other * vertex;
    if (!holds(holder, point)) continue;
    deepest = std::max(deepest, (closestPoint(holder, point, TriangleIndex{0U}).point - point).norm());
  }
  return deepest;
}

}  // namespace

std::vector<InterferenceScene> interferenceScenes() {
  std::vector<InterferenceScene> scenes;
  scenes.push_back(crossedEdges());
  scenes.push_back(crossedRods());
  scenes.push_back({"ball on plate",
                    {test::makeCuboid({-1, -1, -1}, {1, 1, 0}), makeSphere(0.5, 1e-3), at(0.1, 0.2, 0.48)}});
  scenes.push_back(
      {"combs",
       {test::makeComb(6), test::makeComb(6),
        at(0.06, 0.33, 0.05) * Eigen::Isometry3d(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()))}});
  scenes.push_back(batteryPushed());
  for (const std::size_t triangles : {1000U, 10000U, 100000U}) scenes.push_back(rings(triangles));
  return scenes;
}

double vertexDepth(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  return std::max(deepestVertexIn(a, b, a_from_b), deepestVertexIn(b, a, a_from_b.inverse()));
}

FclContacts fclContacts(const InterferencePair& pair) {
  const auto a = makeFclModel(pair.a);
  const auto b = makeFclModel(pair.b);
  const fcl::CollisionRequest<double> request(10000000, true);
  FclContacts best{0, 0.0, std::numeric_limits<double>::infinity()};
  for (int repeat = 0; repeat < 5; ++repeat) {
    fcl::CollisionResult<double> result;
    const auto start = std::chrono::steady_clock::now();
    fcl::collide(a.get(), fcl::Transform3<double>(Eigen::Isometry3d::Identity()), b.get(),
                 fcl::Transform3<double>(pair.a_from_b), request, result);
    best.seconds = std::min(best.seconds,
                            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    best.count = result.numContacts();
    best.deepest = 0.0;
    for (std::size_t i = 0; i < result.numContacts(); ++i)
      best.deepest = std::max(best.deepest, result.getContact(i).penetration_depth);
  }
  return best;
}

}  // namespace concave_distance::benchmark
