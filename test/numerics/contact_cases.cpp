#include <cmath>

#include "numerics/numeric_cases.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"

namespace concave_distance::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Regular, one corner down at the origin of its frame, one unit across.
SurfaceMesh makeOctahedron() {
  return makeSurface(
      {{0, 0, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}, {-0.5, 0, 0.5}, {0, -0.5, 0.5}, {0, 0, 1}},
      {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {5, 1, 2}, {5, 2, 3}, {5, 3, 4}, {5, 4, 1}});
}

/// A prism with an edge down, along x through the origin of its frame.
SurfaceMesh makeWedge() {
  return makeSurface(
      {{-0.5, 0, 0}, {0.5, 0, 0}, {-0.5, -0.4, 0.6}, {0.5, -0.4, 0.6}, {-0.5, 0.4, 0.6}, {0.5, 0.4, 0.6}},
      {{0, 2, 4}, {1, 5, 3}, {0, 3, 2}, {0, 1, 3}, {0, 5, 1}, {0, 4, 5}, {2, 5, 4}, {2, 3, 5}});
}

SurfaceMesh makeUpsideDown(const SurfaceMesh& mesh) {
  std::vector<Vector3d> vertices = mesh.vertices();
  for (Vector3d& v : vertices) v = Vector3d(v.x(), -v.y(), -v.z());
  return SurfaceMesh(std::move(vertices), mesh.triangles(), "upside down");
}

struct Kind {
  const char* name;
  SurfaceMesh a;         ///< its top at z = 0
  SurfaceMesh b;         ///< its bottom at z = 0
  Quaterniond rotation;  ///< of B
  Vector3d aside;        ///< of B, within z = 0
};

std::vector<Kind> kinds() {
  const SurfaceMesh slab = makeCuboid({-0.6, -0.5, -0.4}, {0.6, 0.5, 0.0});
  const SurfaceMesh block = makeCuboid({-0.3, -0.4, 0.0}, {0.3, 0.4, 0.5});
  const SurfaceMesh roof = makeUpsideDown(makeWedge());
  const SurfaceMesh peak = makeUpsideDown(makeOctahedron());
  const Quaterniond none = Quaterniond::Identity();
  return {{"FaceOnFace", slab, block, none, {0, 0, 0}},
          {"FaceOnFaceTurned", slab, block, turn(0.7, Vector3d::UnitZ()), {0.1, -0.2, 0}},
          {"FaceOnFacePartly", slab, block, none, {0.55, 0.45, 0}},
          {"FaceOnFaceFlush", slab, block, none, {0.3, 0.1, 0}},
          {"FaceOnFaceCornerOverCorner", slab, block, none, {0.9, 0.9, 0}},
          {"EdgeOnEdgeCrossed", roof, makeWedge(), turn(M_PI_2, Vector3d::UnitZ()), {0, 0, 0}},
          {"EdgeOnEdgeAskew", roof, makeWedge(), turn(0.3, Vector3d::UnitZ()), {0.1, 0.02, 0}},
          {"EdgeOnEdgeNearlyParallel", roof, makeWedge(), turn(1e-8, Vector3d::UnitZ()), {0.1, 0, 0}},
          {"EdgeOnEdgeParallel", roof, makeWedge(), none, {0.2, 0, 0}},
          {"EdgeOnFace", slab, makeWedge(), turn(0.4, Vector3d::UnitZ()), {0, 0.1, 0}},
          {"VertexOnFace", slab, makeOctahedron(), turn(1.1, Vector3d::UnitZ()), {0.1, 0.2, 0}},
          {"VertexOnEdge", roof, makeOctahedron(), turn(1.1, Vector3d::UnitZ()), {0.1, 0, 0}},
          {"VertexOnVertex", peak, makeOctahedron(), turn(0.2, Vector3d::UnitZ()), {0, 0, 0}},
          {"VertexOnCornerOfABox", slab, makeOctahedron(), none, {0.6, 0.5, 0}}};
}

}  // namespace

std::vector<NumericCase> contactCases() {
  std::vector<NumericCase> cases;
  for (const Kind& kind : kinds()) {
    const double diameter = kind.b.diameter();
    for (const int power : {-12, -9, -6, -3, 0, 3}) {
      const double gap = std::pow(10.0, power) * diameter;
      const std::string name =
          std::string(kind.name) + "Gap1e" + (power < 0 ? "Minus" : "") + std::to_string(std::abs(power));
      const Vector3d place = kind.aside + gap * Vector3d::UnitZ();
      cases.push_back({name, kind.a, kind.b, givenPose(kind.rotation, place), Relation::Apart, gap});
    }
    cases.push_back({std::string(kind.name) + "Touching", kind.a, kind.b,
                     givenPose(kind.rotation, kind.aside), Relation::Meeting, 0.0});
    // The same contact seen from frames that no axis of the bodies is parallel to.
    const Quaterniond tilt = turn(0.9, {0.3, -0.8, 0.4});
    std::vector<Vector3d> tilted = kind.a.vertices();
    for (Vector3d& v : tilted) v = tilt * v;
    const Vector3d place = kind.aside + 1e-7 * Vector3d::UnitZ();
    cases.push_back({std::string(kind.name) + "Tilted", SurfaceMesh(tilted, kind.a.triangles(), "tilted"),
                     kind.b, givenPose(tilt * kind.rotation, tilt * place)});
  }
  const SurfaceMesh left = makeSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const double gap : {1e-12, 1e-6, 1.0}) {
    // In one plane, beside each other: edge along edge, corner to corner.
    cases.push_back({"CoplanarEdges" + std::to_string(cases.size()), left,
                     makeSurface({{-1, -0.5, 0}, {0, -0.5, 0}, {0, 1.5, 0}}, {{0, 1, 2}}),
                     givenPose(Quaterniond::Identity(), {-gap, 0, 0}), Relation::Apart, gap});
    cases.push_back({"CoplanarCorners" + std::to_string(cases.size()), left,
                     makeSurface({{0, 0, 0}, {1, 1, 0}, {1, -1, 0}}, {{0, 2, 1}}),
                     givenPose(Quaterniond::Identity(), {1.0 + gap, 0, 0}), Relation::Apart,
                     (1.0 + gap) - 1.0});
  }
  cases.push_back({"CoplanarOverlapping", left, left, givenPose(Quaterniond::Identity(), {0.25, 0.25, 0}),
                   Relation::Meeting, 0.0});
  cases.push_back({"TheSameTriangleTwice", left, left, GivenPose(), Relation::Meeting, 0.0});
  cases.push_back({"SharingAnEdge", left, left, givenPose(turn(M_PI_2, Vector3d::UnitX()), Vector3d::Zero()),
                   Relation::Meeting, 0.0});
  for (NumericCase& numeric_case : cases) numeric_case.coarse_grid = true;
  return cases;
}

}  // namespace concave_distance::test
