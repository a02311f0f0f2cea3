#include "random_nodes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/triangle_measures.h"
#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"
#include "point_bins.h"
#include "search/grid/graph_regions.h"
#include "thesis/src/grid/search_grid.h"

namespace concave_distance {
namespace {

/// Edges of the grid that carries the regions, as a share of the nodes' mean spacing.
constexpr double kCarrierShare = 0.25;
/// Cosine of the angle between normals above which faces are flat against each other (4.5e-5 rad).
constexpr double kFlat = 1.0 - 1e-9;

struct SurfaceNode {
  Eigen::Vector3d position;
  TriangleIndex triangle;
};

double areaOf(const SurfaceMesh& surface, TriangleIndex t) {
  return triangleArea(surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2));
}

SurfaceNode anywhereOn(const SurfaceMesh& surface, TriangleIndex t, RandomEngine& engine) {
  const double across = std::sqrt(uniformUnit(engine));
  const double along = uniformUnit(engine);
  return {(1.0 - across) * surface.corner(t, 0) + across * (1.0 - along) * surface.corner(t, 1) +
              across * along * surface.corner(t, 2),
          t};
}

void addVerticesAndEdges(const SurfaceMesh& surface, const MeshTopology& topology, double spacing,
                         std::vector<SurfaceNode>& nodes) {
  for (std::uint32_t v = 0; v < surface.vertexCount(); ++v) {
    const auto triangles = topology.triangles_of_vertex.row(v);
    if (triangles.size() > 0) nodes.push_back({surface.vertices()[v], *triangles.begin()});
  }
  for (std::uint32_t t = 0; t < surface.triangleCount(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const TriangleIndex other = topology.triangle_across_edge[t][k];
      if (other != kNoTriangle) {
        const bool is_flat = topology.triangle_normals[t].dot(topology.triangle_normals[other.value]) > kFlat;
        if (other.value < t || is_flat) continue;
      }
      const Eigen::Vector3d& from = surface.corner(TriangleIndex{t}, static_cast<int>(k));
      const Eigen::Vector3d& to = surface.corner(TriangleIndex{t}, static_cast<int>((k + 1) % 3));
      const auto parts = static_cast<std::size_t>(std::ceil((to - from).norm() / spacing));
      for (std::size_t i = 1; i < parts; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(parts);
        nodes.push_back({from + share * (to - from), TriangleIndex{t}});
      }
    }
  }
}

/// At equal steps of area from a random start: every face has its share, up to one.
void addAnywhere(const SurfaceMesh& surface, double area, std::size_t count, RandomEngine& engine,
                 std::vector<SurfaceNode>& nodes) {
  const double step = area / static_cast<double>(count);
  const double start = uniformUnit(engine);
  double passed = areaOf(surface, TriangleIndex{0});
  std::uint32_t t = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double place = step * (static_cast<double>(i) + start);
    while (passed <= place && t + 1 < surface.triangleCount()) {
      passed += areaOf(surface, TriangleIndex{++t});
    }
    nodes.push_back(anywhereOn(surface, TriangleIndex{t}, engine));
  }
}

void addToBareShells(const SurfaceMesh& surface, const MeshTopology& topology, RandomEngine& engine,
                     std::vector<SurfaceNode>& nodes) {
  std::vector<bool> has_node(topology.shellCount(), false);
  for (const SurfaceNode& node : nodes) has_node[topology.shell_of_triangle[node.triangle.value]] = true;
  for (std::size_t shell = 0; shell < has_node.size(); ++shell) {
    const TriangleIndex triangle = topology.triangle_of_shell[shell];
    if (!has_node[shell] && triangle != kNoTriangle) nodes.push_back(anywhereOn(surface, triangle, engine));
  }
}

/// Finds every node a grid node of its own, from which its region grows; leaves out who finds none, with
/// others nearer than the grid's edges.
std::vector<NodeIndex> carriersOf(const SurfaceMesh& surface, const NodeGraph& carrier, double edge,
                                  std::vector<SurfaceNode>& nodes) {
  const detail::PointBins bins(carrier.positions, edge);
  std::vector<bool> taken(carrier.nodeCount(), false);
  std::vector<NodeIndex> carriers;
  std::vector<SurfaceNode> kept;
  for (const SurfaceNode& node : nodes) {
    // The grid's first nodes are the surface's vertices.
    const std::uint32_t shell = carrier.shell[surface.triangle(node.triangle)[0].value];
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    bins.visitNear(node.position, edge, [&](std::uint32_t i, double distance) {
      if (!taken[i] && carrier.shell[i] == shell && distance < least) {
        least = distance;
        nearest = i;
      }
    });
    if (!std::isfinite(least)) continue;
    taken[nearest] = true;
    carriers.emplace_back(nearest);
    kept.push_back(node);
  }
  nodes = std::move(kept);
  return carriers;
}

}  // namespace

SearchNodes makeRandomNodes(const SurfaceMesh& surface, const MeshTopology& topology,
                            const RandomNodesOptions& options, RandomEngine& engine,
                            const std::string& where) {
  if (options.count == 0) throw Error(where, "no random points are asked for", "ask for one or more");
  double area = 0.0;
  for (std::uint32_t t = 0; t < surface.triangleCount(); ++t) area += areaOf(surface, TriangleIndex{t});
  // Of a triangular lattice with as many nodes.
  const double spacing = std::sqrt(2.0 / std::sqrt(3.0) * area / static_cast<double>(options.count));
  std::vector<SurfaceNode> nodes;
  if (options.vertices_and_edges) addVerticesAndEdges(surface, topology, spacing, nodes);
  if (nodes.size() < options.count) {
    addAnywhere(surface, area, options.count - nodes.size(), engine, nodes);
  }
  addToBareShells(surface, topology, engine, nodes);

  SearchNodes made;
  const double edge = kCarrierShare * spacing;
  made.grid = makeSearchGrid(surface, edge).mesh;
  const NodeGraph carrier = buildNodeGraph(made.grid);
  detail::GraphRegions regions(carrier);
  for (const NodeIndex node : carriersOf(surface, carrier, edge, nodes)) regions.grow(node);
  ThinnedGraph thinned = regions.thinned();

  std::vector<Eigen::Vector3d> positions;
  for (const SurfaceNode& node : nodes) {
    positions.push_back(node.position);
    made.original_triangle_of_node.push_back(node.triangle);
  }
  std::vector<std::pair<NodeIndex, NodeIndex>> neighbours;
  for (std::uint32_t node = 0; node < positions.size(); ++node) {
    for (const NodeGraph::Edge& edge : thinned.graph.edges.row(node)) {
      neighbours.emplace_back(NodeIndex{node}, edge.to);
      made.max_edge_length =
          std::max(made.max_edge_length, (positions[node] - positions[edge.to.value]).norm());
    }
  }
  made.graph = buildNodeGraph(std::move(positions), neighbours);
  thinned.nearest.resize(surface.vertexCount());
  made.graph_node_of_vertex = std::move(thinned.nearest);
  return made;
}

}  // namespace concave_distance
