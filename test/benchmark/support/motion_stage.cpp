#include "benchmark/support/motion_stage.h"

#include <fcl/narrowphase/distance-inl.h>

#include <algorithm>
#include <numeric>

#include "base/union_find.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "support/robots.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::size_t kBalls = 16;
constexpr std::size_t kBoxes = 64;

Eigen::AlignedBox3d boxOf(const SurfaceMesh& surface, const std::vector<std::uint32_t>& triangles) {
  Eigen::AlignedBox3d box;
  for (const std::uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) box.extend(surface.corner(TriangleIndex{t}, k));
  }
  return box;
}

MotionStage::Ball ballOf(const SurfaceMesh& surface, const std::vector<std::uint32_t>& triangles) {
  MotionStage::Ball ball{boxOf(surface, triangles).center(), 0.0};
  for (const std::uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const double distance = (surface.corner(TriangleIndex{t}, k) - ball.centre).norm();
      ball.radius = std::max(ball.radius, distance);
    }
  }
  return ball;
}

/// Halves the largest group of triangles until there are so many.
std::vector<std::vector<std::uint32_t>> groupsOf(const SurfaceMesh& surface, std::size_t count) {
  std::vector<std::vector<std::uint32_t>> groups(1);
  groups[0].resize(surface.triangleCount());
  std::iota(groups[0].begin(), groups[0].end(), 0U);
  while (groups.size() < count) {
    const auto extent = [&](const auto& group) {
      return group.size() > 1 ? boxOf(surface, group).diagonal().norm() : 0.0;
    };
    const auto largest = std::max_element(
        groups.begin(), groups.end(), [&](const auto& l, const auto& r) { return extent(l) < extent(r); });
    if (largest->size() < 2) break;
    Eigen::Index axis = 0;
    boxOf(surface, *largest).sizes().maxCoeff(&axis);
    const auto middle = largest->begin() + static_cast<std::ptrdiff_t>(largest->size() / 2);
    const auto sum = [&](std::uint32_t t) {
      return surface.corner(TriangleIndex{t}, 0)[axis] + surface.corner(TriangleIndex{t}, 1)[axis] +
             surface.corner(TriangleIndex{t}, 2)[axis];
    };
    std::nth_element(largest->begin(), middle, largest->end(),
                     [&](std::uint32_t l, std::uint32_t r) { return sum(l) < sum(r); });
    std::vector<std::uint32_t> second(middle, largest->end());
    largest->erase(middle, largest->end());
    groups.push_back(std::move(second));
  }
  return groups;
}

std::vector<Eigen::Vector3d> shellPoints(const SurfaceMesh& surface) {
  UnionFind sets(surface.vertexCount());
  for (const TriangleNodes& t : surface.triangles()) {
    sets.unite(t[0].value, t[1].value);
    sets.unite(t[0].value, t[2].value);
  }
  std::vector<Eigen::Vector3d> points;
  for (std::uint32_t i = 0; i < surface.vertexCount(); ++i) {
    if (sets.find(i) == i) points.push_back(surface.vertices()[i]);
  }
  return points;
}

bool isBox(const SurfaceMesh& surface) {
  const Eigen::AlignedBox3d& box = surface.boundingBox();
  return surface.triangleCount() == 12 && surface.vertexCount() == 8 &&
         std::all_of(surface.vertices().begin(), surface.vertices().end(), [&](const Eigen::Vector3d& v) {
           return ((v - box.center()).cwiseAbs() - 0.5 * box.sizes()).cwiseAbs().maxCoeff() < 1e-12;
         });
}

SceneLoadOptions optionsWithArm() {
  SceneLoadOptions options;
  options.strict = true;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  options.descriptions["robot_description"] = test::packageFile("urdf/wam.urdf");
  return options;
}

MotionStage stageOf(const std::string& name, const std::string& yaml) {
  auto scene =
      std::make_shared<const Scene>(loadSceneText(yaml, name, CONCAVE_DISTANCE_SOURCE_DIR, optionsWithArm()));
  return {name, std::move(scene), test::packageFile("urdf/wam.urdf")};
}

}  // namespace

Eigen::VectorXd Motion::at(double time) const {
  std::size_t next = 1;
  while (next + 1 < times.size() && times[next] < time) ++next;
  const double span = times[next] - times[next - 1];
  const double s = (time - times[next - 1]) / span;
  const Eigen::VectorXd change = positions[next] - positions[next - 1];
  if (velocities.empty()) return positions[next - 1] + s * change;
  // Hermite's basis.
  const double r = 1.0 - s;
  return positions[next - 1] + s * s * (3.0 - 2.0 * s) * change +
         span * s * r * (r * velocities[next - 1] - s * velocities[next]);
}

MotionStage::MotionStage(std::string name, std::shared_ptr<const Scene> scene, const std::string& urdf)
    : name_(std::move(name)), scene_(std::move(scene)), chain_(urdf) {
  for (std::size_t i = 0; i < scene_->bodies.size(); ++i) addBody(i);
  const PairList all = allPairs(*scene_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Pair pair{all[i].body_a, all[i].body_b, ""};
    if (bodies_[pair.a].link < bodies_[pair.b].link) std::swap(pair.a, pair.b);
    if (bodies_[pair.a].link < 0) continue;
    pair.name = bodies_[pair.a].name + "/" + bodies_[pair.b].name;
    pairs_.push_back(pair);
  }
}

void MotionStage::addBody(std::size_t index) {
  const SceneBody& given = scene_->bodies[index];
  const SurfaceMesh& surface = given.mesh->surface();
  Body body;
  body.name = given.name;
  body.link = chain_.findLink(given.frame);
  body.link_from_body = given.frame_from_body;
  if (body.link >= 0 && chain_.links()[static_cast<std::size_t>(body.link)].last_joint < 0) body.link = -1;
  if (body.link < 0 && given.frame != "world") {  // a link that no joint moves
    std::vector<Eigen::Isometry3d> links;
    chain_.place(Eigen::VectorXd::Zero(chain_.jointCount()), links);
    body.link_from_body =
        links[static_cast<std::size_t>(chain_.findLink(given.frame))] * given.frame_from_body;
  }
  body.model = makeFclModel(surface);
  body.whole = ballOf(surface, groupsOf(surface, 1)[0]);
  for (const auto& group : groupsOf(surface, kBalls)) body.balls.push_back(ballOf(surface, group));
  body.is_box = isBox(surface);
  for (const auto& group : groupsOf(surface, body.is_box ? 1 : kBoxes))
    body.boxes.push_back(boxOf(surface, group));
  body.shell_points = shellPoints(surface);
  if (body.link >= 0) {
    body.reach.resize(static_cast<std::size_t>(chain_.jointCount()), 0.0);
    double beyond = 0.0;  // of the frame of a link, which holds the axis of its joint
    for (const Ball& ball : body.balls) {
      beyond = std::max(beyond, (body.link_from_body * ball.centre).norm() + ball.radius);
    }
    for (int link = body.link; link > 0; --link) {
      const JointChain::Link& l = chain_.links()[static_cast<std::size_t>(link)];
      if (l.joint >= 0) body.reach[static_cast<std::size_t>(l.joint)] = beyond;
      beyond += l.last_from_link.translation().norm();
    }
  }
  bodies_.push_back(std::move(body));
}

std::size_t MotionStage::findPair(const std::string& name_a, const std::string& name_b) const {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (pairs_[i].name == name_a + "/" + name_b || pairs_[i].name == name_b + "/" + name_a) return i;
  }
  throw Error(name_a + "/" + name_b, "no such pair on the stage", "compare the scenes");
}

void MotionStage::place(const Eigen::VectorXd& positions, Poses& poses) const {
  chain_.place(positions, poses.world_from_link);
  poses.world_from_body.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    poses.world_from_body[i] =
        body.link < 0 ? body.link_from_body
                      : poses.world_from_link[static_cast<std::size_t>(body.link)] * body.link_from_body;
  }
}

double MotionStage::boundAt(std::size_t pair, const Poses& poses, double enough) const {
  const Body& a = bodies_[pairs_[pair].a];
  const Body& b = bodies_[pairs_[pair].b];
  const Eigen::Isometry3d& world_from_a = poses.world_from_body[pairs_[pair].a];
  const Eigen::Isometry3d& world_from_b = poses.world_from_body[pairs_[pair].b];
  const double rough = (world_from_a * a.whole.centre - world_from_b * b.whole.centre).norm() -
                       a.whole.radius - b.whole.radius;
  if (rough > enough) return rough;
  const Eigen::Isometry3d b_from_a = world_from_b.inverse() * world_from_a;
  double bound = std::numeric_limits<double>::infinity();
  for (const Ball& ball : a.balls) {
    const Eigen::Vector3d centre = b_from_a * ball.centre;
    double squared = std::numeric_limits<double>::infinity();
    for (const Eigen::AlignedBox3d& box : b.boxes) {
      squared = std::min(squared, box.squaredExteriorDistance(centre));
    }
    bound = std::min(bound, std::sqrt(squared) - ball.radius);
  }
  return std::max({0.0, rough, bound});
}

double MotionStage::distanceAt(std::size_t pair, const Poses& poses, double seed) const {
  const Body& a = bodies_[pairs_[pair].a];
  const Body& b = bodies_[pairs_[pair].b];
  const Eigen::Isometry3d b_from_a =
      poses.world_from_body[pairs_[pair].b].inverse() * poses.world_from_body[pairs_[pair].a];
  if (b.is_box) {
    for (const Eigen::Vector3d& point : a.shell_points) {
      if (b.boxes[0].contains(b_from_a * point)) return 0.0;
    }
  }
  const fcl::DistanceRequest<double> request(false);
  fcl::DistanceResult<double> result;
  if (std::isfinite(seed)) result.min_distance = seed;
  fcl::distance(b.model.get(), fcl::Transform3<double>(Eigen::Isometry3d::Identity()), a.model.get(),
                fcl::Transform3<double>(b_from_a), request, result);
  return std::max(0.0, std::min(result.min_distance, seed));
}

double MotionStage::leastAt(const Poses& poses, double seed, std::size_t* pair,
                            std::size_t* distances) const {
  thread_local std::vector<std::pair<double, std::size_t>> order;
  order.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const double bound = boundAt(i, poses, seed);
    if (bound < seed) order.emplace_back(bound, i);
  }
  std::sort(order.begin(), order.end());
  double least = seed;
  for (const auto& [bound, i] : order) {
    if (bound >= least) break;
    const double distance = distanceAt(i, poses, least);
    if (distances != nullptr) ++*distances;
    if (distance < least && pair != nullptr) *pair = i;
    least = std::min(least, distance);
    if (least <= 0.0) break;
  }
  return least;
}

double MotionStage::pathBound(std::size_t pair, const Poses& poses, const Eigen::VectorXd& change) const {
  const Body& a = bodies_[pairs_[pair].a];
  const int first =
      bodies_[pairs_[pair].b].link < 0
          ? 0
          : chain_.links()[static_cast<std::size_t>(bodies_[pairs_[pair].b].link)].last_joint + 1;
  const int last = chain_.links()[static_cast<std::size_t>(a.link)].last_joint;
  double path = 0.0;
  for (int joint = last; joint >= first; --joint) {
    const Eigen::Isometry3d& world_from_joint = poses.world_from_link[chain_.linkOf(joint)];
    const Eigen::Vector3d axis = world_from_joint.linear() * chain_.links()[chain_.linkOf(joint)].axis;
    double farthest = 0.0;
    for (const Ball& ball : a.balls) {
      const Eigen::Vector3d arm =
          poses.world_from_body[pairs_[pair].a] * ball.centre - world_from_joint.translation();
      farthest = std::max(farthest, axis.cross(arm).norm() + ball.radius);
    }
    // The joints behind this one bring a point farther from its axis by half of the path that they allow.
    const double reach = std::min(a.reach[static_cast<std::size_t>(joint)], farthest + 0.5 * path);
    path += reach * std::abs(change[joint]);
  }
  return path;
}

MotionStage cellStage() {
  return stageOf("cell", test::packageFile("config/cell.yaml"));
}

MotionStage shelfStage() {
  return stageOf("shelf",
                 "robots:\n"
                 "  - {description: robot_description, geometry: visual}\n"
                 "bodies:\n"
                 "  - name: shelf\n"
                 "    frame: world\n"
                 "    mesh: package://concave_distance/meshes/demo/shelf.stl\n"
                 "    pose: {xyz: [0.82, 0.30, 0.0]}\n"
                 "groups: {arm: [wam1, wam2, wam3, wam4, wam5, wam6, wam7]}\n"
                 "pairs:\n"
                 "  - between: [arm, shelf]\n"
                 "  - between: [wam_base, wam6]\n"
                 "  - between: [wam1, wam6]\n"
                 "  - between: [wam2, wam7]\n");
}

}  // namespace concave_distance::benchmark
