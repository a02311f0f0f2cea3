#include "cloud_bodies.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "base/run_together.h"
#include "concave_distance/base/error.h"
#include "distance/bound/closest_point.h"
#include "matching_bodies.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

bool contains(const BodyMesh& body, const Eigen::Vector3d& point) {
  const MeshTopology& topology = body.topology();
  return containsPoint(body.tree(), body.surface(), topology.shell_is_closed, topology.shell_of_triangle,
                       point);
}

}  // namespace

std::vector<std::size_t> bodiesLeftOut(const Scene& scene, const SceneBody& cloud,
                                       std::vector<std::string>& unknown) {
  std::vector<bool> is_left_out(scene.bodies.size(), false);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    is_left_out[i] = body.is_robot_link || body.attachment;
  }
  for (const std::string& name : cloud.cloud->settings->leave_out) {
    const MatchingBodies found = findMatchingBodies(scene, name);
    if (found.bodies.empty()) unknown.push_back(name);
    for (const std::size_t body : found.bodies) is_left_out[body] = true;
  }
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (is_left_out[i] && !scene.bodies[i].cloud) bodies.push_back(i);
  }
  return bodies;
}

void PointFilter::add(std::shared_ptr<const BodyMesh> body, const Eigen::Isometry3d& body_from_points,
                      double padding) {
  const double reach = padding + (body->shape() != nullptr ? body->shape()->chord_error : 0.0);
  Eigen::AlignedBox3d box = body->bounds();
  box.min().array() -= reach;
  box.max().array() += reach;
  bodies_.push_back({std::move(body), body_from_points, box, reach});
}

bool PointFilter::isOnBody(const Eigen::Vector3d& point) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
    const Eigen::Vector3d at = body.body_from_points * point;
    if (!body.reach.contains(at)) return false;
    const double squared = closestPoint(*body.mesh, at, TriangleIndex{0}).squared_distance;
    return squared <= body.padding * body.padding || contains(*body.mesh, at);
  });
}

std::shared_ptr<const BodyMesh> makeCloudMesh(const std::string& name, const VoxelGrid& voxels) {
  std::shared_ptr<const BodyMesh> mesh;
  tbb::task_arena(1).execute([&] {
    const OwnThreads own;
    mesh = std::make_shared<const BodyMesh>(name, voxels.surface("cloud '" + name + "'"));
  });
  return mesh;
}

void takeCloud(SceneBody& body, CloudState state, std::shared_ptr<const BodyMesh> mesh,
               const Eigen::Isometry3d& frame_from_body) {
  body.frame_from_body = frame_from_body;
  if (mesh && mesh != body.mesh) {
    body.mesh = std::move(mesh);
    body.bounds = boundsOf(*body.mesh);
  }
  body.cloud = std::make_shared<const CloudState>(std::move(state));
}

}  // namespace concave_distance::detail
