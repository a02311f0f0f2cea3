#include "surface_walk.h"

#include <algorithm>

#include "mesh/surface/mesh_topology.h"

namespace concave_distance {
namespace {

// Twice the area over the product of two edges, squared: below, the corners' regions are separated by
// differences that cancel, and the kernel that measures every edge takes over.
constexpr double kThinnestSquared = 1e-12;

// Closest point by the regions of the corners, edges and the face (Ericson 2005, sec. 5.1.5): a third of the
// work of pointTriangleDistance. Relative error of the point about eps / sqrt(kThinnestSquared) = 2e-10 of
// the triangle at worst: a walk only needs to come nearer, and what it leads to is refined afterwards.
PointTriangleDistance closestByRegions(const Eigen::Vector3d& p, const TrianglePoints& t) {
  const Eigen::Vector3d ab = t[1] - t[0];
  const Eigen::Vector3d ac = t[2] - t[0];
  const double ab_ab = ab.squaredNorm();
  const double ac_ac = ac.squaredNorm();
  const double ab_ac = ab.dot(ac);
  const double area = ab_ab * ac_ac - ab_ac * ab_ac;
  if (!(area > kThinnestSquared * ab_ab * ac_ac)) {
    return pointTriangleDistance(p, t);
  }
  const auto at = [&](const Eigen::Vector3d& point, Feature feature) {
    return PointTriangleDistance{(point - p).squaredNorm(), point, feature};
  };
  const Eigen::Vector3d ap = p - t[0];
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) {
    return at(t[0], Feature::Vertex0);
  }
  const double d3 = d1 - ab_ab;
  const double d4 = d2 - ab_ac;
  if (d3 >= 0.0 && d4 <= d3) {
    return at(t[1], Feature::Vertex1);
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    return at(t[0] + (d1 / ab_ab) * ab, Feature::Edge0);
  }
  const double d5 = d1 - ab_ac;
  const double d6 = d2 - ac_ac;
  if (d6 >= 0.0 && d5 <= d6) {
    return at(t[2], Feature::Vertex2);
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    return at(t[0] + (d2 / ac_ac) * ac, Feature::Edge2);
  }
  const double va = d3 * d6 - d5 * d4;
  const double along = d4 - d3;
  const double back = d5 - d6;
  if (va <= 0.0 && along >= 0.0 && back >= 0.0) {
    return at(t[1] + (along / (along + back)) * (t[2] - t[1]), Feature::Edge1);
  }
  const double inverse = 1.0 / (va + vb + vc);
  return at(t[0] + (vb * inverse) * ab + (vc * inverse) * ac, Feature::Face);
}

bool isVertex(Feature feature) {
  return feature <= Feature::Vertex2;
}

}  // namespace

SurfacePoint walkTowards(const BodyMesh& body, TriangleIndex start, const Eigen::Vector3d& target) {
  const SurfaceMesh& surface = body.surface();
  const MeshTopology& topology = body.topology();
  const auto closest_on = [&](TriangleIndex triangle) {
    const PointTriangleDistance d = closestByRegions(target, trianglePoints(surface, triangle));
    return SurfacePoint{triangle, d.feature, d.point, d.squared_distance};
  };
  SurfacePoint best = closest_on(start);
  for (bool moved = true; moved && best.feature != Feature::Face;) {
    moved = false;
    const SurfacePoint from = best;
    const Eigen::Vector3d displacement = target - from.point;
    // Within rounding of sideways nothing is to be gained.
    const double on_the_spot = 1e-15 * (displacement.squaredNorm() + from.point.squaredNorm());
    // A triangle that holds the point has a closer one only if one of its corners lies ahead.
    const auto try_triangle = [&](TriangleIndex triangle) {
      const TriangleNodes& nodes = surface.triangle(triangle);
      const bool ahead = std::any_of(nodes.begin(), nodes.end(), [&](NodeIndex node) {
        return displacement.dot(surface.vertex(node) - from.point) > -on_the_spot;
      });
      if (!ahead) {
        return;
      }
      const SurfacePoint candidate = closest_on(triangle);
      if (candidate.squared_distance < best.squared_distance) {
        best = candidate;
        moved = true;
      }
    };
    if (isVertex(from.feature)) {
      const NodeIndex vertex = surface.triangle(from.triangle)[static_cast<std::size_t>(from.feature)];
      for (const TriangleIndex triangle : topology.triangles_of_vertex.row(vertex.value)) {
        try_triangle(triangle);
      }
    } else {
      const auto edge = static_cast<std::size_t>(from.feature) - static_cast<std::size_t>(Feature::Edge0);
      const TriangleIndex across = topology.triangle_across_edge[from.triangle.value][edge];
      if (across != kNoTriangle) {
        try_triangle(across);
      }
    }
  }
  return best;
}

}  // namespace concave_distance
