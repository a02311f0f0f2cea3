#pragma once

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::benchmark {

/// Seconds of CGAL's corefinement, the fastest of a few runs: with inexact constructions (doubles and exact
/// predicates), and exact; -1 where it gives up.
/// @param b_in_a in A's frame
double cgalFastOverlapTime(const SurfaceMesh& a, const SurfaceMesh& b_in_a);
double cgalExactOverlapTime(const SurfaceMesh& a, const SurfaceMesh& b_in_a);

}  // namespace concave_distance::benchmark
