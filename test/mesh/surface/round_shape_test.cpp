#include "concave_distance/mesh/surface/round_shape.h"

#include <gtest/gtest.h>

#include <limits>

#include "concave_distance/base/error.h"
#include "mesh/body_key.h"
#include "mesh/surface/round_geometry.h"
#include "support/round_bodies.h"

namespace concave_distance::round_shape_test {
namespace {

using test::roundShape;

TEST(RoundShape, RefusesWhatIsNoSolid) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double length : {0.0, -1.0, not_a_number, 1e18, std::numeric_limits<double>::infinity()}) {
    RoundShape shape = roundShape(RoundKind::Cylinder, 1.0, 1.0);
    shape.radius = length;
    EXPECT_THROW(shape.validate("radius"), Error) << length;
    shape = roundShape(RoundKind::Capsule, 1.0, length);
    EXPECT_THROW(shape.validate("length"), Error) << length;
    shape = roundShape(RoundKind::Sphere, 1.0);
    shape.chord_error = length;
    EXPECT_THROW(shape.validate("chord error"), Error) << length;
  }
  RoundShape shape = roundShape(RoundKind::Sphere, 1.0, 0.5);
  EXPECT_THROW(shape.validate("a sphere with a length"), Error);
  shape = roundShape(RoundKind::Sphere, 1.0);
  shape.body_from_shape.linear() *= 1.001;
  EXPECT_THROW(shape.validate("stretched"), Error);
  BodyMeshOptions options;
  options.shape = shape;
  EXPECT_THROW(BodyMesh("body", inscribedMesh(roundShape(RoundKind::Sphere, 1.0), "mesh"), options), Error);
}

TEST(RoundShape, ItsMeshIsInscribedAndItsBoundsHoldIt) {
  for (const RoundKind kind : {RoundKind::Sphere, RoundKind::Capsule, RoundKind::Cylinder}) {
    RoundShape shape = roundShape(kind, 0.3, kind == RoundKind::Sphere ? 0.0 : 0.5, 0.01);
    shape.body_from_shape =
        Eigen::Translation3d(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0);
    const SurfaceMesh mesh = inscribedMesh(shape, "mesh");
    const Eigen::AlignedBox3d box = boundingBox(shape);
    const Eigen::Isometry3d shape_from_body = shape.body_from_shape.inverse();
    for (const Eigen::Vector3d& vertex : mesh.vertices())
      EXPECT_LE(detail::signedDistance(shape, shape_from_body * vertex), 1e-15);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      const TriangleIndex triangle{t};
      const Eigen::Vector3d middle =
          (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3.0;
      const double value = detail::signedDistance(shape, shape_from_body * middle);
      EXPECT_LE(value, 1e-15);
      EXPECT_GE(value, -0.0101);
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        const Eigen::Vector3d out = sign * Eigen::Vector3d::Unit(axis);
        const Eigen::Vector3d far =
            shape.body_from_shape * detail::supportPoint(shape, shape_from_body.linear() * out);
        EXPECT_NEAR(far[axis], sign > 0.0 ? box.max()[axis] : box.min()[axis], 1e-15);
      }
    }
  }
}

TEST(RoundShape, ASolidAndItsMeshAreTwoBodies) {
  BodyMeshOptions mesh;
  BodyMeshOptions solid;
  solid.shape = roundShape(RoundKind::Sphere, 1.0);
  BodyMeshOptions larger = solid;
  larger.shape->radius = 1.001;
  const SurfaceMesh surface = inscribedMesh(*solid.shape, "mesh");
  const ContentKey key = surfaceKey(surface);
  EXPECT_NE(bodyKey(key, mesh), bodyKey(key, solid));
  EXPECT_NE(bodyKey(key, solid), bodyKey(key, larger));
  EXPECT_EQ(bodyKey(key, solid), bodyKey(key, solid));
  EXPECT_EQ(BodyMesh("mesh", surface, mesh).shape(), nullptr);
  EXPECT_NE(BodyMesh("solid", surface, solid).shape(), nullptr);
}

}  // namespace
}  // namespace concave_distance::round_shape_test
