#include "concave_distance/mesh/repair/repair_mesh.h"

#include <algorithm>
#include <vector>

#include "base/constants.h"
#include "base/number_text.h"
#include "base/union_find.h"
#include "concave_distance/base/error.h"
#include "dissolve_flat_triangles.h"
#include "mesh/surface/edge_table.h"
#include "mesh/surface/resolve_shells.h"
#include "settle_faces.h"
#include "weld_vertices.h"

namespace concave_distance {
namespace {

/// Keeps the vertices that a triangle uses, in their order; returns how many were dropped.
std::size_t dropUnused(std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles) {
  std::vector<bool> used(vertices.size(), false);
  for (const TriangleNodes& nodes : triangles) {
    for (const NodeIndex node : nodes) {
      used[node.value] = true;
    }
  }
  std::vector<NodeIndex> renumbered(vertices.size());
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (used[v]) {
      renumbered[v] = NodeIndex{kept};
      vertices[kept++] = vertices[v];
    }
  }
  for (TriangleNodes& nodes : triangles) {
    for (NodeIndex& node : nodes) {
      node = renumbered[node.value];
    }
  }
  const std::size_t dropped = vertices.size() - kept;
  vertices.resize(kept);
  return dropped;
}

void checkSoup(const TriangleSoup& soup, const RepairOptions& options, const std::string& where) {
  if (!(options.weld_tolerance >= 0.0) || !(options.weld_tolerance < 1.0)) {
    TextStream seen;
    seen << "the weld tolerance is " << options.weld_tolerance;
    throw Error(where, seen.str(), "give a fraction of the size, from 0 to below 1");
  }
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    if (!soup.vertices[i].allFinite() || soup.vertices[i].cwiseAbs().maxCoeff() > kLargestCoordinate) {
      throw Error(where,
                  "vertex " + std::to_string(i) + " has a coordinate that is not finite or beyond 1e18 m",
                  "export the mesh again, or correct its scale");
    }
  }
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    for (const std::uint32_t vertex : soup.triangles[t]) {
      if (vertex >= soup.vertices.size()) {
        throw Error(where,
                    "triangle " + std::to_string(t) + " refers to vertex " + std::to_string(vertex) + " of " +
                        std::to_string(soup.vertices.size()),
                    "export the mesh again");
      }
    }
  }
}

std::vector<TriangleNodes> weldedTriangles(const TriangleSoup& soup, const detail::WeldedVertices& welded) {
  std::vector<TriangleNodes> triangles;
  triangles.reserve(soup.triangles.size());
  for (const auto& corners : soup.triangles) {
    triangles.push_back({welded.node_of_vertex[corners[0]], welded.node_of_vertex[corners[1]],
                         welded.node_of_vertex[corners[2]]});
  }
  return triangles;
}

double diagonal(const std::vector<Eigen::Vector3d>& vertices) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : vertices) {
    box.extend(vertex);
  }
  return box.diagonal().norm();
}

void dissolveFlat(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                  RepairReport& report) {
  const detail::DissolvedTriangles dissolved = detail::dissolveFlatTriangles(vertices, triangles);
  report.zero_area_triangles += dissolved.flat;
  report.split_triangles += dissolved.split;
}

void countShells(const std::vector<Eigen::Vector3d>& vertices, const std::vector<TriangleNodes>& triangles,
                 const detail::EdgeTable& edges, RepairReport& report) {
  const detail::ShellLabels labels = detail::labelShells(vertices, triangles, edges);
  report.shells = labels.shell_is_closed.size();
  report.closed_shells = static_cast<std::size_t>(
      std::count(labels.shell_is_closed.begin(), labels.shell_is_closed.end(), true));
}

/// Counts borders, edges of more than two triangles, and edges whose two triangles do not agree.
void countEdges(const std::vector<TriangleNodes>& triangles, const detail::EdgeTable& edges,
                RepairReport& report) {
  // A hole is a chain of border edges that follow one another around the same fans of triangles. Corners are
  // half-edge starts; the corners of one vertex that are joined by edges are one fan.
  UnionFind fans(3 * triangles.size());
  std::vector<detail::HalfEdge> border;
  const auto corner_at = [&](detail::HalfEdge h, NodeIndex node) {
    return detail::startOf(triangles, h) == node ? h : h - h % 3 + (h % 3 + 1) % 3;
  };
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const detail::HalfEdge first = edges.half_edges[edges.first[e]];
    const std::uint32_t uses = edges.first[e + 1] - edges.first[e];
    const NodeIndex a = detail::startOf(triangles, first);
    const NodeIndex b = detail::endOf(triangles, first);
    int balance = 1;
    for (std::uint32_t i = 1; i < uses; ++i) {
      const detail::HalfEdge other = edges.half_edges[edges.first[e] + i];
      balance += detail::startOf(triangles, other) == a ? 1 : -1;
      fans.unite(corner_at(first, a), corner_at(other, a));
      fans.unite(corner_at(first, b), corner_at(other, b));
    }
    if (uses == 1) border.push_back(first);
    report.non_manifold_edges += uses > 2 ? 1U : 0U;
    report.inconsistent_edges += uses == 2 && balance != 0 ? 1U : 0U;
  }
  report.border_edges = border.size();
  for (const detail::HalfEdge h : border) {
    fans.unite(corner_at(h, detail::startOf(triangles, h)), corner_at(h, detail::endOf(triangles, h)));
  }
  std::vector<std::uint32_t> loops;
  loops.reserve(border.size());
  for (const detail::HalfEdge h : border) loops.push_back(fans.find(h));
  std::sort(loops.begin(), loops.end());
  report.holes = static_cast<std::size_t>(std::unique(loops.begin(), loops.end()) - loops.begin());
}

}  // namespace

std::string RepairReport::summary() const {
  TextStream text;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count != 0) {
      text << (text.tellp() > 0 ? ", " : "") << count << ' ' << (count == 1 ? one : many);
    }
  };
  add(welded_vertices, "vertex welded", "vertices welded");
  add(unused_vertices, "unused vertex dropped", "unused vertices dropped");
  add(zero_area_triangles, "zero-area triangle dropped", "zero-area triangles dropped");
  add(split_triangles, "triangle split beside them", "triangles split beside them");
  add(duplicate_triangles, "duplicate triangle dropped", "duplicate triangles dropped");
  add(inner_wall_triangles, "triangle between touching solids dropped",
      "triangles between touching solids dropped");
  add(turned_triangles, "triangle turned", "triangles turned");
  add(shells > 1 ? shells : 0, "shell", "shells");
  add(shells - closed_shells, "open shell", "open shells");
  add(holes, "hole", "holes");
  add(border_edges, "border edge", "border edges");
  add(non_manifold_edges, "edge of more than two triangles", "edges of more than two triangles");
  add(inconsistent_edges, "edge with inconsistent winding", "edges with inconsistent winding");
  return text.str();
}

RepairedMesh repairMesh(const TriangleSoup& soup, const RepairOptions& options, const std::string& where) {
  checkSoup(soup, options, where);
  RepairReport report;
  report.vertices_in = soup.vertices.size();
  report.triangles_in = soup.triangles.size();

  detail::WeldedVertices welded = detail::weldVertices(soup.vertices, 0.0);
  std::vector<TriangleNodes> triangles = weldedTriangles(soup, welded);
  dissolveFlat(welded.vertices, triangles, report);
  std::size_t joined_vertices = 0;
  if (options.weld_tolerance > 0.0) {
    const double tolerance = options.weld_tolerance * diagonal(welded.vertices);
    const detail::BorderWeld joined = detail::weldBorders(welded.vertices, triangles, tolerance);
    joined_vertices = joined.joined_vertices;
    report.largest_move = joined.farthest;
    dissolveFlat(welded.vertices, triangles, report);
  }
  if (triangles.empty()) {
    throw Error(where,
                soup.triangles.empty() ? std::string("the mesh has no triangle")
                                       : "none of the mesh's " + std::to_string(soup.triangles.size()) +
                                             " triangles has an area",
                "give a mesh with at least one triangle of non-zero area");
  }
  const detail::SettledFaces settled = detail::settleFaces(welded.vertices, triangles, options.orient);
  report.duplicate_triangles = settled.duplicates;
  report.inner_wall_triangles = settled.inner_walls;
  report.turned_triangles = settled.turned;
  report.welded_vertices = soup.vertices.size() - welded.vertices.size() + joined_vertices;
  report.unused_vertices = dropUnused(welded.vertices, triangles) - joined_vertices;
  const detail::EdgeTable edges = detail::buildEdgeTable(triangles);
  countShells(welded.vertices, triangles, edges, report);
  countEdges(triangles, edges, report);
  return {SurfaceMesh(std::move(welded.vertices), std::move(triangles), where), report};
}

SurfaceMesh weldEqualVertices(const TriangleSoup& soup, const std::string& where) {
  checkSoup(soup, {}, where);
  detail::WeldedVertices welded = detail::weldVertices(soup.vertices, 0.0);
  std::vector<TriangleNodes> triangles = weldedTriangles(soup, welded);
  return SurfaceMesh(std::move(welded.vertices), std::move(triangles), where);
}

}  // namespace concave_distance
