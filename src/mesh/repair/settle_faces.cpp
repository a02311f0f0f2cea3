#include "settle_faces.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "find_cavities.h"
#include "mesh/surface/edge_table.h"
#include "mesh/surface/resolve_shells.h"

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

/// Turns triangles of sheets (swaps corners 1 and 2) until the two at every edge of exactly two agree, as far
/// as the sheet is orientable; windings are not compared across edges of more triangles. Each set of
/// connected triangles keeps the winding of its majority. Returns how many were turned. O(n log n).
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

/// How many triangles of a face stay, in the winding of its corners and in the other one.
struct Needed {
  std::uint32_t along = 0;
  std::uint32_t against = 0;
};

Needed neededOf(const Face& face, const FaceDecision& decision, bool is_cavity, bool first_runs_along) {
  Needed needed;
  if (decision.role == FaceRole::Skin) {
    const auto count = static_cast<std::uint32_t>(std::abs(decision.coefficient));
    ((decision.coefficient > 0) != is_cavity ? needed.along : needed.against) = count;
  } else if (decision.role == FaceRole::Sheet) {
    if (decision.both_windings) {
      needed = {1, 1};
    } else {
      (first_runs_along ? needed.along : needed.against) = 1;
    }
  }
  const std::uint32_t copies = face.copies();
  needed.along = std::min(needed.along, copies);
  needed.against = std::min(needed.against, copies - needed.along);
  return needed;
}

class Settler {
 public:
  Settler(std::vector<TriangleNodes>& triangles, std::vector<std::uint32_t>& origins, bool orient)
      : triangles_(triangles),
        origins_(origins),
        orient_(orient),
        stays_(triangles.size(), true),
        is_sheet_(triangles.size()) {}

  void settle(const FaceTable& table, const Face& face, const FaceDecision& decision, bool is_cavity) {
    const std::uint32_t* const first = &table.triangles[face.first];
    Needed needed = neededOf(face, decision, is_cavity, runsAlong(triangles_[*first]));
    const std::uint32_t count = needed.along + needed.against;
    (decision.role == FaceRole::Wall ? result.inner_walls : result.duplicates) += face.copies() - count;
    std::uint32_t missing = count;
    for (const std::uint32_t* t = first; t != first + face.copies(); ++t) {
      is_sheet_[*t] = decision.role == FaceRole::Sheet;
      std::uint32_t& wanted = runsAlong(triangles_[*t]) ? needed.along : needed.against;
      stays_[*t] = missing > 0 && (!orient_ || wanted > 0);
      if (!stays_[*t]) continue;
      if (wanted > 0) --wanted;
      --missing;
    }
    // Missing ones are taken from those left out, turned.
    for (const std::uint32_t* t = first; missing > 0; ++t) {
      if (stays_[*t]) continue;
      stays_[*t] = true;
      std::swap(triangles_[*t][1], triangles_[*t][2]);
      ++result.turned;
      --missing;
    }
  }

  void finish() {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (!stays_[t]) continue;
      is_sheet_[kept] = is_sheet_[t];
      origins_[kept] = origins_[t];
      triangles_[kept++] = triangles_[t];
    }
    triangles_.resize(kept);
    origins_.resize(kept);
    is_sheet_.resize(kept);
    if (orient_) result.turned += orientSheets(triangles_, is_sheet_);
  }

  SettledFaces result;

 private:
  std::vector<TriangleNodes>& triangles_;
  std::vector<std::uint32_t>& origins_;
  bool orient_;
  std::vector<bool> stays_;
  std::vector<bool> is_sheet_;
};

SettledFaces settleOnce(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                        std::vector<std::uint32_t>& origins, bool orient) {
  const ResolvedShells resolved = resolveShells(vertices, triangles);
  const std::vector<bool> is_cavity = findCavities(vertices, resolved);
  Settler settler(triangles, origins, orient);
  for (std::size_t f = 0; f < resolved.table.faces.size(); ++f) {
    const std::uint32_t unit = resolved.units.unit_of_face[f];
    settler.settle(resolved.table, resolved.table.faces[f], resolved.decisions[f],
                   unit != kSheet && is_cavity[unit]);
  }
  settler.finish();
  return settler.result;
}

bool hasBranchingEdges(const std::vector<TriangleNodes>& triangles) {
  const EdgeTable edges = buildEdgeTable(triangles);
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    if (edges.first[e + 1] - edges.first[e] > 2) return true;
  }
  return false;
}

}  // namespace

SettledFaces settleFaces(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                         bool orient) {
  // If faces overlap in one plane, another one may be outside with the new windings.
  constexpr int kMostRounds = 8;
  const std::vector<TriangleNodes> before = triangles;
  std::vector<std::uint32_t> origins(triangles.size());
  std::iota(origins.begin(), origins.end(), 0U);
  SettledFaces total;
  for (int round = 0; round < kMostRounds; ++round) {
    const SettledFaces settled = settleOnce(vertices, triangles, origins, orient);
    total.duplicates += settled.duplicates;
    total.inner_walls += settled.inner_walls;
    if (settled.duplicates + settled.inner_walls + settled.turned == 0) break;
    if (!hasBranchingEdges(triangles)) break;
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    total.turned += triangles[t] != before[origins[t]] ? 1U : 0U;
  }
  return total;
}

}  // namespace concave_distance::detail
