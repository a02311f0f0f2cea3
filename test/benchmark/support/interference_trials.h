#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

#include "concave_distance/interference/interference.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::benchmark {

/// Two solids and the pose of B in A's frame.
struct InterferencePair {
  SurfaceMesh a;
  SurfaceMesh b;
  Eigen::Isometry3d a_from_b;
  double size() const { return std::max(a.diameter(), b.diameter()); }
};

/// Concave solids at random poses (test/support/random_solids.h).
InterferencePair randomInterferencePair(std::uint64_t seed);
/// Prisms with corners on a lattice, turned by right angles: flush faces, common edges and corners
/// everywhere. Exact in doubles.
InterferencePair latticeInterferencePair(std::uint64_t seed);

/// Differences in units of what is allowed: 1e-9 of the value or 1e-12 L^k, whichever is larger.
struct InterferenceErrors {
  std::size_t pairs = 0;       ///< that overlap by the reference
  std::size_t regions = 0;     ///< in all, by the reference
  std::size_t several = 0;     ///< pairs with more than one
  std::size_t miscounted = 0;  ///< pairs with another number of regions
  std::size_t unknown = 0;     ///< pairs that the reference gives up
  double volume = 0.0;         ///< worst of a region
  double area = 0.0;           ///< worst of both surfaces inside, summed over the pair's regions
  double depth = 0.0;  ///< worst of a region's depth, against 1e-9 L; where it is defined by no fallback
  std::uint64_t worst_seed = 0;  ///< of the volume, or of the last miscount
};

/// Against CGAL's Booleans. Where faces are flush only the sum of both areas says the same; where the numbers
/// of regions differ only the sum of the volumes does.
void compareWithCgal(const InterferencePair& pair, const Interference& found, bool flush, std::uint64_t seed,
                     InterferenceErrors& errors);
/// Two answers, the second with the sides exchanged or not, and lengths divided by `factor`.
void compareAnswers(const InterferencePair& pair, const Interference& one, const Interference& other,
                    bool swapped, bool flush, double factor, std::uint64_t seed, InterferenceErrors& errors);

}  // namespace concave_distance::benchmark
