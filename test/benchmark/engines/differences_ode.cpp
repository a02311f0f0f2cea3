#include <ode/ode.h>

#include <cmath>
#include <cstdint>

#include "benchmark/engines/engine_differences.h"

namespace concave_distance::benchmark {
namespace {

constexpr int kMostContacts = 64;
// Four corners of a flat face are one too many for a rigid body: without some softness (m/s a newton second)
// the solver of the complementarity problem fails.
constexpr double kConstraintForceMixing = 1e-8;
constexpr double kBounceThreshold = 0.01;  // m/s: slower impacts do not bounce

/// A world with one body over the plane z = 0; frees what it made.
class OdeWorld {
 public:
  explicit OdeWorld(const ComparedScene& scene)
      : surface_(surfaceOf(scene)), centre_(scene.mass.centre_in_body) {
    dInitODE2(0);
    world_ = dWorldCreate();
    const Eigen::Vector3d& gravity = scene.settings().gravity;
    dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
    if (scene.shape == ComparedShape::Box) dWorldSetCFM(world_, kConstraintForceMixing);
    contacts_ = dJointGroupCreate(0);
    ground_ = dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
    body_ = dBodyCreate(world_);
    addShape(scene);
    dMass mass;
    const Eigen::Matrix3d& inertia = scene.mass.inertia;
    dMassSetParameters(&mass, scene.mass.mass, 0.0, 0.0, 0.0, inertia(0, 0), inertia(1, 1), inertia(2, 2),
                       inertia(0, 1), inertia(0, 2), inertia(1, 2));
    dBodySetMass(body_, &mass);
    const Eigen::Vector3d centre = scene.pose * centre_;
    dBodySetPosition(body_, centre.x(), centre.y(), centre.z());
    const Eigen::Matrix3d turn = scene.pose.linear();
    const dMatrix3 rotation = {turn(0, 0), turn(0, 1), turn(0, 2), 0.0,        turn(1, 0), turn(1, 1),
                               turn(1, 2), 0.0,        turn(2, 0), turn(2, 1), turn(2, 2), 0.0};
    dBodySetRotation(body_, rotation);
  }
  ~OdeWorld() {
    dGeomDestroy(shape_);
    dGeomDestroy(ground_);
    if (mesh_ != nullptr) dGeomTriMeshDataDestroy(mesh_);
    dJointGroupDestroy(contacts_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void step(double seconds) {
    dContactGeom found[kMostContacts];
    const int count = dCollide(shape_, ground_, kMostContacts, found, sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact = {};
      contact.surface = surface_;
      contact.geom = found[i];
      dJointAttach(dJointCreateContact(world_, contacts_, &contact), body_, nullptr);
    }
    dWorldStep(world_, seconds);
    dJointGroupEmpty(contacts_);
  }

  EngineSample sample(double time) const {
    EngineSample sample;
    sample.time = time;
    sample.centre = Eigen::Map<const Eigen::Vector3d>(dBodyGetPosition(body_));
    sample.velocity = Eigen::Map<const Eigen::Vector3d>(dBodyGetLinearVel(body_));
    sample.angular_velocity = Eigen::Map<const Eigen::Vector3d>(dBodyGetAngularVel(body_));
    sample.world_from_body =
        Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(dBodyGetRotation(body_)).leftCols<3>();
    return sample;
  }

 private:
  static dSurfaceParameters surfaceOf(const ComparedScene& scene) {
    dSurfaceParameters surface = {};
    surface.mode = dContactBounce | dContactApprox1;
    surface.mu = scene.friction;
    surface.bounce = scene.restitution;
    surface.bounce_vel = kBounceThreshold;
    return surface;
  }

  void addShape(const ComparedScene& scene) {
    switch (scene.shape) {
      case ComparedShape::Sphere:
        shape_ = dCreateSphere(nullptr, scene.radius);
        break;
      case ComparedShape::Box:
        shape_ = dCreateBox(nullptr, scene.box_size.x(), scene.box_size.y(), scene.box_size.z());
        break;
      case ComparedShape::Mesh:
        for (const Eigen::Vector3d& vertex : scene.surface().vertices()) {
          vertices_.insert(vertices_.end(), {vertex.x(), vertex.y(), vertex.z()});
        }
        for (const TriangleNodes& triangle : scene.surface().triangles()) {
          for (const NodeIndex node : triangle) corners_.push_back(static_cast<std::uint32_t>(node.value));
        }
        mesh_ = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildDouble(mesh_, vertices_.data(), 3 * sizeof(double),
                                    static_cast<int>(scene.surface().vertexCount()), corners_.data(),
                                    static_cast<int>(corners_.size()), 3 * sizeof(std::uint32_t));
        shape_ = dCreateTriMesh(nullptr, mesh_, nullptr, nullptr, nullptr);
        break;
    }
    dGeomSetBody(shape_, body_);
    dGeomSetOffsetPosition(shape_, -centre_.x(), -centre_.y(), -centre_.z());
  }

  dSurfaceParameters surface_;
  Eigen::Vector3d centre_;
  dWorldID world_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  dGeomID ground_ = nullptr;
  dGeomID shape_ = nullptr;
  dBodyID body_ = nullptr;
  dTriMeshDataID mesh_ = nullptr;
  std::vector<double> vertices_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Trajectory runOde(const ComparedScene& scene, double rate, const OdeOptions& options) {
  OdeWorld world(scene);
  const auto steps = std::max(1L, std::lround(1.0 / (rate * options.step)));
  const double step = 1.0 / (rate * static_cast<double>(steps));
  Trajectory trajectory = {world.sample(0.0)};
  for (std::size_t i = 1; i < sampleCount(scene, rate); ++i) {
    for (long k = 0; k < steps; ++k) world.step(step);
    trajectory.push_back(world.sample(static_cast<double>(i) / rate));
  }
  return trajectory;
}

}  // namespace concave_distance::benchmark
