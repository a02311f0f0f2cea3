#pragma once

#include <string>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/surface_mesh.h"
#include "support/given_pose.h"

namespace concave_distance::test {

/// Two surfaces as distance_query has them after import (single precision, repaired), and a pose.
struct DifferentialScene {
  std::string description;
  SurfaceMesh a;
  SurfaceMesh b;
  GivenPose b_in_a;
};

/// Draws shapes (concave, round, random outlines, loose triangles, slivers), sizes from 1e-4 to 1e4, and
/// poses: anywhere, axes aligned on a lattice, and led to a gap from 1e-12 of the size on.
DifferentialScene drawScene(RandomEngine& engine);

}  // namespace concave_distance::test
