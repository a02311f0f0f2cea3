#pragma once

#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/pair_frame.h"
#include "distance/niches/local_minima.h"

namespace concave_distance::evaluation {

/// A pair of points of two surfaces.
struct FoundPlace {
  TriangleIndex triangle_a;  ///< original triangles that the points lie on
  TriangleIndex triangle_b;
  double distance = 0.0;  ///< of the points, metres
};

/// Whose region of the surfaces a pair of points lies in. The pair x belongs to local minimum m when m can be
/// reached from x on the surfaces without the distance ever rising above d(x), and no other minimum can: the
/// connected part of {d <= d(x)} around x holds m alone. A pair that reaches several lies above the pass
/// between them and belongs to none; neither the size of the triangles nor a way of descending decides.
/// How: on a product of two triangles the distance is convex, so the connected parts of {d <= d(x)} are
/// those of the graph of triangle pairs (distance/niches/basin_search.h), whichever triangles of x are named.
class SurfaceRegions {
 public:
  static constexpr std::size_t kNoOwner = std::numeric_limits<std::size_t>::max();
  /// @param minima all there are, those through material included; the bodies must outlive the regions
  SurfaceRegions(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const std::vector<LocalMinimum>& minima);

  /// The number of the minimum, or kNoOwner. O(triangle pairs below the place's distance)
  std::size_t ownerOf(const FoundPlace& place) const;

 private:
  detail::PairFrame scene_;
  std::unordered_multimap<std::uint64_t, std::size_t> minima_of_facet_pair_;
};

}  // namespace concave_distance::evaluation
