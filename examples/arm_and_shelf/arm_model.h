// An arm of four joints in front of a shelf: bodies, joints, drives and gravity in Simbody, contact by this
// package.
#pragma once

#include <array>
#include <cstddef>

#include "simbody_contact.h"

inline constexpr std::size_t kJoints = 4;
inline constexpr std::array<const char*, kJoints> kJointNames = {"turret", "shoulder", "elbow", "wrist"};

/// Torques of one state, N m, by joint; at rest they add up to nothing.
struct JointTorques {
  std::array<double, kJoints> contact;  ///< J^T of the contacts' wrenches
  std::array<double, kJoints> gravity;
  std::array<double, kJoints> drive;  ///< springs and dampers towards the target
};

class ArmModel {
 public:
  ArmModel();

  const SimTK::MultibodySystem& system() const { return system_; }
  const SimTK::State& start() const { return state_; }
  SimbodyContact& contact() { return *contact_; }
  const SimbodyContact& contact() const { return *contact_; }

  double angle(const SimTK::State& state, std::size_t joint) const {
    return joints_[joint].getOneQ(state, 0);
  }
  JointTorques torques(const SimTK::State& state) const;
  double dampingPower(const SimTK::State& state) const;  ///< that the drives take, W
  double contactPower(const SimTK::State& state) const;  ///< that the contacts give, W

 private:
  void addArm();
  void addContacts();
  SimTK::Vector_<SimTK::SpatialVec> contactForces(const SimTK::State& state) const;

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::UniformGravity gravity_;
  std::array<SimTK::MobilizedBody, kJoints> joints_;
  SimbodyContact* contact_ = nullptr;  ///< the system's
  SimTK::State state_;
};
