#include "arm_model.h"

#include <concave_distance/mesh/surface/primitives.h>

#include <string>
#include <utility>

using namespace concave_distance;
using SimTK::Vec3;

namespace {

constexpr std::array<double, kJoints> kStart = {0.10, 0.8, -2.0, 1.2};     // rad
constexpr std::array<double, kJoints> kTarget = {0.0, 0.34, -0.40, 0.06};  // behind the wall, below the board
constexpr std::array<double, kJoints> kStiffness = {200.0, 120.0, 80.0, 30.0};  // N m/rad
constexpr std::array<double, kJoints> kDamping = {25.0, 40.0, 20.0, 4.0};       // N m s/rad
constexpr double kGravity = 9.81;

struct Link {
  const char* name;
  double mass;  // kg
  Vec3 size;    // m, along x from joint to joint
};
const std::array<Link, kJoints> kLinks = {{{"turret", 2.0, {0.10, 0.10, 0.10}},
                                           {"upper_arm", 2.0, {0.38, 0.06, 0.06}},
                                           {"forearm", 1.5, {0.365, 0.05, 0.05}},
                                           {"fork", 0.6, {0.13, 0.12, 0.03}}}};

/// A plate around the origin with a slot from its front (+x) to `root`: two prongs, or two boards and a wall.
SurfaceMesh slottedPlate(const Vec3& size, double slot_width, double root, const std::string& name) {
  const double x = 0.5 * size[0];
  const double y = 0.5 * size[1];
  const double slot = 0.5 * slot_width;
  const std::array<Eigen::Vector2d, 8> outline = {
      {{-x, -y}, {x, -y}, {x, -slot}, {root, -slot}, {root, slot}, {x, slot}, {x, y}, {-x, y}}};
  constexpr std::array<std::array<std::uint32_t, 3>, 6> kCap = {
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {4, 5, 6}, {4, 6, 7}}};
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (const double z : {-0.5 * size[2], 0.5 * size[2]}) {
    for (const Eigen::Vector2d& p : outline) vertices.emplace_back(p.x(), p.y(), z);
  }
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles.push_back({NodeIndex{a}, NodeIndex{b}, NodeIndex{c}});
  };
  for (const std::array<std::uint32_t, 3>& corner : kCap) {
    add(corner[0], corner[2], corner[1]);
    add(corner[0] + 8, corner[1] + 8, corner[2] + 8);
  }
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t next = (k + 1) % 8;
    add(k, next, next + 8);
    add(k, next + 8, k + 8);
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), name);
}

std::shared_ptr<const BodyMesh> meshOf(const Link& link) {
  const std::string name = link.name;
  if (name == "fork")
    return std::make_shared<const BodyMesh>(name, slottedPlate(link.size, 0.07, -0.03, name));
  return std::make_shared<const BodyMesh>(name, makeBox({link.size[0], link.size[1], link.size[2]}));
}

EffectSettings rubber() {
  EffectSettings settings;
  settings.normal_force.emplace();
  settings.normal_force->model = NormalForceModel::ElasticFoundation;
  settings.normal_force->foundation_stiffness = 1e8;  // 1 MPa at 10 mm
  settings.friction.model = FrictionModel::Bristle;
  settings.friction.bristle_stiffness = 2000.0;
  settings.friction.bristle_damping = 2.0;
  return settings;
}

}  // namespace

ArmModel::ArmModel() : matter_(system_), forces_(system_), gravity_(forces_, matter_, Vec3(0, 0, -kGravity)) {
  addArm();
  addContacts();
  state_ = system_.realizeTopology();
  for (std::size_t k = 0; k < kJoints; ++k) joints_[k].setOneQ(state_, 0, kStart[k]);
  system_.realize(state_, SimTK::Stage::Velocity);
  contact_->accept(state_);
}

void ArmModel::addArm() {
  const SimTK::Rotation y_is_axis(-0.5 * SimTK::Pi, SimTK::XAxis);
  for (std::size_t k = 0; k < kJoints; ++k) {
    const Link& link = kLinks[k];
    const SimTK::Body::Rigid body(
        SimTK::MassProperties(link.mass, Vec3(0), link.mass * SimTK::UnitInertia::brick(0.5 * link.size)));
    if (k == 0) {
      joints_[k] = SimTK::MobilizedBody::Pin(matter_.Ground(), Vec3(0, 0, 0.45), body, Vec3(0));
    } else {
      const Vec3 end = k == 1 ? Vec3(0) : Vec3(0.5 * kLinks[k - 1].size[0], 0, 0);
      joints_[k] = SimTK::MobilizedBody::Pin(joints_[k - 1], SimTK::Transform(y_is_axis, end), body,
                                             SimTK::Transform(y_is_axis, Vec3(-0.5 * link.size[0], 0, 0)));
    }
    SimTK::Force::MobilityLinearSpring(forces_, joints_[k], SimTK::MobilizerQIndex(0), kStiffness[k],
                                       kTarget[k]);
    SimTK::Force::MobilityLinearDamper(forces_, joints_[k], SimTK::MobilizerUIndex(0), kDamping[k]);
  }
}

void ArmModel::addContacts() {
  // The front of the slot faces the arm, its width is upright.
  const SimTK::Rotation turn(SimTK::BodyRotationSequence, SimTK::Pi, SimTK::ZAxis, 0.5 * SimTK::Pi,
                             SimTK::XAxis);
  const SimTK::MobilizedBody::Weld shelf(matter_.Ground(), SimTK::Transform(turn, Vec3(0.70, 0, 0.48)),
                                         SimTK::Body::Rigid(), SimTK::Transform());
  const auto boards =
      std::make_shared<const BodyMesh>("shelf", slottedPlate({0.30, 0.32, 0.60}, 0.28, -0.13, "shelf"));
  contact_ = new SimbodyContact;  // the force below owns it
  SimTK::Force::Custom(forces_, contact_);
  for (std::size_t k = 1; k < kJoints; ++k) {
    contact_->add({shelf, boards}, {joints_[k], meshOf(kLinks[k])}, rubber(), Material());
  }
}

SimTK::Vector_<SimTK::SpatialVec> ArmModel::contactForces(const SimTK::State& state) const {
  SimTK::Vector_<SimTK::SpatialVec> forces(matter_.getNumBodies(), SimTK::SpatialVec(Vec3(0), Vec3(0)));
  SimTK::Vector_<Vec3> particles;
  SimTK::Vector mobilities;
  contact_->calcForce(state, forces, particles, mobilities);
  return forces;
}

JointTorques ArmModel::torques(const SimTK::State& state) const {
  SimTK::Vector_<SimTK::SpatialVec> weight(matter_.getNumBodies(), SimTK::SpatialVec(Vec3(0), Vec3(0)));
  for (const SimTK::MobilizedBody& link : joints_) {
    link.applyForceToBodyPoint(state, link.getBodyMassCenterStation(state),
                               Vec3(0, 0, -kGravity * link.getBodyMass(state)), weight);
  }
  SimTK::Vector of_contact;
  SimTK::Vector of_gravity;
  matter_.multiplyBySystemJacobianTranspose(state, contactForces(state), of_contact);
  matter_.multiplyBySystemJacobianTranspose(state, weight, of_gravity);
  JointTorques torques;
  for (std::size_t k = 0; k < kJoints; ++k) {
    torques.contact[k] = of_contact[static_cast<int>(k)];
    torques.gravity[k] = of_gravity[static_cast<int>(k)];
    torques.drive[k] =
        kStiffness[k] * (kTarget[k] - angle(state, k)) - kDamping[k] * joints_[k].getOneU(state, 0);
  }
  return torques;
}

double ArmModel::dampingPower(const SimTK::State& state) const {
  double power = 0.0;
  for (std::size_t k = 0; k < kJoints; ++k) {
    const double speed = joints_[k].getOneU(state, 0);
    power += kDamping[k] * speed * speed;
  }
  return power;
}

double ArmModel::contactPower(const SimTK::State& state) const {
  const SimTK::Vector_<SimTK::SpatialVec> forces = contactForces(state);
  double power = 0.0;
  for (SimTK::MobilizedBodyIndex k(0); k < matter_.getNumBodies(); ++k) {
    power += ~forces[k] * matter_.getMobilizedBody(k).getBodyVelocity(state);
  }
  return power;
}
