#include "volume_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "point_bins.h"

namespace concave_distance {
namespace {

/// Of the edge length: how far lattice nodes keep off the surface's nodes.
constexpr double kClearance = 0.5;
/// Of the longer edge: how far lattice nodes have neighbours on the surface. No lattice leaves a gap of more
/// than 0.56 edges, so this and the clearance leave none between the two.
constexpr double kReach = 1.25;
/// Of the edge length: the part of a segment next to a surface node that does not count as crossing.
constexpr double kMargin = 1e-3;

/// Half edge lengths from the box's corner: all even (a cube's corner) or all odd (its centre).
using Place = std::array<std::uint32_t, 3>;

std::uint64_t keyOf(const Place& place) {
  return std::uint64_t{place[0]} << 42U | std::uint64_t{place[1]} << 21U | place[2];
}

/// The lattice inside a body.
struct Lattice {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Place> places;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
};

Lattice latticeInside(const SurfaceMesh& surface, const MeshTopology& topology, const TriangleTree& tree,
                      const detail::PointBins& surface_bins, double edge) {
  Lattice lattice;
  const Eigen::Vector3d corner = surface.boundingBox().min();
  const Eigen::Vector3d size = surface.boundingBox().sizes();
  const auto steps = [&](Eigen::Index axis) {
    return static_cast<std::uint32_t>(std::floor(2.0 * size[axis] / edge));
  };
  for (std::uint32_t x = 0; x <= steps(0); ++x) {
    for (std::uint32_t y = x % 2; y <= steps(1); y += 2) {
      for (std::uint32_t z = x % 2; z <= steps(2); z += 2) {
        const Eigen::Vector3d position = corner + 0.5 * edge * Eigen::Vector3d(x, y, z);
        bool is_clear = true;
        surface_bins.visitNear(position, kClearance * edge, [&](std::uint32_t, double) { is_clear = false; });
        if (!is_clear ||
            !containsPoint(tree, surface, topology.shell_is_closed, topology.shell_of_triangle, position)) {
          continue;
        }
        lattice.numbers.emplace(keyOf({x, y, z}), static_cast<std::uint32_t>(lattice.positions.size()));
        lattice.positions.push_back(position);
        lattice.places.push_back({x, y, z});
      }
    }
  }
  return lattice;
}

/// The neighbours of a lattice node with larger keys; each pair is seen once. Wraps below 0 to what no place
/// has.
template <typename Visit>
void visitLaterNeighbours(const Lattice& lattice, std::uint32_t node, Visit&& visit) {
  constexpr std::array<std::array<int, 3>, 7> kSteps = {
      {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  const Place& place = lattice.places[node];
  for (const auto& step : kSteps) {
    Place next{};
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      is_inside = is_inside && (step[k] >= 0 || place[k] > 0);
      next[k] = place[k] + static_cast<std::uint32_t>(step[k]);
    }
    const auto found = is_inside ? lattice.numbers.find(keyOf(next)) : lattice.numbers.end();
    if (found != lattice.numbers.end()) visit(found->second);
  }
}

using Neighbours = std::vector<std::pair<NodeIndex, NodeIndex>>;

/// Lattice nodes that a way leads to from the surface, in the order of the ways, each with the node that it
/// was reached from; the others would be shells of their own.
struct Reached {
  std::vector<std::uint32_t> nodes;  ///< surface nodes first
  std::vector<std::uint32_t> from;   ///< per node; itself on the surface
};

Reached reachFromSurface(std::size_t surface_count, std::size_t all, const Neighbours& neighbours) {
  std::vector<std::vector<std::uint32_t>> next(all);
  for (const auto& [one, other] : neighbours) {
    next[one.value].push_back(other.value);
    next[other.value].push_back(one.value);
  }
  Reached reached;
  reached.from.assign(all, static_cast<std::uint32_t>(all));
  for (std::uint32_t node = 0; node < surface_count; ++node) {
    reached.from[node] = node;
    reached.nodes.push_back(node);
  }
  for (std::size_t i = 0; i < reached.nodes.size(); ++i) {
    for (const std::uint32_t node : next[reached.nodes[i]]) {
      if (reached.from[node] != all) continue;
      reached.from[node] = reached.nodes[i];
      reached.nodes.push_back(node);
    }
  }
  return reached;
}

}  // namespace

SearchNodes makeVolumeNodes(const BodyMesh& body, SearchNodes surface_nodes, double edge) {
  SearchNodes made = std::move(surface_nodes);
  if (made.thinned()) {
    throw Error("volume nodes", "the surface's nodes are thinned", "give max_edge_length");
  }
  if (!(edge > 0.0) || !std::isfinite(edge)) {
    throw Error("volume nodes", "the lattice's edge is " + std::to_string(edge), "give a positive length");
  }
  const double reach = kReach * std::max(edge, made.max_edge_length);
  const double margin = kMargin * edge;
  const std::vector<Eigen::Vector3d> on_surface = made.graph.positions;
  const auto surface_count = static_cast<std::uint32_t>(on_surface.size());
  const detail::PointBins bins(on_surface, reach);
  const Lattice lattice = latticeInside(body.surface(), body.topology(), body.tree(), bins, edge);

  Neighbours neighbours;
  for (std::uint32_t node = 0; node < surface_count; ++node) {
    for (const NodeGraph::Edge& edge : made.graph.edges.row(node)) {
      if (node < edge.to.value) neighbours.emplace_back(NodeIndex{node}, edge.to);
    }
  }
  const auto sees = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return !segmentHits(body.tree(), body.surface(), from, to, margin);
  };
  for (std::uint32_t node = 0; node < lattice.positions.size(); ++node) {
    const Eigen::Vector3d& position = lattice.positions[node];
    const NodeIndex here{surface_count + node};
    visitLaterNeighbours(lattice, node, [&](std::uint32_t other) {
      if (sees(position, lattice.positions[other])) {
        neighbours.emplace_back(here, NodeIndex{surface_count + other});
      }
    });
    bins.visitNear(position, reach, [&](std::uint32_t other, double) {
      if (sees(position, on_surface[other])) neighbours.emplace_back(here, NodeIndex{other});
    });
  }

  const std::size_t all = surface_count + lattice.positions.size();
  const Reached reached = reachFromSurface(surface_count, all, neighbours);
  std::vector<std::uint32_t> number(all, static_cast<std::uint32_t>(all));
  std::vector<Eigen::Vector3d> positions;
  std::vector<TriangleIndex> triangles;
  for (const std::uint32_t node : reached.nodes) {
    number[node] = static_cast<std::uint32_t>(positions.size());
    const bool is_inside = node >= surface_count;
    positions.push_back(is_inside ? lattice.positions[node - surface_count] : on_surface[node]);
    triangles.push_back(is_inside ? triangles[number[reached.from[node]]]
                                  : made.original_triangle_of_node[node]);
  }
  Neighbours kept;
  for (const auto& [one, other] : neighbours) {
    if (number[one.value] != all && number[other.value] != all) {
      kept.emplace_back(NodeIndex{number[one.value]}, NodeIndex{number[other.value]});
    }
  }
  made.graph = buildNodeGraph(std::move(positions), kept);
  made.original_triangle_of_node = std::move(triangles);
  return made;
}

}  // namespace concave_distance
