#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "support/body_pairs.h"

namespace concave_distance::test {

inline Interference overlapOf(const std::shared_ptr<const BodyMesh>& a,
                              const std::shared_ptr<const BodyMesh>& b, const Eigen::Isometry3d& pose) {
  InterferenceWorkspace workspace;
  Interference result;
  findInterference(*a, *b, pose, workspace, result);
  return result;
}

/// Upper face at z = 0.
inline const std::shared_ptr<const BodyMesh>& block() {
  static const std::shared_ptr<const BodyMesh> kBlock = [] {
    const SurfaceMesh box = makeBox({4.0, 4.0, 4.0});
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : box.vertices())
      vertices.push_back(vertex - Eigen::Vector3d(0.3, 0.1, 2.0));
    return makeBody(SurfaceMesh(vertices, box.triangles(), "block"));
  }();
  return kBlock;
}

/// Integral of a power of the depth over the samples.
inline double sumOf(const Interference& result, const InterferenceRegion& region, int power) {
  double sum = 0.0;
  for (std::uint32_t s = 0; s < region.sample_count; ++s) {
    const OverlapSample& sample = result.samples[region.first_sample + s];
    sum += sample.area * std::pow(sample.depth, power);
  }
  return sum;
}

}  // namespace concave_distance::test
