#include "orient_sheets.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/surface/edge_table.h"

namespace concave_distance::detail {
namespace {

/// The triangles across a triangle's edges and whether they run the same way along them, in the order
/// of the triangles, which turning does not change. So a sheet that cannot be oriented stays the same
/// in a second run.
std::array<std::pair<std::uint32_t, bool>, 3> neighboursOf(std::uint32_t triangle, const EdgeTable& edges,
                                                           const std::vector<TriangleNodes>& triangles) {
  std::array<std::pair<std::uint32_t, bool>, 3> neighbours;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfEdge h = 3 * triangle + k;
    const std::uint32_t edge = edges.edge_of_half_edge[h];
    neighbours[k] = {triangle, false};
    if (edges.first[edge + 1] - edges.first[edge] != 2) continue;
    const HalfEdge first = edges.half_edges[edges.first[edge]];
    const HalfEdge other = first == h ? edges.half_edges[edges.first[edge] + 1] : first;
    neighbours[k] = {other / 3, startOf(triangles, h) == startOf(triangles, other)};
  }
  std::sort(neighbours.begin(), neighbours.end());
  return neighbours;
}

}  // namespace

std::size_t orientSheets(std::vector<TriangleNodes>& triangles, const std::vector<bool>& is_sheet) {
  const EdgeTable edges = buildEdgeTable(triangles);
  std::vector<bool> visited(triangles.size(), false);
  std::vector<bool> turned(triangles.size(), false);
  std::vector<std::uint32_t> patch;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (visited[seed] || !is_sheet[seed]) continue;
    patch.assign(1, seed);
    visited[seed] = true;
    std::size_t turned_count = 0;
    for (std::size_t next = 0; next < patch.size(); ++next) {
      const std::uint32_t t = patch[next];
      turned_count += turned[t] ? 1U : 0U;
      for (const auto& [neighbour, same_direction] : neighboursOf(t, edges, triangles)) {
        if (visited[neighbour] || !is_sheet[neighbour]) continue;
        visited[neighbour] = true;
        turned[neighbour] = turned[t] != same_direction;
        patch.push_back(neighbour);
      }
    }
    if (2 * turned_count <= patch.size()) continue;
    for (const std::uint32_t t : patch) turned[t] = !turned[t];
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (turned[t]) std::swap(triangles[t][1], triangles[t][2]);
  }
  return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
}

}  // namespace concave_distance::detail
