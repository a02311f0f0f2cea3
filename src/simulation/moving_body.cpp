#include "moving_body.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"

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
    return settings.density ? massPropertiesOf(body.mesh->surface(), *settings.density, where)
                            : massPropertiesOfMass(body.mesh->surface(), *settings.mass, where);
  }
  if (body.inertia) return *body.inertia;
  throw Error(where, "the free body '" + body.name + "' has no mass",
              "give one of inertia, density, mass, or fixed: true");
}

double radiusAbout(const SurfaceMesh& surface, const Eigen::Vector3d& point) {
  double squared = 0.0;
  for (const Eigen::Vector3d& vertex : surface.vertices())
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
  const SurfaceMesh& surface = body.mesh->surface();
  if (motion_ == BodyMotion::Driven) path_.emplace(settings.path);
  if (motion_ != BodyMotion::Free) {
    radius_ = radiusAbout(surface, Eigen::Vector3d::Zero());
    return;
  }
  rigid_.emplace(massOf(body, settings), settings.where.empty() ? body.name : settings.where);
  radius_ = radiusAbout(surface, rigid_->centreInBody());
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

Eigen::Vector3d MovingBody::referenceVelocity(double inside) const {
  if (rigid_) return state_.velocity;
  return path_ ? path_->twistAt(inside).linear : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

double MovingBody::angularSpeed(double inside) const {
  if (rigid_) return rigid_->angularVelocity(state_).norm();
  return path_ ? path_->twistAt(inside).angular.norm() : 0.0;
}

double MovingBody::spinSpeed(double inside) const {
  return radius_ * angularSpeed(inside);
}

void MovingBody::evaluateExternal(double time, double inside, const RigidBodyState& state,
                                  const Wrench& external) {
  load_now_ = external;
  if (!loads_.empty()) {
    const Eigen::Isometry3d world_from_body = rigid_->worldFromBody(state);
    for (const AppliedLoad& load : loads_) {
      if (isActive(load, inside)) load_now_ += wrenchOf(load, world_from_body, state.centre);
    }
  }
  if (drive_) drive_now_ = driveForce(*drive_, *target_, time, inside, *rigid_, state);
}

void MovingBody::setDriveTarget(const Eigen::Isometry3d& pose) {
  target_.emplace(std::vector<TimedPose>{{0.0, pose}});
}

double MovingBody::driveStiffnessRate() const {
  if (!drive_) return 0.0;
  const Eigen::Vector3d point =
      rigid_->worldFromBody(state_) * Eigen::Vector3d(drive_->body_from_drive.translation());
  return drive_->stiffness.maxCoeff() * rigid_->largestCompliance(state_, point) +
         drive_->rotational_stiffness.maxCoeff() / rigid_->principalMoments()[0];
}

double MovingBody::driveDampingRate() const {
  if (!drive_) return 0.0;
  const Eigen::Vector3d point =
      rigid_->worldFromBody(state_) * Eigen::Vector3d(drive_->body_from_drive.translation());
  return drive_->damping.maxCoeff() * rigid_->largestCompliance(state_, point) +
         drive_->rotational_damping.maxCoeff() / rigid_->principalMoments()[0];
}

Wrench MovingBody::total(const Wrench& contact, const Eigen::Vector3d& gravity) const {
  Wrench total = contact;
  total += load_now_;
  total += drive_now_.on_body;
  total.force += rigid_->mass() * gravity;
  return total;
}

Drift MovingBody::advance(double time, double step, const Wrench& contact, const Eigen::Vector3d& gravity) {
  if (rigid_) {
    before_ = state_;
    rigid_->kick(total(contact, gravity), 0.5 * step, state_);
    return rigid_->drift(step, state_);
  }
  Drift drift;
  if (path_) {
    const Eigen::Isometry3d from = path_->poseAt(time);
    const Eigen::Isometry3d to = path_->poseAt(time + step);
    drift.shift = to.translation() - from.translation();
    drift.turn = path_->twistAt(time + 0.5 * step).angular.norm() * step;
  }
  return drift;
}

RigidBodyState MovingBody::extrapolated(double step, const Wrench& contact,
                                        const Eigen::Vector3d& gravity) const {
  RigidBodyState state = state_;
  rigid_->kick(total(contact, gravity), 0.5 * step, state);
  return state;
}

void MovingBody::kick(const Wrench& contact, const Eigen::Vector3d& gravity, double step) {
  rigid_->kick(total(contact, gravity), step, state_);
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
