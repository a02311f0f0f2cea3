#include "solid_facets.h"

#include <algorithm>
#include <limits>

namespace concave_distance {
namespace {

/// Twice the area over the perimeter: the width of a sliver.
double widthOf(const SolidFacets& solid, const SolidFacet& facet) {
  double perimeter = 0.0;
  for (const std::vector<std::uint32_t>& loop : facet.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      perimeter += (solid.vertices[loop[i]] - solid.vertices[loop[(i + 1) % loop.size()]]).norm();
    }
  }
  return perimeter > 0.0 ? 2.0 * areaVector(solid, facet).norm() / perimeter : 0.0;
}

}  // namespace

Eigen::Vector3d areaVector(const SolidFacets& solid, const SolidFacet& facet) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = solid.vertices[facet.loops.front().front()];
  for (const std::vector<std::uint32_t>& loop : facet.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      twice += (solid.vertices[loop[i]] - origin).cross(solid.vertices[loop[(i + 1) % loop.size()]] - origin);
    }
  }
  return 0.5 * twice;
}

double volumeOf(const SolidFacets& solid) {
  if (solid.vertices.empty()) {
    return 0.0;
  }
  const Eigen::Vector3d origin = solid.vertices.front();
  double volume = 0.0;
  for (const SolidFacet& facet : solid.facets) {
    volume += (solid.vertices[facet.loops.front().front()] - origin).dot(areaVector(solid, facet)) / 3.0;
  }
  return volume;
}

double thicknessOf(const SolidFacets& solid) {
  double thickness = std::numeric_limits<double>::infinity();
  for (const SolidFacet& facet : solid.facets) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Eigen::Vector3d& vertex : solid.vertices) {
      const double height = facet.normal.dot(vertex);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    thickness = std::min(thickness, high - low);
  }
  return thickness;
}

bool isConvex(const SolidFacets& solid, double tolerance) {
  return std::all_of(solid.facets.begin(), solid.facets.end(), [&](const SolidFacet& facet) {
    return std::all_of(solid.vertices.begin(), solid.vertices.end(),
                       [&](const Eigen::Vector3d& vertex) {
                         return facet.normal.dot(vertex) <= facet.offset + tolerance;
                       }) ||
           widthOf(solid, facet) <= tolerance;
  });
}

}  // namespace concave_distance
