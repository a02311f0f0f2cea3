#include "search_grid.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <queue>

#include "mesh/surface/editable_mesh.h"
#include "mesh/surface/flat_patches.h"
#include "patch_lattice.h"
#include "patch_locator.h"
#include "patch_triangulation.h"

namespace concave_distance {
namespace {

using detail::EdgeTable;
using detail::EditableMesh;
using detail::FlatPatches;
using detail::GridPoint;
using detail::PatchTriangulation;

/// What is left of a plane in single precision, as a fraction of the body's diameter.
constexpr double kFlatness = 4e-7;

/// Room for rounding: an edge divided into equal parts of the very length allowed is short enough.
constexpr double kLengthTolerance = 1e-9;

/// A lattice point closer than this fraction of the longest edge to a node is left out.
constexpr double kLeastDistance = 0.4;

/// Divides an edge into `count` equal parts; halves first, so that no fan of slivers arises.
void divideEdge(const EditableMesh& mesh, PatchTriangulation& triangulation, std::size_t edge,
                std::size_t count, TriangleIndex original) {
  struct Part {
    std::size_t edge;
    std::size_t from;
    std::size_t to;
  };
  const Eigen::Vector3d a = mesh.vertices()[mesh.edge(edge).a.value];
  const Eigen::Vector3d b = mesh.vertices()[mesh.edge(edge).b.value];
  std::vector<Part> parts{{edge, 0, count}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.to - part.from < 2) {
      continue;
    }
    const std::size_t middle = (part.from + part.to) / 2;
    const double fraction = static_cast<double>(middle) / static_cast<double>(count);
    const std::size_t other_half = mesh.edgeCount();
    triangulation.splitEdge(part.edge, {(1.0 - fraction) * a + fraction * b, original});
    parts.push_back({part.edge, part.from, middle});
    parts.push_back({other_half, middle, part.to});
  }
}

/// Divides evenly every edge that is not interior to a patch.
void divideBorders(const EdgeTable& edges, double max_edge_length, std::size_t node_limit, EditableMesh& mesh,
                   PatchTriangulation& triangulation) {
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const double parts =
        std::ceil(std::sqrt(mesh.squaredLength(e)) / max_edge_length * (1.0 - kLengthTolerance));
    if (parts > 1.0 && !triangulation.isInterior(e)) {
      if (parts + static_cast<double>(mesh.vertices().size()) > static_cast<double>(node_limit)) {
        detail::throwTooManyNodes(max_edge_length, node_limit);
      }
      divideEdge(mesh, triangulation, e, static_cast<std::size_t>(parts),
                 TriangleIndex{edges.half_edges[edges.first[e]] / 3});
    }
  }
  triangulation.rememberEdges();
  std::vector<std::uint32_t> all(mesh.edgeCount());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<std::uint32_t> changed;
  triangulation.legalise(all, changed);
}

/// The locators of the patches that need one.
class Locators {
 public:
  Locators(const SurfaceMesh& surface, const FlatPatches& patches)
      : surface_(surface), patches_(patches), locators_(patches.frames.size()) {}
  GridPoint find(std::uint32_t patch, const Eigen::Vector2d& place) {
    if (!locators_[patch]) {
      locators_[patch] = std::make_unique<detail::PatchLocator>(surface_, patches_.frames[patch],
                                                                patches_.triangles_of_patch[patch]);
    }
    return locators_[patch]->find(place);
  }

 private:
  const SurfaceMesh& surface_;
  const FlatPatches& patches_;
  std::vector<std::unique_ptr<detail::PatchLocator>> locators_;
};

void fillPatches(const FlatPatches& patches, double max_edge_length, const EditableMesh& mesh,
                 PatchTriangulation& triangulation, Locators& locators) {
  std::vector<std::vector<std::uint32_t>> triangles_of_patch(patches.frames.size());
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    triangles_of_patch[mesh.tag(t)].push_back(t);
  }
  std::vector<detail::LatticePoint> points;
  for (std::uint32_t p = 0; p < triangles_of_patch.size(); ++p) {
    findLatticePoints(mesh, triangulation, triangles_of_patch[p], patches.frames[p], max_edge_length, points);
    for (const detail::LatticePoint& point : points) {
      triangulation.addPending(point.triangle, locators.find(p, point.place));
    }
  }
  triangulation.insertPending(kLeastDistance * max_edge_length);
}

/// Splits what is still too long at its middle, longest first, and keeps the patches Delaunay.
void splitLongEdges(const FlatPatches& patches, double max_edge_length, std::size_t node_limit,
                    const EditableMesh& mesh, PatchTriangulation& triangulation, Locators& locators) {
  struct LongEdge {
    double squared_length;
    std::uint32_t edge;
    bool operator<(const LongEdge& r) const {  // longest first, then the lowest number
      return squared_length != r.squared_length ? squared_length < r.squared_length : edge > r.edge;
    }
  };
  const double limit = max_edge_length * (1.0 + kLengthTolerance);
  std::priority_queue<LongEdge> long_edges;
  const auto consider = [&](std::uint32_t e) {
    const double squared_length = mesh.squaredLength(e);
    if (squared_length > limit * limit) {
      long_edges.push({squared_length, e});
    }
  };
  for (std::uint32_t e = 0; e < mesh.edgeCount(); ++e) {
    consider(e);
  }
  std::vector<std::uint32_t> stack;
  std::vector<std::uint32_t> changed;
  while (!long_edges.empty()) {
    const LongEdge longest = long_edges.top();
    long_edges.pop();
    if (mesh.squaredLength(longest.edge) != longest.squared_length) {
      continue;  // split or flipped since
    }
    if (mesh.vertices().size() >= node_limit) {
      detail::throwTooManyNodes(max_edge_length, node_limit);
    }
    const std::uint32_t patch = mesh.tag(mesh.edge(longest.edge).first / 3);
    const Eigen::Vector3d& a = mesh.vertices()[mesh.edge(longest.edge).a.value];
    const Eigen::Vector3d& b = mesh.vertices()[mesh.edge(longest.edge).b.value];
    triangulation.splitEdge(longest.edge, locators.find(patch, patches.frames[patch].project(0.5 * (a + b))));
    triangulation.appendTouchedEdges(stack);
    changed = stack;
    triangulation.legalise(stack, changed);
    for (const std::uint32_t e : changed) {
      consider(e);
    }
  }
}

bool hasLongEdge(const SurfaceMesh& surface, double max_edge_length) {
  const double limit = max_edge_length * (1.0 + kLengthTolerance);
  const auto is_long = [&](NodeIndex a, NodeIndex b) {
    return (surface.vertex(a) - surface.vertex(b)).squaredNorm() > limit * limit;
  };
  return std::any_of(surface.triangles().begin(), surface.triangles().end(), [&](const TriangleNodes& t) {
    return is_long(t[0], t[1]) || is_long(t[1], t[2]) || is_long(t[2], t[0]);
  });
}

}  // namespace

SearchGrid makeSearchGrid(const SurfaceMesh& surface, double max_edge_length, std::size_t node_limit) {
  detail::checkRefinement(surface, max_edge_length);
  detail::checkNodeLimit(surface, max_edge_length, node_limit);
  SearchGrid grid;
  grid.original_triangle_of_node.resize(surface.vertexCount());
  for (std::size_t t = surface.triangleCount(); t-- > 0;) {  // descending: the least number stays
    for (const NodeIndex node : surface.triangles()[t]) {
      grid.original_triangle_of_node[node.value] = TriangleIndex{t};
    }
  }
  if (!hasLongEdge(surface, max_edge_length)) {
    grid.mesh = surface;
    return grid;
  }
  const EdgeTable edges = detail::buildEdgeTable(surface.triangles());
  const FlatPatches patches = detail::findFlatPatches(surface, edges, kFlatness * surface.diameter());
  EditableMesh mesh(surface, patches.patch_of_triangle);
  PatchTriangulation triangulation(mesh, patches.frames, std::move(grid.original_triangle_of_node));
  Locators locators(surface, patches);
  divideBorders(edges, max_edge_length, node_limit, mesh, triangulation);
  fillPatches(patches, max_edge_length, mesh, triangulation, locators);
  splitLongEdges(patches, max_edge_length, node_limit, mesh, triangulation, locators);
  grid.original_triangle_of_node = triangulation.originalTriangleOfNode();
  grid.mesh = SurfaceMesh(mesh.releaseVertices(), mesh.releaseTriangles(), "search grid");
  return grid;
}

}  // namespace concave_distance
