#include "surface_cells.h"

#include <algorithm>

#include "base/exact_orientation.h"
#include "base/union_find.h"

namespace concave_distance::detail {
namespace {

struct Page {
  HalfEdge half_edge;
  const Eigen::Vector3d* apex;
  int quarter;  ///< 0 level with the first page, 1 up to opposite of it, 2 opposite, 3 beyond
  bool upward;  ///< turning passes upwards through the page's plane; up is the same for every edge
};

constexpr Motion kUp = {1, 1, 1};

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

void sortAroundEdge(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                    const std::vector<std::uint32_t>& patch_of_face, std::vector<HalfEdge>& fan) {
  const auto node_at = [&](HalfEdge h, std::size_t k) { return table.faces[h / 3].nodes[(h % 3 + k) % 3]; };
  const NodeIndex start = node_at(fan.front(), 0);
  const NodeIndex end = node_at(fan.front(), 1);
  const Eigen::Vector3d& low = vertices[std::min(start, end).value];
  const Eigen::Vector3d& high = vertices[std::max(start, end).value];
  const Eigen::Vector3d& first = vertices[node_at(fan.front(), 2).value];
  const bool first_upward = signAlong(kUp, low, high, low, first) > 0;
  std::vector<Page> pages;
  pages.reserve(fan.size());
  for (const HalfEdge h : fan) {
    Page page{h, &vertices[node_at(h, 2).value], 0, false};
    page.upward = signAlong(kUp, low, high, low, *page.apex) > 0;
    const int side = orientationSign(low, high, first, *page.apex);
    page.quarter = side > 0 ? 1 : side < 0 ? 3 : page.upward == first_upward ? 0 : 2;
    pages.push_back(page);
  }
  std::sort(pages.begin(), pages.end(), [&](const Page& l, const Page& r) {
    if (l.quarter != r.quarter) return l.quarter < r.quarter;
    const int turn = l.quarter % 2 == 1 ? orientationSign(low, high, *l.apex, *r.apex) : 0;
    if (turn != 0) return turn > 0;
    const std::uint32_t patch_l = patch_of_face[l.half_edge / 3];
    const std::uint32_t patch_r = patch_of_face[r.half_edge / 3];
    if (patch_l != patch_r) return (patch_l < patch_r) == l.upward;
    return l.upward ? l.half_edge < r.half_edge : r.half_edge < l.half_edge;
  });
  for (std::size_t i = 0; i < pages.size(); ++i) fan[i] = pages[i].half_edge;
}

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
