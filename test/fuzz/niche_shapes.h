#pragma once

#include <Eigen/Core>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

/// Shapes of niche_hunt's families. Metres; about one metre across unless said otherwise.
namespace concave_distance::test {

/// One of the 24 rotations that map the axes on each other, exactly.
Eigen::Matrix3d quarterTurn(RandomEngine& engine);
SurfaceMesh quarterTurned(RandomEngine& engine, const SurfaceMesh& mesh);

/// A box, an L, stairs or a comb with sizes on a lattice of 1/8 m, or of any.
SurfaceMesh plainShape(RandomEngine& engine);
/// One to four closed spikes; the apex of each stands over a face, 1e-14 to 1e-3 beside an edge of it.
SurfaceMesh spikesOver(RandomEngine& engine, const SurfaceMesh& mesh);
/// A prism over towers of whole numbers, several metres.
SurfaceMesh skyline(RandomEngine& engine);
/// Two to six triangles with corners at whole numbers.
SurfaceMesh latticeSoup(RandomEngine& engine);
/// Loose triangles: of any shape, or as thin as 1e-8 of their length.
SurfaceMesh randomSoup(RandomEngine& engine);
SurfaceMesh needleSoup(RandomEngine& engine);
/// A prism over a star whose points may be very thin.
/// A box with a corner of one triangle on an edge of another, with a flap, or with a second box against it.
SurfaceMesh selfTouchingShape(RandomEngine& engine);
/// A box, or a polyhedron with corners on an ellipsoid. Some of its corners are moved out or in by 1e-15 to
/// 0.3 of its size, or none.
SurfaceMesh nearlyConvexShape(RandomEngine& engine);
/// Two to four solids apart from each other, a solid in a hollow, or a solid within a solid.
SurfaceMesh severalShells(RandomEngine& engine);
/// Two to four boxes or convex polyhedra that cross each other: on a lattice, a little beside it, or anyhow.
SurfaceMesh unionOfConvexSolids(RandomEngine& engine);
/// Cells of a small grid, many of which touch at an edge or a corner only; not repaired.
SurfaceMesh voxelUnion(RandomEngine& engine);

}  // namespace concave_distance::test
