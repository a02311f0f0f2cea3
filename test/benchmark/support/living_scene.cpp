#include "living_scene.h"

#include <tbb/task_arena.h>

#include <cmath>
#include <utility>

#include "benchmark/support/stopwatch.h"
#include "concave_distance/mesh/surface/round_shape.h"
#include "scene/apply_operations.h"
#include "scene/body_pool.h"
#include "scene/scene_edits.h"
#include "support/random_solids.h"

namespace concave_distance::benchmark {
namespace {

constexpr char kWorld[] = "world";
constexpr std::size_t kKnownAdds = 5;  // a second
constexpr std::size_t kBatch = 100;    // bodies

TriangleSoup soupOf(const SurfaceMesh& surface) {
  TriangleSoup soup;
  soup.vertices = surface.vertices();
  for (const TriangleNodes& t : surface.triangles()) {
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  }
  return soup;
}

BodyDescription describe(const BodyMesh& mesh) {
  BodyDescription description;
  if (const RoundShape* shape = mesh.shape()) {
    description.primitive = "sphere";
    description.dimensions = {shape->radius};
  } else {
    description.triangles = std::make_shared<const TriangleSoup>(soupOf(mesh.surface()));
  }
  return description;
}

detail::SceneOperation operation(detail::OperationKind kind, const std::string& body) {
  detail::SceneOperation result;
  result.kind = kind;
  result.body = body;
  return result;
}

}  // namespace

LivingScene::LivingScene(const ChurnOptions& options)
    : options_(options),
      engine_(options.seed),
      links_(options.bodies / 2),
      paths_(manyBodies(options.bodies).paths),
      ball_(soupOf(test::makeBumpyBall(0.12, 9e-4, 7.0))) {
  for (const auto& shape : manyShapes()) shapes_.push_back(describe(*shape));
  Scene scene;
  scene.defaults.pairs.tracker.cutoff = kCutoff;
  scene.pool = std::make_shared<BodyPool>(kDefaultMetricMemoryLimit);
  serve(std::move(scene));
  std::vector<BodyDescription> links;
  for (std::size_t i = 0; i < links_; ++i) {
    links.push_back(shapes_[i % shapes_.size()]);
    links.back().frame = "f" + std::to_string(i);
  }
  std::vector<detail::SceneOperation> operations = additions(links);
  for (auto& link : operations) {
    if (link.problem) throw Error(*link.problem);
    link.added->is_robot_link = true;
    link.added->frame_from_body = Eigen::Isometry3d::Identity();
  }
  apply(operations, 0.0);
  while (this->scene()->bodies.size() < options_.bodies) add(0.0, false);
}

std::shared_ptr<const Scene> LivingScene::scene() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return scene_;
}

void LivingScene::serve(Scene scene) {
  auto next = std::make_shared<const Scene>(std::move(scene));
  const std::lock_guard<std::mutex> lock(mutex_);
  scene_.swap(next);
}

Eigen::Isometry3d LivingScene::poseOfFrame(const std::string& frame, double time) const {
  return frame == kWorld ? Eigen::Isometry3d::Identity() : paths_.at(std::stoul(frame.substr(1))).at(time);
}

Poses LivingScene::posesOf(const Scene& scene, double time) const {
  Poses poses;
  for (const SceneBody& body : scene.bodies) {
    poses.emplace_back(poseOfFrame(body.frame, time) * body.frame_from_body);
  }
  return poses;
}

detail::FramesNow LivingScene::framesAt(double time) const {
  return {kWorld, [this, time](const std::string& target, const std::string& source) {
            detail::FrameRelation relation;
            relation.target_from_source = poseOfFrame(target, time).inverse() * poseOfFrame(source, time);
            return std::optional(relation);
          }};
}

Eigen::Isometry3d LivingScene::randomPlace() {
  const double side = std::cbrt(static_cast<double>(options_.bodies));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = side * (test::uniformInCube(engine_, 0.5) + Eigen::Vector3d::Constant(0.5));
  pose.linear() =
      Eigen::AngleAxisd(uniformUnit(engine_),
                        (test::uniformInCube(engine_, 1.0) + Eigen::Vector3d(0, 0, 1.1)).normalized())
          .toRotationMatrix();
  return pose;
}

BodyDescription LivingScene::knownShape() {
  return shapes_[uniformIndex(engine_, static_cast<std::uint32_t>(shapes_.size()))];
}

BodyDescription LivingScene::newShape() {
  const Eigen::Vector3d stretch = Eigen::Vector3d::Ones() + test::uniformInCube(engine_, 0.3);
  auto soup = std::make_shared<TriangleSoup>(ball_);
  for (Eigen::Vector3d& vertex : soup->vertices) vertex = vertex.cwiseProduct(stretch);
  BodyDescription description;
  description.triangles = std::move(soup);
  return description;
}

// As apply_scene does: on the thread of the service alone.
std::vector<detail::SceneOperation> LivingScene::additions(const std::vector<BodyDescription>& descriptions) {
  std::vector<BodyDescription> named = descriptions;
  for (BodyDescription& description : named) {
    description.name = "b" + std::to_string(names_++);
    if (description.frame.empty()) description.frame = kWorld;
  }
  const std::shared_ptr<const Scene> now = scene();
  std::vector<LoadedBody> loaded;
  tbb::task_arena(1).execute([&] { loaded = loadBodies(named, "", {}, now->pool, now->limits); });
  std::vector<detail::SceneOperation> operations;
  for (std::size_t i = 0; i < named.size(); ++i) {
    operations.push_back(operation(detail::OperationKind::Add, named[i].name));
    operations.back().problem = loaded[i].problem;
    operations.back().added = std::move(loaded[i].body);
    if (operations.back().added) operations.back().added->frame_from_body = randomPlace();
  }
  return operations;
}

void LivingScene::apply(const std::vector<detail::SceneOperation>& operations, double time) {
  Scene edited = *scene();
  const auto applied = detail::applyOperations(edited, operations, framesAt(time));
  if (!applied.faults.empty()) throw Error(applied.faults.front().error);
  serve(std::move(edited));
}

// The kinds come in turns, spread over a second.
Change LivingScene::changeWanted() {
  constexpr std::uint64_t kStride = 37;
  const std::size_t slot = changes_++ * kStride % options_.changes;
  const std::size_t adds = options_.new_meshes + kKnownAdds;
  if (slot < options_.new_meshes) return Change::AddNew;
  if (slot < adds) return Change::Add;
  if (slot < 2 * adds) return Change::Remove;
  switch ((slot - 2 * adds) % 5) {
    case 0:
      return Change::Attach;
    case 1:
      return Change::Detach;
    default:
      return Change::Move;
  }
}

Change LivingScene::change(double time) {
  const Change wanted = changeWanted();
  bool is_done = true;
  switch (wanted) {
    case Change::Move:
      break;
    case Change::Attach:
      is_done = attach(time);
      break;
    case Change::Detach:
      is_done = detach(time);
      break;
    case Change::Remove:
      is_done = remove(time);
      break;
    case Change::Add:
    case Change::AddNew:
      add(time, wanted == Change::AddNew);
      break;
  }
  if (is_done && wanted != Change::Move) return wanted;
  move(time);
  return Change::Move;
}

void LivingScene::attachOrDetach(double time) {
  if (engine_() % 2 == 0 || !detach(time)) attach(time);
}

bool LivingScene::move(double time) {
  const std::shared_ptr<const Scene> now = scene();
  const std::size_t count = now->bodies.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SceneBody& body = now->bodies[links_ + engine_() % (count - links_)];
    if (body.attachment) continue;
    detail::SceneOperation moved = operation(detail::OperationKind::Move, body.name);
    moved.frame = kWorld;
    moved.frame_from_body = body.frame_from_body;
    // Most go a little way on, some somewhere else.
    if (engine_() % 8 == 0) {
      moved.frame_from_body = randomPlace();
    } else {
      moved.frame_from_body.pretranslate(test::uniformInCube(engine_, 0.02));
    }
    apply({moved}, time);
    return true;
  }
  return false;
}

bool LivingScene::attach(double time) {
  const std::shared_ptr<const Scene> now = scene();
  const std::size_t count = now->bodies.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SceneBody& body = now->bodies[links_ + engine_() % (count - links_)];
    const SceneBody& parent = now->bodies[engine_() % count];
    if (body.attachment || parent.attachment || body.serial == parent.serial) continue;
    detail::SceneOperation attached = operation(detail::OperationKind::Attach, body.name);
    attached.other = parent.name;
    apply({attached}, time);
    return true;
  }
  return false;
}

bool LivingScene::detach(double time) {
  const std::shared_ptr<const Scene> now = scene();
  const std::size_t first = links_ + engine_() % (now->bodies.size() - links_);
  for (std::size_t i = links_; i < now->bodies.size(); ++i) {
    const std::size_t place = links_ + (first + i) % (now->bodies.size() - links_);
    if (!now->bodies[place].attachment) continue;
    apply({operation(detail::OperationKind::Detach, now->bodies[place].name)}, time);
    return true;
  }
  return false;
}

bool LivingScene::remove(double time) {
  const std::shared_ptr<const Scene> now = scene();
  const std::size_t count = now->bodies.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SceneBody& body = now->bodies[links_ + engine_() % (count - links_)];
    bool is_parent = false;
    for (const SceneBody& other : now->bodies) {
      is_parent = is_parent || (other.attachment && other.attachment->parent_serial == body.serial);
    }
    if (is_parent) continue;
    apply({operation(detail::OperationKind::Remove, body.name)}, time);
    return true;
  }
  return false;
}

void LivingScene::add(double time, bool is_new) {
  apply(additions({is_new ? newShape() : knownShape()}), time);
}

double LivingScene::timeABatch(double time) {
  std::vector<BodyDescription> known;
  for (std::size_t i = 0; i < kBatch; ++i) known.push_back(knownShape());
  std::vector<detail::SceneOperation> added;
  const double taken = millisecondsOf([&] {
    added = additions(known);
    apply(added, time);
  });
  std::vector<detail::SceneOperation> removed;
  for (const auto& one : added) removed.push_back(operation(detail::OperationKind::Remove, one.body));
  apply(removed, time);
  return taken;
}

}  // namespace concave_distance::benchmark
