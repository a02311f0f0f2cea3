#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <map>

#include "concave_distance/base/error.h"
#include "exact_solid.h"

namespace concave_distance::detail {
namespace {

using Triangles = std::vector<std::vector<std::size_t>>;

std::vector<ExactPoint> cornersOf(const SurfaceMesh& mesh, const std::vector<TriangleIndex>& triangles,
                                  Triangles& indexed) {
  std::map<NodeIndex, std::size_t> number;
  std::vector<ExactPoint> points;
  for (const TriangleIndex triangle : triangles) {
    std::vector<std::size_t> corners;
    for (const NodeIndex node : mesh.triangle(triangle)) {
      const auto entry = number.emplace(node, points.size());
      if (entry.second) {
        const Eigen::Vector3d& v = mesh.vertex(node);
        points.emplace_back(v.x(), v.y(), v.z());
      }
      corners.push_back(entry.first->second);
    }
    indexed.push_back(std::move(corners));
  }
  return points;
}

}  // namespace

ExactPolyhedron exactShell(const SurfaceMesh& mesh, const std::vector<TriangleIndex>& triangles,
                           const std::string& where) {
  namespace processing = CGAL::Polygon_mesh_processing;
  Triangles indexed;
  std::vector<ExactPoint> points = cornersOf(mesh, triangles, indexed);
  // Where solids touch along an edge or in a corner, what touches is given corners of its own.
  const std::size_t corners = points.size();
  processing::orient_polygon_soup(points, indexed);
  if (!processing::is_polygon_soup_a_polygon_mesh(indexed)) {
    throw Error(where, "the surface is not the boundary of a solid", "see mesh_tool inspect, and repair it");
  }
  ExactPolyhedron polyhedron;
  processing::polygon_soup_to_polygon_mesh(points, indexed, polyhedron);
  if (!polyhedron.is_closed()) {
    throw Error(where, "the surface is not closed", "see mesh_tool inspect, and repair it");
  }
  // Corners that were doubled lie on each other: no crossing, but it would be taken for one.
  if (points.size() == corners && processing::does_self_intersect(polyhedron)) {
    throw Error(where, "the surface crosses itself", "mend the mesh where triangles pass through each other");
  }
  return polyhedron;
}

}  // namespace concave_distance::detail
