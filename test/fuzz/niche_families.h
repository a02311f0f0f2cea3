#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::test {

/// Two surfaces as they are after import, and poses of B in A's frame along which the pair is tracked.
struct NicheScene {
  SurfaceMesh a;
  SurfaceMesh b;
  std::vector<Eigen::Isometry3d> poses;
  /// Shells of one body cross. Of triangles that cross, the enumeration knows what lies inside, too: what is
  /// hidden is not compared, and places where bodies meet only where the enumeration sees them.
  bool shells_cross = false;
};

struct NicheFamily {
  const char* name;
  const char* description;
  NicheScene (*draw)(RandomEngine&);
};

const std::vector<NicheFamily>& nicheFamilies();
/// @throws Error when no family has this name
const NicheFamily& nicheFamily(const std::string& name);

}  // namespace concave_distance::test
