#include "fuzz/overlap_family.h"

#include "fuzz/niche_shapes.h"
#include "support/body_pairs.h"
#include "support/random_solids.h"

namespace concave_distance::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d sizesIn(RandomEngine& engine, double low, double high) {
  return {uniformIn(engine, low, high), uniformIn(engine, low, high), uniformIn(engine, low, high)};
}

/// A plate with a rib, about 2 m wide.
SurfaceMesh ribbedPlate(RandomEngine& engine) {
  const double thickness = uniformIn(engine, 0.03, 0.15);
  const double rib = uniformIn(engine, -0.8, 0.6);
  return makeExtrusion({{-1.0, 0.0},
                        {1.0, 0.0},
                        {1.0, thickness},
                        {rib + 0.1, thickness},
                        {rib + 0.1, 0.3},
                        {rib, 0.3},
                        {rib, thickness},
                        {-1.0, thickness}},
                       uniformIn(engine, 1.0, 2.0));
}

/// What is pushed through a plate: one, two or several legs.
SurfaceMesh legs(RandomEngine& engine) {
  switch (uniformIndex(engine, 4)) {
    case 0:
      return makeLShape(1.0, uniformIn(engine, 0.05, 0.2), uniformIn(engine, 0.05, 0.2));
    case 1:
      return makeHook(0.9, uniformIn(engine, 0.3, 0.9));
    case 2:
      return makeComb(2 + static_cast<int>(uniformIndex(engine, 3)));
    default:
      return randomRing(engine);
  }
}

SurfaceMesh hollowBox(RandomEngine& engine) {
  const Vector3d outer = sizesIn(engine, 0.4, 0.6);
  const Vector3d inner = outer.cwiseProduct(sizesIn(engine, 0.3, 0.8));
  return makeJoined(makeCuboid(-outer, outer), makeTurned(makeCuboid(-inner, inner)), Vector3d::Zero());
}

/// A body beside a small one, of which the other body may hold either.
SurfaceMesh withAnotherShell(RandomEngine& engine, const SurfaceMesh& body) {
  const Vector3d size = sizesIn(engine, 0.02, 0.1);
  const Vector3d beyond = body.boundingBox().max() + size + Vector3d::Constant(uniformIn(engine, 0.01, 0.3));
  return makeJoined(body, makeCuboid(-size, size), beyond);
}

SurfaceMesh anyShape(RandomEngine& engine) {
  switch (uniformIndex(engine, 7)) {
    case 0:
      return hollowBox(engine);
    case 1:
      return withAnotherShell(engine, legs(engine));
    case 2:
      return makeSheet(3, 3, 0.4, uniformIn(engine, 0.0, 0.3));
    case 3:
      return ribbedPlate(engine);
    case 4:
      return makeCuboid(-sizesIn(engine, 0.2, 0.7), sizesIn(engine, 0.2, 0.7));
    default:
      return legs(engine);
  }
}

}  // namespace

NicheScene drawOverlappingPair(RandomEngine& engine) {
  const bool is_union = uniformIndex(engine, 4) == 0;
  const bool is_plate = !is_union && uniformIndex(engine, 3) == 0;
  NicheScene scene{is_union   ? unionOfConvexSolids(engine)
                   : is_plate ? ribbedPlate(engine)
                              : anyShape(engine),
                   is_union && uniformIndex(engine, 2) == 0 ? unionOfConvexSolids(engine)
                   : is_plate                               ? legs(engine)
                                                            : anyShape(engine),
                   {Isometry3d::Identity()}};
  scene.shells_cross = is_union;
  Isometry3d& pose = scene.poses.front();
  pose.linear() = randomRotation(engine);
  const double reach = uniformIn(engine, 0.0, 0.5) * scene.b.diameter();
  pose.translation() = scene.a.boundingBox().center() - pose.linear() * scene.b.boundingBox().center() +
                       reach * randomRotation(engine).col(0);
  return scene;
}

}  // namespace concave_distance::test
