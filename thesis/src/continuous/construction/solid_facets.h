#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace concave_distance {

/// One plane facet of a solid: outward unit normal, points of its plane satisfy normal . p = offset (metres).
struct SolidFacet {
  Eigen::Vector3d normal;
  double offset;
  /// Border and holes, each closed, counter-clockwise about the normal (holes clockwise).
  std::vector<std::vector<std::uint32_t>> loops;
};

/// The boundary of a solid, rounded to doubles; facets that lie in one plane are one. Body frame, metres.
struct SolidFacets {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<SolidFacet> facets;
};

/// Area vector of a facet: its normal times its area, square metres.
Eigen::Vector3d areaVector(const SolidFacets& solid, const SolidFacet& facet);

/// Cubic metres, by the divergence theorem.
double volumeOf(const SolidFacets& solid);

/// The smallest extent of the vertices along a facet's normal: an upper bound of the solid's width, metres.
double thicknessOf(const SolidFacets& solid);

/// Whether every facet that is wider than `tolerance` (metres) has all vertices behind it, to the same
/// tolerance.
bool isConvex(const SolidFacets& solid, double tolerance);

}  // namespace concave_distance
