#include "simulation/rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/surface/primitives.h"

namespace concave_distance::rigid_body_test {
namespace {

MassProperties brick(const Eigen::Vector3d& moments) {
  MassProperties properties;
  properties.mass = 2.0;
  properties.centre_in_body = {0.1, -0.2, 0.3};
  properties.inertia = moments.asDiagonal();
  return properties;
}

/// Angle between two orientations.
double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return 2.0 * (a.conjugate() * b).vec().norm();
}

RigidBodyState tumbled(const RigidBody& body, const RigidBodyState& start, double duration, int steps) {
  RigidBodyState state = start;
  for (int i = 0; i < steps; ++i) body.drift(duration / steps, state);
  return state;
}

TEST(MassProperties, OfABoxAreThoseOfTheTextbook) {
  const Eigen::Vector3d size(0.3, 0.5, 0.7);
  const MassProperties box = massPropertiesOf(makeBox(size), 1000.0, "box");
  EXPECT_NEAR(box.mass, 105.0, 1e-12 * 105.0);
  EXPECT_LT(box.centre_in_body.norm(), 1e-15);
  const Eigen::Vector3d squares = size.cwiseAbs2();
  const Eigen::Vector3d moments = box.mass / 12.0 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
  EXPECT_LT((box.inertia - Eigen::Matrix3d(moments.asDiagonal())).norm(), 1e-13 * moments.norm());
}

TEST(MassProperties, MoveWithTheSurface) {
  const SurfaceMesh box = makeBox({0.3, 0.5, 0.7});
  const MassProperties there = massPropertiesOf(box, 7.0, "box");
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(10.0, -20.0, 5.0) * Eigen::Quaterniond(0.9, 0.2, -0.3, 0.1).normalized();
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3d& v : box.vertices()) vertices.push_back(pose * v);
  const MassProperties moved =
      massPropertiesOfMass(SurfaceMesh(vertices, box.triangles(), "box"), there.mass, "box");
  EXPECT_LT((moved.centre_in_body - pose.translation()).norm(), 1e-13);
  const Eigen::Matrix3d turned = pose.linear() * there.inertia * pose.linear().transpose();
  EXPECT_LT((moved.inertia - turned).norm(), 1e-12 * turned.norm());
}

TEST(MassProperties, OfARoundMeshTendToThoseOfTheSphere) {
  const double radius = 0.2;
  const MassProperties ball = massPropertiesOf(makeSphere(radius, 1e-5), 1.0, "ball");
  const double mass = 4.0 / 3.0 * kPi * std::pow(radius, 3);
  // Inscribed with chord error e: every radius is right within e, so a volume within 3 e / R.
  EXPECT_NEAR(ball.mass, mass, 3e-5 / radius * mass);
  EXPECT_NEAR(ball.inertia.trace() / 3.0, 0.4 * mass * radius * radius,
              5e-5 / radius * 0.4 * mass * radius * radius);
}

TEST(MassProperties, ImpossibleOnesAreRefused) {
  EXPECT_NO_THROW(brick({1.0, 2.0, 3.0}).validate("body"));
  EXPECT_THROW(brick({1.0, 1.0, 2.1}).validate("body"), Error);
  EXPECT_THROW(brick({0.0, 1.0, 1.0}).validate("body"), Error);
  MassProperties massless = brick({1.0, 1.0, 1.0});
  massless.mass = 0.0;
  EXPECT_THROW(massless.validate("body"), Error);
  const SurfaceMesh inside_out = [] {
    const SurfaceMesh box = makeBox({1.0, 1.0, 1.0});
    std::vector<TriangleNodes> turned = box.triangles();
    for (TriangleNodes& t : turned) std::swap(t[0], t[1]);
    return SurfaceMesh(box.vertices(), turned, "box");
  }();
  EXPECT_THROW(massPropertiesOf(inside_out, 1.0, "box"), Error);
}

TEST(RigidBody, GivesBackThePoseItWasPlacedAt) {
  MassProperties properties = brick({0.3, 0.4, 0.5});
  const Eigen::Matrix3d axes = Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized().toRotationMatrix();
  properties.inertia = axes * properties.inertia * axes.transpose();
  const RigidBody body(properties, "body");
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::Quaterniond(0.6, -0.1, 0.4, 0.2).normalized();
  const Eigen::Vector3d spin(0.3, -0.7, 1.1);
  const RigidBodyState state = body.stateAt(pose, {1.0, 0.0, 0.0}, spin);
  EXPECT_LT((body.worldFromBody(state).matrix() - pose.matrix()).norm(), 1e-14);
  EXPECT_LT((body.angularVelocity(state) - spin).norm(), 1e-14);
  const Eigen::Matrix3d inertia = pose.linear() * properties.inertia * pose.linear().transpose();
  EXPECT_NEAR(body.kineticEnergy(state), 0.5 * (properties.mass + spin.dot(inertia * spin)), 1e-14);
}

// A symmetric top turns about its angular momentum at |L| / I1 while it spins about its own axis at
// L3 (1/I3 - 1/I1): the orientation is exp(t L / I1) R(0) exp(t s e3).
TEST(RigidBody, SymmetricTopFollowsItsClosedFormWhateverTheStep) {
  const RigidBody top(brick({0.3, 0.3, 0.5}), "top");
  const RigidBodyState start =
      top.stateAt(Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), {1.0, 0.5, 9.0});
  const Eigen::Vector3d momentum = start.angular_momentum;
  const double duration = 2.0;
  // Principal axes come in ascending order of the moments: the third is the symmetry axis.
  const Eigen::Vector3d axis = start.world_from_principal * Eigen::Vector3d::UnitZ();
  const double own_spin = momentum.dot(axis) * (1.0 / 0.5 - 1.0 / 0.3);
  const Eigen::Quaterniond expected =
      Eigen::Quaterniond(Eigen::AngleAxisd(duration * momentum.norm() / 0.3, momentum.normalized())) *
      start.world_from_principal *
      Eigen::Quaterniond(Eigen::AngleAxisd(duration * own_spin, Eigen::Vector3d::UnitZ()));
  double last = 0.0;
  for (const int steps : {200, 400, 800}) {
    const double error = angleBetween(tumbled(top, start, duration, steps).world_from_principal, expected);
    if (steps > 200) {
      EXPECT_NEAR(last / error, 4.0, 0.1) << steps;
    }
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(RigidBody, TumblingIsOfSecondOrder) {
  const RigidBody body(brick({0.2, 0.35, 0.5}), "body");
  // About the middle axis, which is unstable: it turns over again and again.
  const RigidBodyState start =
      body.stateAt(Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), {0.1, 5.0, 0.1});
  const RigidBodyState reference = tumbled(body, start, 3.0, 200000);
  double last = 0.0;
  for (const int steps : {500, 1000, 2000}) {
    const double error =
        angleBetween(tumbled(body, start, 3.0, steps).world_from_principal, reference.world_from_principal);
    if (steps > 500) {
      EXPECT_NEAR(std::log2(last / error), 2.0, 0.05) << steps;
    }
    last = error;
  }
}

TEST(RigidBody, TumblingKeepsMomentumToRoundingAndEnergyWithoutDrift) {
  const RigidBody body(brick({0.2, 0.35, 0.5}), "body");
  RigidBodyState state = body.stateAt(Eigen::Isometry3d::Identity(), {1.0, 2.0, 3.0}, {0.1, 5.0, 0.1});
  const Eigen::Vector3d momentum = state.angular_momentum;
  const double energy = body.kineticEnergy(state);
  double largest_first = 0.0;
  double largest_last = 0.0;
  const int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    body.drift(0.01, state);
    const double error = std::abs(body.kineticEnergy(state) - energy);
    if (i < steps / 10) largest_first = std::max(largest_first, error);
    if (i >= steps - steps / 10) largest_last = std::max(largest_last, error);
  }
  EXPECT_EQ(state.angular_momentum, momentum);
  EXPECT_LT(largest_first, 1e-3 * energy);
  // Symplectic: the error swings and does not grow.
  EXPECT_LT(largest_last, 1.05 * largest_first);
}

TEST(RigidBody, ItsInertiaTurnsWithIt) {
  const RigidBody body(brick({0.2, 0.35, 0.5}), "body");
  const Eigen::Vector3d spin(0.3, -0.7, 1.1);
  const RigidBodyState state = body.stateAt(
      Eigen::Isometry3d(Eigen::Quaterniond(0.6, -0.1, 0.4, 0.2).normalized()), Eigen::Vector3d::Zero(), spin);
  EXPECT_LT((body.inertia(state) * spin - state.angular_momentum).norm(), 1e-15);
}

TEST(RigidBody, DriftTellsHowFarPointsMayHaveGone) {
  const RigidBody body(brick({0.2, 0.35, 0.5}), "body");
  RigidBodyState state = body.stateAt(Eigen::Isometry3d::Identity(), {0.4, 0.0, 0.0}, {3.0, 5.0, 1.0});
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d before = body.worldFromBody(state);
    const Drift drift = body.drift(0.05, state);
    const Eigen::Isometry3d after = body.worldFromBody(state);
    for (const Eigen::Vector3d& point :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, -1)}) {
      const double radius = (point - body.centreInBody()).norm();
      EXPECT_LE((after * point - before * point).norm(), drift.shift.norm() + radius * drift.turn + 1e-14);
    }
  }
}

}  // namespace
}  // namespace concave_distance::rigid_body_test
