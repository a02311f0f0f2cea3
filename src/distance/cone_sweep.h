#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

namespace detail {
struct FarPieceBuffers;
}

/// A triangle pair whose closest points are a local minimum of the distance over both surfaces.
struct MinimumSeed {
  TriangleIndex a;
  TriangleIndex b;
  double distance;  ///< metres
};

/// Looks through the normal cones of two bodies for local minima (doc/algorithm.md, section 7) in portions:
/// each call goes on where the last one has ended, at the pose of its own, and begins anew after the end.
/// Over a motion every part is looked at once in a while; what lives for as long is found.
class ConeSweep {
 public:
  ConeSweep();
  ~ConeSweep();
  ConeSweep(ConeSweep&&) noexcept;
  ConeSweep& operator=(ConeSweep&&) noexcept;

  /// Appends triangle pairs that hold local minima above 0 and up to `cutoff` (metres), some more than once.
  /// @param budget groups of four cones to compare
  /// @param least_prominence when the bodies are so far apart that each pair of pieces has one niche with it,
  ///        these are found without comparing cones; 0: never
  /// @param limit may end a call early; the next one continues there
  /// @return pairs of features whose distance was computed
  std::uint64_t advance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                        NormalSides sides, double cutoff, std::size_t budget, std::vector<MinimumSeed>& found,
                        double least_prominence = 0.0, WorkLimit* limit = nullptr);
  /// The next call begins anew.
  void restart() { open_.clear(); }
  /// Whether the last call has come to the end.
  bool finished() const { return open_.empty(); }
  std::size_t memoryBytes() const { return open_.capacity() * sizeof(open_[0]); }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open_;  ///< children of both trees
  std::unique_ptr<detail::FarPieceBuffers> far_;               ///< made when first needed
};

}  // namespace concave_distance
