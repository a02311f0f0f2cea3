// Cases that other libraries test, or that their users have stumbled over, on the proof and on the kernel.
#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "distance/bound/certificate.h"
#include "mesh/surface/mesh_topology.h"
#include "support/body_pairs.h"
#include "support/exact_query.h"
#include "support/query_bound.h"
#include "support/temporary_folder.h"

namespace concave_distance::field_cases_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

DistanceCertificate certify(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& pose) {
  CertificateWorkspace workspace;
  return certifyDistance(a, b, pose, nullptr, 0, CertificateRequest(), workspace);
}

Quaterniond turn(double angle, const Vector3d& axis) {
  return Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

void expectTruth(const SurfaceMesh& a, const SurfaceMesh& b, const test::GivenPose& pose) {
  const test::Wide truth = test::exactSurfaceDistance(a, b, pose);
  const double bound = test::queryBound(a, b, pose.translation, static_cast<double>(truth));
  const DistanceCertificate found = certify(*test::makeBody(a), *test::makeBody(b), pose.isometry());
  EXPECT_LE(test::Wide(found.lower_bound), truth);
  EXPECT_LE(static_cast<double>(boost::multiprecision::abs(truth - test::Wide(found.distance))), bound)
      << found.distance << " instead of " << static_cast<double>(truth);
  EXPECT_EQ(found.status == CertificateStatus::Penetrating, found.distance == 0.0);
}

TEST(FieldCases, KissingTiltedBoxes) {
  // FCL, test_fcl_signed_distance.cpp: faces that touch but for a few roundings, far from the origin.
  const Quaterniond tilt = turn(M_PI_4, {1, 1, 0.3});
  for (const double side : {0.01, 0.25, 0.5, 10.0, 1000.0}) {
    const SurfaceMesh box = makeBox(Vector3d::Constant(side));
    std::vector<Vector3d> corners = box.vertices();
    for (Vector3d& corner : corners) corner = tilt * corner + Vector3d::Constant(5.0 * side);
    const SurfaceMesh tilted(corners, box.triangles(), "tilted");
    for (const double gap : {0.0, 1e-16, -1e-16, 2.5e-16, -2.5e-16, 1e-15, -1e-15}) {
      SCOPED_TRACE("side " + std::to_string(side) + ", gap " + std::to_string(gap * 1e16) + "e-16");
      const Vector3d shift = tilt * Vector3d(0, 0, side + gap * std::max(1.0, side));
      expectTruth(tilted, box, test::givenPose(tilt, Vector3d::Constant(5.0 * side) + shift));
    }
  }
}

TEST(FieldCases, NearlyParallelBoxes) {
  const SurfaceMesh box = makeBox({0.05, 0.55, 0.3});
  for (const double gap : {1e-12, 1e-6, 1e-3, 0.1}) {
    for (const Vector3d& axis :
         {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1, 1)}) {
      expectTruth(box, box, test::givenPose(turn(7.96e-4, axis), {0.05 + gap, 0.02, 0.01}));
      expectTruth(box, box, test::givenPose(turn(7.96e-4, axis), {0.0505 + gap, 0.02, 0.01}));
    }
  }
}

TEST(FieldCases, TrianglesThatAreNearlySegmentsOrPoints) {
  // FCL, test_gjk_libccd-inl_extractClosestPoints.cpp: coincident and collinear within an epsilon.
  const TrianglePoints other = {Vector3d(0.3, -0.2, 0.8), Vector3d(1.4, 0.1, 0.9), Vector3d(0.2, 1.1, 1.3)};
  for (const double scale : {0.01, 1.0, 100.0}) {
    for (const double factor : {0.75, 1.5}) {
      const double off = factor * kEpsilon * scale;
      const double collinear = scale * std::sin(factor * std::asin(kEpsilon));
      const Vector3d p = scale * Vector3d(0.4, 0.7, 0.2);
      const Vector3d q = p + scale * Vector3d(0.6, 0.0, -0.8);
      const TrianglePoints degenerate[] = {{p, p + Vector3d(off, 0, 0), q},
                                           {p, q, q + Vector3d(0, off, 0)},
                                           {p, p + Vector3d(off, 0, 0), p + Vector3d(0, off, 0)},
                                           {p, q, 0.5 * (p + q) + Vector3d(0, collinear, 0)},
                                           {p, q, p + 2.0 * (q - p) + Vector3d(0, collinear, 0)}};
      for (const TrianglePoints& triangle : degenerate) {
        const TrianglePoints there = test::scaled(other, scale);
        const double found = std::sqrt(triangleDistance(triangle, there).squared_distance);
        EXPECT_LE(test::exactDistanceError(found, triangle, there),
                  kTriangleDistanceError * test::largestCoordinate(triangle, there));
      }
    }
  }
}

TEST(FieldCases, ASliverOfFourteenMetresAgainstSixMillimetres) {
  // coal, test/gjk.cpp: a 14.729 m by 5.3 mm triangle against one of 6 mm, on and beside it.
  const TrianglePoints sliver = {Vector3d(-7.3645, 0, 0), Vector3d(7.3645, 0, 0),
                                 Vector3d(7.3645, 0.0053, 0)};
  RandomEngine engine(1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d place(test::uniformIn(engine, -7.5, 7.5), test::uniformIn(engine, -0.01, 0.015),
                         test::powerOfTen(engine, -12, -1));
    const TrianglePoints small =
        test::moved(test::scaled(test::randomTriangle(engine), 0.003), test::randomRotation(engine), place);
    const double found = std::sqrt(triangleDistance(sliver, small).squared_distance);
    EXPECT_LE(test::exactDistanceError(found, sliver, small), kTriangleDistanceError * 7.5);
  }
}

/// A regular icosahedron's triangles cut in four, every corner at `radius`: 80 triangles.
SurfaceMesh makeIcosphere(double radius) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3d> vertices;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-golden, golden}) {
      vertices.insert(vertices.end(), {{0, s, t}, {s, t, 0}, {t, 0, s}});
    }
  }
  std::vector<TriangleNodes> triangles;
  const auto midpoint = [&](std::uint32_t i, std::uint32_t j) {
    const Vector3d middle = vertices[i] + vertices[j];
    for (std::uint32_t k = 12; k < vertices.size(); ++k) {
      if ((vertices[k] - middle).norm() < 1e-9) return k;
    }
    vertices.push_back(middle);
    return static_cast<std::uint32_t>(vertices.size() - 1);
  };
  const auto is_edge = [&](std::uint32_t i, std::uint32_t j) {
    return (vertices[i] - vertices[j]).norm() < 2.1;
  };
  for (std::uint32_t i = 0; i < 12; ++i) {
    for (std::uint32_t j = i + 1; j < 12; ++j) {
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!is_edge(i, j) || !is_edge(j, k) || !is_edge(k, i)) continue;
        const bool outwards = vertices[i].cross(vertices[j]).dot(vertices[k]) > 0.0;
        const std::uint32_t corner[3] = {i, outwards ? j : k, outwards ? k : j};
        const std::uint32_t middle[3] = {midpoint(corner[0], corner[1]), midpoint(corner[1], corner[2]),
                                         midpoint(corner[2], corner[0])};
        triangles.push_back({NodeIndex{middle[0]}, NodeIndex{middle[1]}, NodeIndex{middle[2]}});
        for (std::size_t c = 0; c < 3; ++c) {
          triangles.push_back({NodeIndex{corner[c]}, NodeIndex{middle[c]}, NodeIndex{middle[(c + 2) % 3]}});
        }
      }
    }
  }
  for (Vector3d& v : vertices) v *= radius / v.norm();
  return SurfaceMesh(std::move(vertices), std::move(triangles), "icosphere");
}

TEST(FieldCases, MeshSpheresEdgeOnEdgeAndVertexOnVertex) {
  // tesseract, collision_mesh_mesh_unit.hpp: r = 0.25, centres 1 apart: 0.52448 over the edges, 0.5 over
  // vertices.
  const SurfaceMesh sphere = makeIcosphere(0.25);
  ASSERT_EQ(sphere.triangleCount(), 80U);
  const auto body = test::makeBody(sphere);
  ASSERT_TRUE(body->topology().allShellsClosed());
  const Eigen::Isometry3d opposite = [] {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI, Vector3d::UnitZ()));
    pose.translation() = Vector3d(1, 0, 0);
    return pose;
  }();
  // A direction of the sphere turned to x, for both bodies alike.
  const auto distance_along = [&](const Vector3d& direction) {
    const Quaterniond to_x = Quaterniond::FromTwoVectors(direction, Vector3d::UnitX());
    std::vector<Vector3d> vertices = sphere.vertices();
    for (Vector3d& v : vertices) v = to_x * v;
    const auto turned = test::makeBody(SurfaceMesh(vertices, sphere.triangles(), "turned"));
    return certify(*turned, *turned, opposite).distance;
  };
  const double bound = kProofError * 1.5;
  EXPECT_NEAR(distance_along(sphere.vertices()[13]), 0.5, bound);
  const TriangleNodes& inner = sphere.triangles()[0];  // its edges span 36 degrees
  EXPECT_NEAR(distance_along(sphere.vertex(inner[0]) + sphere.vertex(inner[1])),
              1.0 - 0.5 * std::cos(M_PI / 10.0), bound);
}

TEST(FieldCases, AGridOfFiveByFiveByFiveSpheresHasExactlyThreeHundredContacts) {
  // tesseract, collision_large_dataset_unit.hpp.
  const auto sphere = test::makeBody(makeIcosphere(0.55));
  int contacts = 0;
  for (int i = 0; i < 125; ++i) {
    for (int j = i + 1; j < 125; ++j) {
      const Vector3d from(i % 5, i / 5 % 5, i / 25);
      const Vector3d to(j % 5, j / 5 % 5, j / 25);
      const DistanceCertificate found = certify(*sphere, *sphere, test::translation(to - from));
      contacts += found.status == CertificateStatus::Penetrating ? 1 : 0;
      EXPECT_EQ(found.distance == 0.0, (to - from).norm() < 1.2);
    }
  }
  EXPECT_EQ(contacts, 300);
}

TEST(FieldCases, WitnessesTellHowFarToMoveUntilContact) {
  // coal, test/normal_and_nearest_points.cpp, on boxes: where a corner may lead past a sharp tip nothing is
  // said.
  RandomEngine engine(2);
  int apart = 0;
  for (int round = 0; round < 1000; ++round) {
    const auto size = [&] {
      return Vector3d(test::uniformIn(engine, 0.1, 1), test::uniformIn(engine, 0.1, 1),
                      test::uniformIn(engine, 0.1, 1));
    };
    const auto a = test::makeBody(makeBox(size()));
    const auto b = test::makeBody(makeBox(size()));
    Eigen::Isometry3d pose = test::randomPose(engine, 1.2);
    const DistanceCertificate found = certify(*a, *b, pose);
    if (found.distance < 0.02) continue;
    ++apart;
    const Vector3d normal = (found.witness.point_b_in_a - found.witness.point_a_in_a) / found.distance;
    const Vector3d there = pose.translation();
    pose.translation() = there - (found.distance - 0.01) * normal;
    EXPECT_NEAR(certify(*a, *b, pose).distance, 0.01, 1e-14);
    pose.translation() = there - (found.distance + 0.01) * normal;
    EXPECT_EQ(certify(*a, *b, pose).status, CertificateStatus::Penetrating);
  }
  EXPECT_GT(apart, 500);
}

// Meshes at the ends of what there is: a million triangles, files in other units, bodies without extent.
TEST(ExtremeMesh, OneRaisedVertexAmongAMillionTrianglesIsFound) {
  // A flat sheet, but for one vertex 1e-6 above it: nothing else tells that pair from its neighbours.
  constexpr std::uint32_t kSide = 708;
  const SurfaceMesh flat = test::makeSheet(kSide, kSide, 1e-3);
  std::vector<Vector3d> vertices = flat.vertices();
  const std::size_t raised = 431 * (kSide + 1) + 217;
  vertices[raised].z() = 1e-6;
  const auto sheet = test::makeBody(SurfaceMesh(std::move(vertices), flat.triangles(), "sheet"));
  ASSERT_GT(sheet->surface().triangleCount(), 1'000'000U);
  const auto box = test::makeBody(test::makeCuboid({-1, -1, 0.25}, {2, 2, 0.5}));
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  const DistanceCertificate found = certify(*sheet, *box, identity);
  const double error = kProofError * proofScale(*sheet, *box, identity);
  EXPECT_NEAR(found.distance, 0.25 - 1e-6, error);
  EXPECT_GE(found.lower_bound, 0.25 - 1e-6 - 2.0 * error);
  EXPECT_LE((found.witness.point_a_in_a - sheet->surface().vertices()[raised]).norm(), 1e-9);
}

TEST(ExtremeMesh, AFileInOtherUnitsIsTheSameBody) {
  const test::TemporaryFolder folder;
  const SurfaceMesh hook = test::makeHook();
  const auto comb = test::makeBody(test::makeComb(3));
  Eigen::Isometry3d pose(Eigen::AngleAxisd(1.3, Vector3d(0.2, 0.9, -0.5).normalized()));
  pose.translation() = Vector3d(0.2, 0.9, 0.3);
  const double plain = certify(*comb, *test::makeBody(hook), pose).distance;
  for (const double unit : {1e-3, 1e3}) {
    for (const char* format : {"hook.stl", "hook.obj", "hook.ply"}) {
      std::vector<Vector3d> vertices = hook.vertices();
      for (Vector3d& v : vertices) v /= unit;
      exportMesh(SurfaceMesh(vertices, hook.triangles(), "hook"), folder.path(format));
      const TriangleSoup soup = importMesh(folder.path(format), Vector3d::Constant(unit));
      const auto body = test::makeBody(repairMesh(soup, RepairOptions(), format).mesh);
      // Import rounds coordinates to single precision.
      EXPECT_NEAR(certify(*comb, *body, pose).distance, plain, 4.0 * 6e-8 * hook.diameter())
          << unit << format;
    }
  }
}

TEST(ExtremeMesh, ABodyWithoutExtentInDoublePrecisionIsRefused) {
  for (const double size : {1e-310, 5e-324, 1e-170}) {
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    soup.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    EXPECT_THROW(repairMesh(soup, RepairOptions(), "grain"), Error) << size;
  }
}

}  // namespace
}  // namespace concave_distance::field_cases_test
