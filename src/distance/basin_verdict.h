#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"
#include "witness_refinement.h"

namespace concave_distance {

namespace detail {
struct BasinBuffers;
}

/// A local minimum of the distance over both surfaces, on the triangle pair that holds it.
struct BasinSeed {
  TriangleIndex a;
  TriangleIndex b;
  double distance;          ///< metres
  double least_prominence;  ///< with less it belongs to a deeper minimum
  /// Whether it is to be judged. Others are known niches that floods may run into.
  bool judged;
  std::size_t largest_flood;  ///< triangle pairs that its flood looks at, at most
};

/// What became of a minimum: a root is a niche of the least prominence, as far as it was flooded.
struct Basin {
  TriangleIndex a;
  TriangleIndex b;
  double distance;
  double least_prominence;
  std::uint32_t owner;  ///< the deeper basin that it belongs to; itself for a root
  /// The lowest pass to the owner, metres; for a root infinite.
  double pass = std::numeric_limits<double>::infinity();
  double flooded = 0.0;    ///< metres: passes up to this were looked for
  bool undecided = false;  ///< the flood was cut short
  bool refused = false;    ///< the work limit was reached, perhaps before it began
};

/// Buffers and results of judgeBasins(), kept from call to call: once they are large enough nothing is
/// allocated.
class BasinVerdicts {
 public:
  BasinVerdicts();
  ~BasinVerdicts();
  BasinVerdicts(BasinVerdicts&&) noexcept;
  BasinVerdicts& operator=(BasinVerdicts&&) noexcept;

  /// Those of the seeds and those that floods have met besides.
  const std::vector<Basin>& basins() const;
  /// The basin that seed i started, or was found in.
  std::uint32_t basinOf(std::size_t seed) const;
  /// The niche that a basin belongs to in the end.
  std::uint32_t rootOf(std::uint32_t basin) const;
  std::uint64_t floodedPairs() const;  ///< triangle pairs, of the last call
  std::size_t memoryBytes() const;

  detail::BasinBuffers& buffers() { return *buffers_; }

 private:
  std::unique_ptr<detail::BasinBuffers> buffers_;
};

/// Which minima are niches of their own. The distance is convex on every product of two triangles, and two
/// of them with an edge of one body in common meet at the least distance over (edge x triangle): a graph
/// with the very basins and passes of the surfaces. Deeper seeds are flooded first, lowest levels first, each
/// up to (1 + least prominence) times its own distance: what a flood comes upon that is deeper, it belongs
/// to, and shallower seeds in its reach belong to it. A flood that comes upon a cell deeper than its own
/// start goes down from there; where that is no seed it is a new basin, judged like a seed. Exact up to the
/// error of the triangle kernel in coordinates of the bodies' size. Never throws.
/// Bodies so far apart that no pass can be prominent (doc/algorithm.md, section 7) are not flooded: the
/// deepest seed of each pair of connected pieces is the niche. Large floods without a limit are replaced by
/// straight paths.
/// @param limit ends floods: undecided seeds become roots that are `refused`; nullptr: none
void judgeBasins(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const std::vector<BasinSeed>& seeds, BasinVerdicts& verdicts, WorkLimit* limit = nullptr);

}  // namespace concave_distance
