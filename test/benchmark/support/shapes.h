#pragma once

#include "concave_distance/mesh/surface/surface_mesh.h"

/// Bodies of the benchmark scenes, closed and outward oriented, metres; beside test/support/concave_shapes.h.
namespace concave_distance::benchmark {

/// A tube about z, centred: the hole of a peg-in-hole pair.
SurfaceMesh makeTube(double outer_radius, double inner_radius, double length, int segments);

/// A torus about z with `open_share` of its ring left out (a hook), capped.
SurfaceMesh makeHook(double ring_radius, double wire_radius, double open_share, int ring_segments,
                     int wire_segments);

/// A slab with rows x columns pyramids of seeded heights on it, each a shell of its own: many niches.
SurfaceMesh makePyramidField(int rows, int columns, double pitch, unsigned seed);

/// A ring about z with bumps, of about so many triangles (a twentieth off at most): for how costs grow with
/// size.
SurfaceMesh makeBumpyRing(std::size_t triangles);

/// Pose of a second such ring that passes close by the first, t in [0, 1]: a tenth of a diameter in all.
Eigen::Isometry3d ringPassingBy(double t);

/// The surface moved.
SurfaceMesh moved(const SurfaceMesh& surface, const Eigen::Isometry3d& motion);

}  // namespace concave_distance::benchmark
