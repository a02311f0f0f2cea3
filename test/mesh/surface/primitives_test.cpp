#include "concave_distance/mesh/surface/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/constants.h"
#include "base/random_engine.h"
#include "concave_distance/base/error.h"
#include "support/mesh_measures.h"

namespace concave_distance::primitives_test {
namespace {

using test::distanceToSurface;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A solid by its signed distance and a way to draw points of its surface.
struct Solid {
  std::string name;
  SurfaceMesh mesh;
  double size;
  double chord_error;
  double volume;
  std::function<double(const Eigen::Vector3d&)> signed_distance;
  std::function<Eigen::Vector3d(RandomEngine&)> surface_point;
};

Eigen::Vector3d direction(RandomEngine& engine) {
  const double z = 2.0 * uniformUnit(engine) - 1.0;
  const double angle = 2.0 * kPi * uniformUnit(engine);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Solid sphere(double radius, double chord_error) {
  return {"sphere",
          makeSphere(radius, chord_error),
          radius,
          chord_error,
          4.0 / 3.0 * kPi * std::pow(radius, 3),
          [=](const Eigen::Vector3d& p) { return p.norm() - radius; },
          [=](RandomEngine& engine) -> Eigen::Vector3d { return radius * direction(engine); }};
}

Solid cylinder(double radius, double length, double chord_error) {
  return {"cylinder",
          makeCylinder(radius, length, chord_error),
          std::hypot(radius, length),
          chord_error,
          kPi * radius * radius * length,
          [=](const Eigen::Vector3d& p) {
            return std::max(p.head<2>().norm() - radius, std::abs(p.z()) - 0.5 * length);  // inside: exact
          },
          [=](RandomEngine& engine) -> Eigen::Vector3d {
            const double angle = 2.0 * kPi * uniformUnit(engine);
            const Eigen::Vector2d around(std::cos(angle), std::sin(angle));
            const bool side = uniformUnit(engine) < 0.5;
            const double r = side ? radius : radius * std::sqrt(uniformUnit(engine));
            const double z = side ? length * (uniformUnit(engine) - 0.5)
                                  : (uniformUnit(engine) < 0.5 ? 0.5 : -0.5) * length;
            return {r * around.x(), r * around.y(), z};
          }};
}

Solid capsule(double radius, double length, double chord_error) {
  return {"capsule",
          makeCapsule(radius, length, chord_error),
          radius + length,
          chord_error,
          kPi * radius * radius * (length + 4.0 / 3.0 * radius),
          [=](const Eigen::Vector3d& p) {
            const double z = std::clamp(p.z(), -0.5 * length, 0.5 * length);
            return (p - Eigen::Vector3d(0.0, 0.0, z)).norm() - radius;
          },
          [=](RandomEngine& engine) -> Eigen::Vector3d {
            const Eigen::Vector3d u = direction(engine);
            if (uniformUnit(engine) < 0.5) {
              return radius * u + Eigen::Vector3d(0.0, 0.0, std::copysign(0.5 * length, u.z()));
            }
            const Eigen::Vector2d around = u.head<2>().normalized();
            return {radius * around.x(), radius * around.y(), length * (uniformUnit(engine) - 0.5)};
          }};
}

Solid cone(double radius, double length, double chord_error) {
  return {"cone",
          makeCone(radius, length, chord_error),
          std::hypot(radius, length),
          chord_error,
          kPi * radius * radius * length / 3.0,
          [=](const Eigen::Vector3d& p) {
            const double side = p.head<2>().norm() * length + (p.z() - 0.5 * length) * radius;
            return std::max(side / std::hypot(radius, length), -p.z() - 0.5 * length);  // inside: exact
          },
          [=](RandomEngine& engine) -> Eigen::Vector3d {
            const double angle = 2.0 * kPi * uniformUnit(engine);
            const double share = std::sqrt(uniformUnit(engine));
            const double z = uniformUnit(engine) < 0.5 ? -0.5 * length : (0.5 - share) * length;
            return {share * radius * std::cos(angle), share * radius * std::sin(angle), z};
          }};
}

std::vector<Solid> roundSolids() {
  std::vector<Solid> solids;
  for (const double relative : {0.5, 0.1, 0.01, 0.002}) {
    solids.push_back(sphere(0.3, 0.3 * relative));
    solids.push_back(cylinder(0.2, 0.7, 0.2 * relative));
    solids.push_back(cylinder(2.0, 0.05, 2.0 * relative));
    solids.push_back(capsule(0.1, 0.4, 0.1 * relative));
    solids.push_back(cone(0.3, 0.5, 0.3 * relative));
    solids.push_back(cone(2.0, 0.05, 2.0 * relative));
  }
  solids.push_back(sphere(1e-4, 1e-6));
  solids.push_back(sphere(1e4, 1e2));
  return solids;
}

TEST(Primitives, AreClosedOutwardAndOfOnePiece) {
  for (const Solid& solid : roundSolids()) {
    SCOPED_TRACE(solid.name + ", chord error " + std::to_string(solid.chord_error));
    EXPECT_TRUE(test::isClosedManifold(solid.mesh));
    EXPECT_EQ(test::eulerCharacteristic(solid.mesh), 2);
    EXPECT_GT(test::signedVolume(solid.mesh), 0.0);
  }
  const SurfaceMesh box = makeBox({1.0, 2.0, 3.0});
  EXPECT_TRUE(test::isClosedManifold(box));
  EXPECT_EQ(test::eulerCharacteristic(box), 2);
}

TEST(Primitives, BoxHasItsVolumeAreaAndPlace) {
  const SurfaceMesh box = makeBox({1.0, 2.0, 3.0});
  EXPECT_EQ(box.vertexCount(), 8U);
  EXPECT_DOUBLE_EQ(test::signedVolume(box), 6.0);
  EXPECT_DOUBLE_EQ(test::totalArea(box), 22.0);
  EXPECT_EQ(box.boundingBox().min(), Eigen::Vector3d(-0.5, -1.0, -1.5));
  EXPECT_EQ(box.boundingBox().max(), Eigen::Vector3d(0.5, 1.0, 1.5));
}

TEST(Primitives, NoPointOfTheMeshLiesOutsideTheSolid) {
  for (const Solid& solid : roundSolids()) {
    SCOPED_TRACE(solid.name + ", chord error " + std::to_string(solid.chord_error));
    for (const Eigen::Vector3d& vertex : solid.mesh.vertices()) {  // the solids are convex: corners suffice
      // A vertex is a product of two rounded factors in each coordinate, then a norm of three squares.
      EXPECT_LE(std::abs(solid.signed_distance(vertex)), solid.size);
      EXPECT_LE(solid.signed_distance(vertex), 4.0 * kEpsilon * solid.size);
    }
  }
}

TEST(Primitives, NoPointOfTheTrueSurfaceIsFartherThanTheChordError) {
  RandomEngine engine(11);
  for (const Solid& solid : roundSolids()) {
    SCOPED_TRACE(solid.name + ", chord error " + std::to_string(solid.chord_error));
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
      worst = std::max(worst, distanceToSurface(solid.surface_point(engine), solid.mesh));
    }
    EXPECT_LE(worst, solid.chord_error * (1.0 + 1e-12) + 8.0 * kEpsilon * solid.size);
  }
}

TEST(Primitives, ChordErrorIsNotOverfulfilledByMuch) {
  // The volume that is lost grows with the gap between the mesh and the solid; a mesh four times finer
  // than asked for would lose less than these fractions of (surface x chord error).
  for (const double chord_error : {0.01, 0.001}) {
    const Solid ball = sphere(1.0, chord_error);
    const double lost = ball.volume - test::signedVolume(ball.mesh);
    EXPECT_GT(lost, 0.25 * 4.0 * kPi * chord_error);
    EXPECT_LT(lost, 4.0 * kPi * chord_error);
  }
}

TEST(Primitives, RoundSurfacesReachTheirExtremesAlongTheAxes) {
  const SurfaceMesh ball = makeSphere(0.3, 0.01);
  EXPECT_EQ(ball.boundingBox().max(), Eigen::Vector3d::Constant(0.3));
  EXPECT_EQ(ball.boundingBox().min(), Eigen::Vector3d::Constant(-0.3));
  const SurfaceMesh tin = makeCylinder(0.2, 1.0, 0.003);
  EXPECT_EQ(tin.boundingBox().max(), Eigen::Vector3d(0.2, 0.2, 0.5));
  EXPECT_EQ(tin.boundingBox().min(), Eigen::Vector3d(-0.2, -0.2, -0.5));
  const SurfaceMesh pill = makeCapsule(0.25, 1.0, 0.003);
  EXPECT_EQ(pill.boundingBox().max(), Eigen::Vector3d(0.25, 0.25, 0.75));
  EXPECT_EQ(pill.boundingBox().min(), Eigen::Vector3d(-0.25, -0.25, -0.75));
}

TEST(Primitives, SpheresHaveNoSlivers) {
  for (const double chord_error : {0.1, 0.01, 0.001}) {
    EXPECT_GT(test::smallestAngle(makeSphere(1.0, chord_error)), 30.0 * kPi / 180.0) << chord_error;
  }
}

TEST(Primitives, RefuseSizesThatAreNotPositiveOrTooLarge) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinity, 1e200}) {
    EXPECT_THROW(makeBox({1.0, bad, 1.0}), Error);
    EXPECT_THROW(makeSphere(bad, 0.1), Error);
    EXPECT_THROW(makeSphere(1.0, bad), Error);
    EXPECT_THROW(makeCylinder(bad, 1.0, 0.1), Error);
    EXPECT_THROW(makeCylinder(1.0, bad, 0.1), Error);
    EXPECT_THROW(makeCylinder(1.0, 1.0, bad), Error);
    EXPECT_THROW(makeCapsule(bad, 1.0, 0.1), Error);
    EXPECT_THROW(makeCapsule(1.0, bad, 0.1), Error);
    EXPECT_THROW(makeCapsule(1.0, 1.0, bad), Error);
  }
}

TEST(Primitives, RefuseAChordErrorThatNoMemoryHolds) {
  EXPECT_THROW(makeSphere(1.0, 1e-9), Error);
  EXPECT_THROW(makeCylinder(1.0, 1.0, 1e-15), Error);
}

TEST(Primitives, ErrorsNameTheirElement) {
  try {
    makeSphere(-1.0, 0.1, "link 'tool', collision 2");
    FAIL() << "a negative radius was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "link 'tool', collision 2");
    EXPECT_NE(std::string(error.what()).find("-1"), std::string::npos);
  }
}

}  // namespace
}  // namespace concave_distance::primitives_test
