#include "grid_size.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/triangle_measures.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

// Nodes that the automatic grid aims at when the mesh itself has fewer.
constexpr double kTargetNodeCount = 650.0;
// Nodes along the diameter, at most: edges are divided too, and a needle has next to no area.
constexpr double kMostNodesAlong = kTargetNodeCount / 4.0;

// makeSearchGrid makes 1.3 to 1.5 nodes per squared edge length of area.
constexpr double kNodesPerSquaredEdge = 1.5;

double areaOf(const SurfaceMesh& surface) {
  double area = 0.0;
  for (const TriangleNodes& t : surface.triangles()) {
    area += triangleArea(surface.vertex(t[0]), surface.vertex(t[1]), surface.vertex(t[2]));
  }
  return area;
}

}  // namespace

void checkEdgeLength(const SurfaceMesh& surface, const std::optional<double>& max_edge_length,
                     const std::string& where) {
  if (max_edge_length && (!(*max_edge_length > 0.0) || !std::isfinite(*max_edge_length))) {
    throw Error(where, "max_edge_length is " + numberText(*max_edge_length),
                "give a positive, finite length in metres or leave it out");
  }
  for (const TriangleNodes& t : surface.triangles()) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      throw Error(where, "a triangle has the same corner twice", "repair the mesh first");
    }
  }
}

double estimatedNodeCount(const SurfaceMesh& surface, double max_edge_length) {
  double along_edges = 0.0;
  for (const TriangleNodes& t : surface.triangles()) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double length = (surface.vertex(t[corner]) - surface.vertex(t[(corner + 1) % 3])).norm();
      along_edges += 0.5 * std::floor(length / max_edge_length);  // every edge has two triangles
    }
  }
  return static_cast<double>(surface.vertexCount()) + along_edges +
         kNodesPerSquaredEdge * areaOf(surface) / (max_edge_length * max_edge_length);
}

double automaticEdgeLength(const SurfaceMesh& surface) {
  const double area = areaOf(surface);
  // The second term keeps the edges of a long, thin body from being longer than it is thick.
  const double length =
      std::min(std::sqrt(kNodesPerSquaredEdge * area / kTargetNodeCount), surface.diameter() / 8.0);
  return std::max(length, surface.diameter() / kMostNodesAlong);
}

}  // namespace concave_distance
