#include "moving_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"

namespace concave_distance::detail {
namespace {

MassProperties massOf(const SceneBody& body, const SimulatedBodySettings& settings) {
  const std::string where =
      settings.where.empty() ? "simulation, body '" + settings.body + "'" : settings.where;
  if (settings.inertia) return *settings.inertia;
  if (settings.density || settings.mass) {
    if (!body.mesh->topology().allShellsClosed()) {
      throw Error(where, "the mesh of body '" + body.name + "' is not closed: it has no volume to be filled",
                  "give `inertia`, or close the mesh");
    }
    if (const RoundShape* shape = body.mesh->shape()) {
      return settings.density ? massPropertiesOf(*shape, *settings.density, where)
                              : massPropertiesOfMass(*shape, *settings.mass, where);
    }
    return settings.density ? massPropertiesOf(body.mesh->surface(), *settings.density, where)
                            : massPropertiesOfMass(body.mesh->surface(), *settings.mass, where);
  }
  if (body.inertia) return *body.inertia;
  throw Error(where, "the free body '" + body.name + "' has no mass",
              "give one of inertia, density, mass, or fixed: true");
}

double radiusAbout(const BodyMesh& body, const Eigen::Vector3d& point) {
  if (const RoundShape* shape = body.shape())
    return farthestDistance(*shape, shape->body_from_shape.inverse(Eigen::Isometry) * point);
  double squared = 0.0;
  for (const Eigen::Vector3d& vertex : body.surface().vertices())
    squared = std::max(squared, (vertex - point).squaredNorm());
  return std::sqrt(squared);
}

bool isActive(const AppliedLoad& load, double inside) {
  return load.from <= inside && inside < load.until;
}

Wrench wrenchOf(const AppliedLoad& load, const Eigen::Isometry3d& world_from_body,
                const Eigen::Vector3d& centre) {
  const Eigen::Matrix3d axes =
      load.in_body_frame ? Eigen::Matrix3d(world_from_body.linear()) : Eigen::Matrix3d::Identity();
  Wrench wrench = wrenchAbout(axes * load.force, world_from_body * load.point_in_body, centre);
  wrench.torque += axes * load.torque;
  return wrench;
}

}  // namespace

MovingBody::MovingBody(const SceneBody& body, const SimulatedBodySettings& settings)
    : motion_(settings.motion), fixed_pose_(settings.pose), loads_(settings.loads) {
  if (motion_ == BodyMotion::Driven) path_.emplace(settings.path);
  if (motion_ != BodyMotion::Free) {
    radius_ = radiusAbout(*body.mesh, Eigen::Vector3d::Zero());
    return;
  }
  rigid_.emplace(massOf(body, settings), settings.where.empty() ? body.name : settings.where);
  radius_ = radiusAbout(*body.mesh, rigid_->centreInBody());
  state_ = rigid_->stateAt(settings.pose, settings.velocity, settings.angular_velocity);
  before_ = state_;
  if (settings.drive) {
    drive_ = settings.drive;
    target_.emplace(settings.drive->target);
  }
}

double MovingBody::nextEvent(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const AppliedLoad& load : loads_) {
    if (load.from > time) next = std::min(next, load.from);
    if (load.until > time) next = std::min(next, load.until);
  }
  if (path_) next = std::min(next, path_->nextChange(time));
  if (target_) next = std::min(next, target_->nextChange(time));
  return next;
}

FrameMotion MovingBody::motionOf(const RigidBodyState& state, double time, double inside) const {
  FrameMotion motion;
  if (rigid_) {
    motion.centre = state.centre;
    motion.twist << state.velocity, rigid_->angularVelocity(state);
  } else if (path_) {
    const FrameTwist twist = path_->twistAt(inside);
    motion.centre = path_->poseAt(time).translation();
    motion.twist << twist.linear, twist.angular;
  } else {
    motion.centre = fixed_pose_.translation();
  }
  return motion;
}

StepEquations::Inertia MovingBody::inertia() const {
  if (!rigid_) return {};
  return {rigid_->mass(), rigid_->inertia(state_)};
}

void MovingBody::evaluateLoad(double inside, const RigidBodyState& state, const Wrench& external) {
  load_now_ = external;
  if (loads_.empty()) return;
  const Eigen::Isometry3d world_from_body = rigid_->worldFromBody(state);
  for (const AppliedLoad& load : loads_) {
    if (isActive(load, inside)) load_now_ += wrenchOf(load, world_from_body, state.centre);
  }
}

Wrench MovingBody::steadyWrench(const Eigen::Vector3d& gravity) const {
  return {load_now_.force + rigid_->mass() * gravity, load_now_.torque};
}

void MovingBody::setDriveTarget(const Eigen::Isometry3d& pose) {
  target_.emplace(std::vector<TimedPose>{{0.0, pose}});
}

FrameMotion MovingBody::targetMotion(double time, double inside) const {
  const FrameTwist twist = target_->twistAt(inside);
  FrameMotion motion;
  motion.centre = target_->poseAt(time).translation();
  motion.twist << twist.linear, twist.angular;
  return motion;
}

void MovingBody::evaluateDrive(double time, double inside, const RigidBodyState& state) {
  if (drive_) drive_now_ = driveForce(*drive_, *target_, time, inside, *rigid_, state);
}

ContactLinearisation MovingBody::driveLinearisation(double time) const {
  const Eigen::Vector3d point =
      rigid_->worldFromBody(state_) * Eigen::Vector3d(drive_->body_from_drive.translation());
  return linearisationOf(*drive_, targetPose(time).inverse(Eigen::Isometry) * point);
}

double MovingBody::driveStretch() const {
  const double stiffest = drive_->stiffness.maxCoeff();
  return stiffest > 0.0 ? drive_now_.on_body.force.norm() / stiffest : 0.0;
}

Drift MovingBody::drift(double time, double step) {
  if (rigid_) return rigid_->drift(step, state_);
  Drift drift;
  if (path_) {
    drift.shift = path_->poseAt(time + step).translation() - path_->poseAt(time).translation();
    drift.turn = path_->twistAt(time + 0.5 * step).angular.norm() * step;
  }
  return drift;
}

void MovingBody::kick(const Wrench& about_centre, double step) {
  rigid_->kick(about_centre, step, state_);
}

RigidBodyState MovingBody::kicked(const Wrench& about_centre, double step) const {
  RigidBodyState state = state_;
  rigid_->kick(about_centre, step, state);
  return state;
}

void MovingBody::report(double time, double inside, SimulatedBody& body) const {
  if (rigid_) {
    body.world_from_body = rigid_->worldFromBody(state_);
    body.centre = state_.centre;
    body.velocity = state_.velocity;
    body.angular_velocity = rigid_->angularVelocity(state_);
    body.drive_wrench = drive_now_.on_body;
    body.load_wrench = load_now_;
    return;
  }
  body.world_from_body = path_ ? path_->poseAt(time) : fixed_pose_;
  body.centre = body.world_from_body.translation();
  const FrameTwist twist = path_ ? path_->twistAt(inside) : FrameTwist{};
  body.velocity = twist.linear;
  body.angular_velocity = twist.angular;
}

}  // namespace concave_distance::detail
