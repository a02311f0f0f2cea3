#include "fuzz/differential_scenes.h"

#include <cmath>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"
#include "support/random_solids.h"

namespace concave_distance::test {
namespace {

using Eigen::Vector3d;

SurfaceMesh looseTriangles(RandomEngine& engine) {
  std::vector<TrianglePoints> triangles;
  const std::uint32_t count = 1 + uniformIndex(engine, 20);
  for (std::uint32_t t = 0; t < count; ++t) {
    triangles.push_back(uniformIndex(engine, 2) == 0
                            ? randomTriangle(engine)
                            : moved(flatTriangle(engine, powerOfTen(engine, -5.0, 0.0)),
                                    randomRotation(engine), uniformInCube(engine, 1.0)));
  }
  return surfaceOf(triangles);
}

SurfaceMesh randomShape(RandomEngine& engine, std::string& description) {
  switch (uniformIndex(engine, 6)) {
    case 0:
      description += "concave ";
      return concaveShape(uniformIndex(engine, 6));
    case 1:
      description += "extrusion ";
      return spikyPrism(engine);
    case 2:
      description += "loose ";
      return looseTriangles(engine);
    case 3: {
      description += "box ";
      const Vector3d size(powerOfTen(engine, -3, 0), powerOfTen(engine, -3, 0), 1.0);
      return makeBox(size);
    }
    case 4:
      description += "sphere ";
      return makeSphere(uniformIn(engine, 0.2, 1.0), powerOfTen(engine, -2.0, -1.0));
    default:
      description += "cylinder ";
      return makeCylinder(uniformIn(engine, 0.05, 1.0), uniformIn(engine, 0.1, 2.0),
                          powerOfTen(engine, -2.0, -1.0));
  }
}

/// To single precision and back, one number at a time: gcc 12 leaves the rounding out of Eigen's two casts in
/// a row at -O3.
double inSinglePrecision(double value) {
  const volatile auto rounded = static_cast<float>(value);
  return rounded;
}

/// As an STL file would bring it: scaled, in single precision, repaired.
SurfaceMesh asImported(const SurfaceMesh& mesh, double scale) {
  TriangleSoup soup;
  for (const Vector3d& v : mesh.vertices()) {
    soup.vertices.emplace_back(scale * v);
    soup.vertices.back() =
        soup.vertices.back().unaryExpr([](double value) { return inSinglePrecision(value); });
  }
  for (const TriangleNodes& t : mesh.triangles())
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  return repairMesh(soup, {}, "drawn").mesh;
}

/// B led along the shortest way until a gap of about `gap` is left.
void leadToGap(DifferentialScene& scene, double gap) {
  const auto a = makeBody(scene.a);
  const auto b = makeBody(scene.b);
  for (int step = 0; step < 3; ++step) {
    const WitnessPair closest = test::enumerateTrianglePairs(*a, *b, scene.b_in_a.isometry());
    const double distance = std::sqrt(closest.squared_distance);
    if (distance == 0.0) return;
    scene.b_in_a.translation -= (1.0 - gap / distance) * (closest.point_b_in_a - closest.point_a_in_a);
  }
}

}  // namespace

DifferentialScene drawScene(RandomEngine& engine) {
  DifferentialScene scene;
  const double scale = uniformIndex(engine, 2) == 0 ? 1.0 : powerOfTen(engine, -4.0, 4.0);
  const double ratio = uniformIndex(engine, 2) == 0 ? 1.0 : powerOfTen(engine, -3.0, 0.0);
  scene.a = asImported(randomShape(engine, scene.description), scale);
  scene.b = asImported(randomShape(engine, scene.description), scale * ratio);
  const double reach = scene.a.diameter() + scene.b.diameter();
  const std::uint32_t kind = uniformIndex(engine, 4);
  if (kind == 0) {  // axes aligned, on a lattice: everything degenerate that can be
    const Eigen::Quaterniond turns[] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1},
                                        {1, 1, 0, 0}, {1, 0, 0, 1}, {1, 1, 1, 1}};
    const auto cell = [&] { return scale * 0.05 * (static_cast<double>(uniformIndex(engine, 41)) - 20.0); };
    const double x = cell();
    const double y = cell();
    scene.b_in_a = givenPose(turns[uniformIndex(engine, 6)].normalized(), {x, y, cell()});
    scene.description += "lattice";
    return scene;
  }
  const Vector3d place = uniformInCube(engine, (kind == 1 ? 1.0 : 0.6) * reach);
  scene.b_in_a = givenPose(Eigen::Quaterniond(randomRotation(engine)), place);
  scene.description += kind == 1 ? "anywhere" : "near";
  if (kind > 1) leadToGap(scene, powerOfTen(engine, -12.0, -1.0) * reach);
  return scene;
}

}  // namespace concave_distance::test
