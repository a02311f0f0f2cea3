
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "numerics/numeric_cases.h"
#include "support/concave_shapes.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"

namespace concave_distance::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

GivenPose askew(double x, double y, double z) {
  return givenPose(Quaterniond(Eigen::AngleAxisd(1.3, Vector3d(0.2, 0.9, -0.5).normalized())), {x, y, z});
}

/// Every triangle with corners of its own, as an STL file has them.
SurfaceMesh makeUnwelded(const SurfaceMesh& mesh) {
  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (const TriangleNodes& t : mesh.triangles()) {
    const NodeIndex first{vertices.size()};
    for (const NodeIndex corner : t) vertices.push_back(mesh.vertex(corner));
    triangles.push_back({first, NodeIndex{first.value + 1}, NodeIndex{first.value + 2}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "unwelded");
}

SurfaceMesh repaired(const SurfaceMesh& mesh) {
  return repairMesh(soupOf(mesh), RepairOptions(), "numeric case").mesh;
}

/// Triangles without area added: one along an edge of each triangle and, when `repeated`, some that name a
/// corner twice or three times.
SurfaceMesh withZeroAreaTriangles(const SurfaceMesh& mesh, bool repeated) {
  std::vector<Vector3d> vertices = mesh.vertices();
  std::vector<TriangleNodes> triangles;
  for (const TriangleNodes& t : mesh.triangles()) {
    if (repeated) {
      triangles.push_back({t[0], t[1], t[0]});
      triangles.push_back({t[2], t[2], t[2]});
    }
    vertices.emplace_back(0.5 * (mesh.vertex(t[0]) + mesh.vertex(t[1])));
    triangles.push_back({t[0], NodeIndex{vertices.size() - 1}, t[1]});
    triangles.push_back(t);
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "with zero area");
}

SurfaceMesh withMixedWinding(const SurfaceMesh& mesh) {
  std::vector<TriangleNodes> triangles = mesh.triangles();
  for (std::size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i][0], triangles[i][1]);
  return SurfaceMesh(mesh.vertices(), std::move(triangles), "mixed winding");
}

/// A cuboid whose faces are fans of needles: every edge of the top is cut `count` times, all cuts lead to one
/// corner of it.
SurfaceMesh makeNeedleFan(int count, double width) {
  // The prism over a polygon with `count` corners along one side, `width` apart; the outline's own
  // triangulation makes the fans.
  Outline outline{{0.0, 0.0}, {1.0, 0.0}};
  for (int i = 0; i < count; ++i) outline.emplace_back(1.0 - i * width, 1.0);
  outline.emplace_back(0.0, 1.0);
  return makeExtrusion(outline, 0.5);
}

}  // namespace

std::vector<NumericCase> meshCases() {
  const SurfaceMesh block = makeCuboid({-0.3, -0.4, -0.25}, {0.3, 0.4, 0.25});
  const SurfaceMesh comb = makeComb(3);
  const SurfaceMesh hook = makeHook();
  std::vector<NumericCase> cases;
  const auto add = [&](const std::string& name, const SurfaceMesh& a, const SurfaceMesh& b,
                       const GivenPose& pose, std::optional<double> closed_form = std::nullopt) {
    cases.push_back({name, a, b, pose, Relation::Apart, closed_form});
  };

  // Aspect 1e8: a needle, a cap (its apex within 1e-8 of the longest edge), and thin bodies made of them.
  const SurfaceMesh needle = makeSurface({{0, 0, 0}, {1, 0, 0}, {1, 1e-8, 0}}, {{0, 1, 2}});
  const SurfaceMesh cap = makeSurface({{0, 0, 0}, {1, 0, 0}, {0.4, 1e-8, 0}}, {{0, 1, 2}});
  const SurfaceMesh spike = makeSurface({{0, 0, 0}, {1e-8, 0, 1}, {0, 1e-8, 1}, {-1e-8, -1e-8, 1}},
                                        {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
  add("NeedleOverNeedle", needle, needle, askew(0.2, 0.3, 0.4));
  add("NeedleAlongNeedle", needle, needle, at(0.3, 2e-8, 1e-9));
  add("CapOverCap", cap, cap, askew(-0.1, 0.2, 1e-6));
  add("CapUnderApex", cap, cap, at(0.0, 2e-8, 0.0));
  add("NeedleOverABlock", block, needle, at(-0.5, 0.1, 0.25 + 1e-9), 1e-9);
  add("SpikeOverABlock", block, spike, askew(0.1, 0.1, 1.25));
  add("SpikeBesideASpike", spike, spike, askew(0.3, 1e-7, 0.1));
  add("SpikeTipToSpikeTip", spike, spike, givenPose(Quaterniond(0, 1, 0, 0), {1e-8, 0, -1e-7}));
  add("FlatSheetOfCaps", makeCuboid({-1, -1, -1e-8}, {1, 1, 0}), makeCuboid({-1, -1, 0}, {1, 1, 1e-8}),
      askew(0, 0, 1.5));
  add("FlatSheetsInParallel", makeCuboid({-1, -1, -1e-8}, {1, 1, 0}), makeCuboid({-1, -1, 0}, {1, 1, 1e-8}),
      at(0.3, 0.2, 1e-8), 1e-8);
  add("FanOfNeedles", makeNeedleFan(20, 1e-8), comb, askew(0.5, 1.6, 0.1));
  add("FanOverFan", makeNeedleFan(20, 1e-8), makeNeedleFan(20, 1e-8), at(1e-7, 1.0 + 1e-9, 1e-8));

  // Files are full of these; each is taken as it is and repaired.
  for (const bool repair : {false, true}) {
    const std::string suffix = repair ? "Repaired" : "AsIs";
    const auto taken = [&](const SurfaceMesh& mesh) { return repair ? repaired(mesh) : mesh; };
    add("ZeroAreaTriangles" + suffix, taken(withZeroAreaTriangles(comb, repair)),
        taken(withZeroAreaTriangles(hook, repair)), askew(0.2, 0.9, 0.3));
    add("ZeroAreaTrianglesFaceToFace" + suffix, taken(withZeroAreaTriangles(block, repair)),
        taken(withZeroAreaTriangles(block, repair)), at(0.1, 0.1, 0.5 + 1e-6), (0.5 + 1e-6) - 0.5);
    add("UnweldedVertices" + suffix, taken(makeUnwelded(comb)), taken(makeUnwelded(hook)),
        askew(0.2, 0.9, 0.3));
    add("UnweldedVerticesFaceToFace" + suffix, taken(makeUnwelded(block)), taken(makeUnwelded(block)),
        at(0.1, 0.1, 0.5 + 1e-6), (0.5 + 1e-6) - 0.5);
    add("MixedWinding" + suffix, taken(withMixedWinding(comb)), taken(withMixedWinding(hook)),
        askew(0.2, 0.9, 0.3));
    add("TwiceEveryTriangle" + suffix, taken(makeJoined(comb, comb)), taken(makeJoined(hook, hook)),
        askew(0.2, 0.9, 0.3));
  }
  add("TurnedWinding", repaired(makeTurned(comb)), repaired(makeTurned(hook)), askew(0.2, 0.9, 0.3));
  add("WithAHole", makeOpened(comb, 5), makeOpened(hook, 7), askew(0.2, 0.9, 0.3));
  add("WithAHoleOpposite", makeOpened(block, 2), block, at(0.05, 0.05, 0.75));
  add("ThroughAHole", makeOpened(makeOpened(block, 3), 2),
      makeCuboid({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}),
      at(0.02, 0.01, 0.1));  // inside, but the block is open: no solid to be swallowed by
  add("SeveralShells", makeJoined(hook, block, {2.0, 0.3, 0.1}), makeJoined(comb, block, {-1.5, 0.2, 0.4}),
      askew(0.6, 1.9, 0.3));
  add("OneTriangle", makeSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}),
      makeSurface({{0, 0, 0}, {0, 1, 0}, {1, 0, 0.5}}, {{0, 1, 2}}), askew(0.3, 0.2, 0.7));
  add("OneTriangleOverAComb", comb, makeSurface({{0, 0, 0}, {0.1, 0, 0}, {0, 0.05, 0}}, {{0, 1, 2}}),
      askew(0.17, 0.2, 0.0));

  // Denormal numbers where others would write 0, and gaps of that size.
  const double tiny = 5e-324;
  add("DenormalCorners",
      makeSurface({{tiny, -tiny, 0}, {1, tiny, -tiny}, {3 * tiny, 1, 2e-310}}, {{0, 1, 2}}),
      makeSurface({{0, tiny, 0}, {1, -tiny, tiny}, {tiny, 1, -2e-310}}, {{0, 1, 2}}), at(tiny, -tiny, 0.5),
      0.5);
  add("DenormalGap", block, block, at(0.0, tiny, 0.5 + 1e-3), (0.5 + 1e-3) - 0.5);
  cases.push_back({"DenormalPenetration", block, block, at(tiny, tiny, tiny), Relation::Meeting, 0.0});
  return cases;
}

}  // namespace concave_distance::test
