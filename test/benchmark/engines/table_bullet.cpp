#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>

#include "benchmark/engines/engine_table.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kMargin = 1e-4;  // m, that shapes are rounded by

btVector3 vectorOf(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}
Eigen::Vector3d vectorOf(const btVector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

/// A world with all bodies of a scene.
class BulletTable {
 public:
  explicit BulletTable(const TableScene& scene)
      : scene_(scene),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broad_phase_, &solver_, &configuration_) {
    world_.setGravity(vectorOf(scene.stage.settings.gravity));
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) addBody(i);
  }
  ~BulletTable() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BulletTable(const BulletTable&) = delete;
  BulletTable& operator=(const BulletTable&) = delete;

  void step(double seconds) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (const AppliedLoad& load : scene_.stage.settings.bodies[i].loads) {
        bodies_[i]->applyCentralForce(vectorOf(load.force));
      }
    }
    world_.stepSimulation(seconds, 0);
  }

  void sample(double time, std::vector<Trajectory>& trajectories) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      EngineSample sample;
      sample.time = time;
      sample.centre = vectorOf(bodies_[i]->getCenterOfMassPosition());
      sample.velocity = vectorOf(bodies_[i]->getLinearVelocity());
      sample.angular_velocity = vectorOf(bodies_[i]->getAngularVelocity());
      trajectories[i].push_back(sample);
    }
  }

 private:
  const SurfaceMesh& surfaceOf(std::size_t i) const { return scene_.stage.scene.bodies[i].mesh->surface(); }

  void addBody(std::size_t i) {
    const SimulatedBodySettings& settings = scene_.stage.settings.bodies[i];
    shapes_.push_back(makeShape(i));
    double mass = 0.0;
    btVector3 inertia(0.0, 0.0, 0.0);
    if (settings.motion != BodyMotion::Fixed) {
      const MassProperties given = settings.inertia
                                       ? *settings.inertia
                                       : massPropertiesOfMass(surfaceOf(i), *settings.mass, settings.body);
      mass = given.mass;
      inertia = vectorOf(Eigen::Vector3d(given.inertia.diagonal()));
    }
    bodies_.push_back(std::make_unique<btRigidBody>(mass, nullptr, shapes_.back().get(), inertia));
    btRigidBody& body = *bodies_.back();
    btTransform pose = btTransform::getIdentity();
    if (scene_.shapes[i] != TableShape::HalfSpace) {
      pose.setOrigin(vectorOf(Eigen::Vector3d(settings.pose.translation())));
    }
    body.setCenterOfMassTransform(pose);
    body.setLinearVelocity(vectorOf(settings.velocity));
    body.setAngularVelocity(vectorOf(settings.angular_velocity));
    // Bullet multiplies the values of both bodies.
    body.setFriction(std::sqrt(scene_.friction()));
    body.setRestitution(std::sqrt(scene_.restitution));
    body.setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(&body);
  }

  std::unique_ptr<btCollisionShape> makeShape(std::size_t i) {
    const btVector3 half = vectorOf(Eigen::Vector3d(0.5 * surfaceOf(i).boundingBox().sizes()));
    std::unique_ptr<btCollisionShape> shape;
    switch (scene_.shapes[i]) {
      case TableShape::HalfSpace:
        return std::make_unique<btStaticPlaneShape>(btVector3(0.0, 0.0, 1.0), 0.0);
      case TableShape::Sphere:  // its margin is its radius
        return std::make_unique<btSphereShape>(scene_.radius);
      case TableShape::Box:
        shape = std::make_unique<btBoxShape>(half);
        break;
      case TableShape::Cylinder:
        shape = std::make_unique<btCylinderShapeZ>(btVector3(scene_.radius, scene_.radius, half.z()));
        break;
      case TableShape::Mesh:
        shape = makeMesh(surfaceOf(i));
        break;
    }
    shape->setMargin(kMargin);
    return shape;
  }

  std::unique_ptr<btCollisionShape> makeMesh(const SurfaceMesh& surface) {
    meshes_.push_back(std::make_unique<btTriangleMesh>());
    for (const TriangleNodes& triangle : surface.triangles()) {
      const auto& vertices = surface.vertices();
      meshes_.back()->addTriangle(vectorOf(vertices[triangle[0].value]),
                                  vectorOf(vertices[triangle[1].value]),
                                  vectorOf(vertices[triangle[2].value]));
    }
    return std::make_unique<btBvhTriangleMeshShape>(meshes_.back().get(), true);
  }

  const TableScene& scene_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broad_phase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::vector<TableEngine> bulletEngines() {
  return atBothSteps<BulletTable>("bullet");
}

}  // namespace concave_distance::benchmark
