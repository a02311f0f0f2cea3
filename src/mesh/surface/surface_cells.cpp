#include "surface_cells.h"

#include <algorithm>

#include "base/union_find.h"

namespace concave_distance::detail {
namespace {

/// Visits the half-edges of each unit along each edge.
template <typename Visit>
void forEachFan(const EdgeTable& edges, const SurfaceUnits& units, Visit visit) {
  std::vector<HalfEdge> around;
  std::vector<HalfEdge> fan;
  const auto unit_of = [&](HalfEdge h) { return units.unit_of_face[h / 3]; };
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    around.assign(edges.half_edges.begin() + edges.first[e], edges.half_edges.begin() + edges.first[e + 1]);
    std::sort(around.begin(), around.end(), [&](HalfEdge l, HalfEdge r) {
      return unit_of(l) != unit_of(r) ? unit_of(l) < unit_of(r) : l < r;
    });
    for (std::size_t i = 0; i < around.size();) {
      fan.clear();
      for (const std::size_t first = i; i < around.size() && unit_of(around[i]) == unit_of(around[first]);
           ++i) {
        fan.push_back(around[i]);
      }
      if (unit_of(fan.front()) != kSheet) visit(fan);
    }
  }
}

}  // namespace

std::vector<FaceSide> findCells(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                                const EdgeTable& edges, const SurfaceUnits& units) {
  UnionFind patches(table.faces.size());
  forEachFan(edges, units, [&](const std::vector<HalfEdge>& fan) {
    if (fan.size() == 2) patches.unite(fan[0] / 3, fan[1] / 3);
  });
  std::vector<std::uint32_t> patch_of_face(table.faces.size());
  for (std::uint32_t f = 0; f < patch_of_face.size(); ++f) patch_of_face[f] = patches.find(f);
  UnionFind sides(2 * table.faces.size());
  forEachFan(edges, units, [&](std::vector<HalfEdge>& fan) {
    if (fan.size() > 2) sortAroundEdge(vertices, table, patch_of_face, fan);
    for (std::size_t k = 0; k < fan.size(); ++k) {
      sides.unite(sideAhead(fan[k]), sideBehind(fan[(k + 1) % fan.size()]));
    }
  });
  std::vector<FaceSide> cells(2 * table.faces.size());
  for (FaceSide side = 0; side < cells.size(); ++side) cells[side] = sides.find(side);
  return cells;
}

}  // namespace concave_distance::detail
