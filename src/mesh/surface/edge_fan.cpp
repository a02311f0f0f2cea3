#include "edge_fan.h"

#include <algorithm>

#include "base/exact_orientation.h"

namespace concave_distance::detail {
namespace {

struct Page {
  HalfEdge half_edge;
  const Eigen::Vector3d* apex;
  int quarter;  ///< 0 level with the first page, 1 up to opposite of it, 2 opposite, 3 beyond
  bool upward;  ///< turning passes upwards through the page's plane; up is the same for every edge
};

constexpr Motion kUp = {1, 1, 1};

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

}  // namespace concave_distance::detail
