#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "concave_distance/base/indices.h"
#include "concave_distance/distance/witness.h"

namespace concave_distance {

/// A triangle pair whose closest points are a local minimum of the distance over both surfaces.
struct MinimumCandidate {
  TriangleIndex a;
  TriangleIndex b;
  double distance = 0.0;     ///< metres
  bool is_measured = false;  ///< true when the following members are known
  /// True when no other pair of points near is as close; false where that is not seen at once.
  bool is_point = false;
  Feature feature_a = Feature::Face;
  Feature feature_b = Feature::Face;
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();  ///< in the pair's frame (PairFrame)
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  static constexpr std::uint32_t kNoPart = 0xffffffffU;
  std::uint32_t part = kNoPart;  ///< of the bodies' overlap, for which it stands
};

/// Returns a candidate on two triangles whose points are not known.
inline MinimumCandidate candidateOn(TriangleIndex a, TriangleIndex b, double distance) {
  MinimumCandidate candidate;
  candidate.a = a;
  candidate.b = b;
  candidate.distance = distance;
  return candidate;
}

}  // namespace concave_distance
