#include "crossings.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/pair_key.h"
#include "base/triangle_measures.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

/// Above a triangle's index in `End::triangle`.
constexpr std::uint64_t kSideB = std::uint64_t{1} << 32U;
constexpr std::uint64_t kOpen = std::uint64_t{1} << 33U;

bool apart(const Corners& a, const Corners& b) {
  for (int i = 0; i < 3; ++i) {
    const auto [low_a, high_a] = std::minmax({(*a[0])[i], (*a[1])[i], (*a[2])[i]});
    const auto [low_b, high_b] = std::minmax({(*b[0])[i], (*b[1])[i], (*b[2])[i]});
    if (high_a < low_b || high_b < low_a) return true;
  }
  return false;
}

/// Corners' sides of the other triangle's plane.
struct Sides {
  int of[3];
  bool flat;      ///< the other triangle has no area
  bool in_plane;  ///< all lie in its plane
  bool mixed;
};

Sides sidesOf(PerturbedPredicates& predicates, const Corners& triangle, Side body, const Corners& corners) {
  Sides sides{};
  sides.in_plane = true;
  for (std::size_t k = 0; k < 3; ++k) {
    bool on_plane = false;
    sides.of[k] = predicates.side(triangle, body, *corners[k], on_plane);
    sides.in_plane = sides.in_plane && on_plane;
  }
  sides.flat = sides.of[0] == 0;
  sides.mixed = sides.of[0] != sides.of[1] || sides.of[1] != sides.of[2];
  return sides;
}

}  // namespace

bool CrossingCurves::find(WorkingFrame& frame, PerturbedPredicates& predicates,
                          const std::vector<CandidatePair>& candidates, WorkLimit& limit) {
  nodes_.clear();
  segments_.clear();
  ends_.clear();
  common_faces_.clear();
  broken_ = false;
  for (const CandidatePair& pair : candidates) {
    if (limit.isOverNow()) return false;
    crossPair(frame, predicates, pair);
  }
  joinEnds(frame);
  return true;
}

void CrossingCurves::crossPair(WorkingFrame& frame, PerturbedPredicates& predicates,
                               const CandidatePair& pair) {
  const Corners a = frame.corners(Side::A, pair.a);
  const Corners b = frame.corners(Side::B, pair.b);
  if (apart(a, b)) return;
  const Sides sides_b = sidesOf(predicates, a, Side::B, b);
  if (sides_b.in_plane && !sides_b.flat) addCommonFace(pair, a, b, sides_b.of[0] < 0);
  if (!sides_b.flat && !sides_b.mixed) return;
  const Sides sides_a = sidesOf(predicates, b, Side::A, a);
  if (!sides_a.flat && !sides_a.mixed) return;
  if (sides_a.flat && sides_b.flat) return;

  int passing[3][3];  // of A's edge i and B's edge j
  bool known[3][3] = {};
  const auto passes = [&](std::size_t i, std::size_t j) {
    if (!known[i][j]) {
      passing[i][j] = predicates.passing(*a[i], *a[(i + 1) % 3], *b[j], *b[(j + 1) % 3]);
      known[i][j] = true;
    }
    return passing[i][j];
  };
  const auto on_closed_shell = [&](Side side, TriangleIndex triangle) {
    const MeshTopology& topology = frame.body(side).topology();
    return topology.isOnClosedShell(triangle);
  };
  const bool closed = on_closed_shell(Side::A, pair.a) && on_closed_shell(Side::B, pair.b);
  const std::size_t first_end = ends_.size();
  const TriangleNodes& nodes_a = frame.surface(Side::A).triangle(pair.a);
  const TriangleNodes& nodes_b = frame.surface(Side::B).triangle(pair.b);
  for (std::size_t k = 0; k < 3 && !sides_a.flat; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (sides_a.of[k] == sides_a.of[next]) continue;
    if (passes(k, 0) != passes(k, 1) || passes(k, 1) != passes(k, 2)) continue;
    appendEnd(Side::A, nodes_a[k], nodes_a[next], pair.b, sides_a.of[k] > 0, closed);
    // Round the inside part of A's triangle the segment ends where an edge runs in.
    ends_.back().is_start = sides_a.of[k] < 0;
  }
  for (std::size_t k = 0; k < 3 && !sides_b.flat; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (sides_b.of[k] == sides_b.of[next]) continue;
    if (passes(0, k) != passes(1, k) || passes(1, k) != passes(2, k)) continue;
    appendEnd(Side::B, nodes_b[k], nodes_b[next], pair.a, sides_b.of[k] > 0, closed);
    ends_.back().is_start = sides_b.of[k] > 0;
  }
  if (ends_.size() == first_end) return;
  if (ends_.size() != first_end + 2 || ends_[first_end].is_start == ends_[first_end + 1].is_start) {
    broken_ = true;
    ends_.resize(first_end);
    return;
  }
  segments_.push_back({{pair.a, pair.b}, kNone, kNone, closed});
}

// B's triangle cut along A's edges (Sutherland and Hodgman 1974): six corners at most, 10 with what rounding
// may add.
void CrossingCurves::addCommonFace(const CandidatePair& pair, const Corners& a, const Corners& b,
                                   bool b_below) {
  const Eigen::Vector3d normal = (*a[1] - *a[0]).cross(*a[2] - *a[0]);
  const bool opposite = normal.dot((*b[1] - *b[0]).cross(*b[2] - *b[0])) < 0.0;
  if (opposite && !b_below) return;
  std::array<Eigen::Vector3d, 10> polygon = {*b[0], *b[1], *b[2]};
  std::array<Eigen::Vector3d, 10> cut;
  std::size_t count = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d inward = normal.cross(*a[(k + 1) % 3] - *a[k]);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count && kept + 2 <= cut.size(); ++i) {
      const Eigen::Vector3d& p = polygon[i];
      const Eigen::Vector3d& q = polygon[(i + 1) % count];
      const double height_p = inward.dot(p - *a[k]);
      const double height_q = inward.dot(q - *a[k]);
      if (height_p >= 0.0) cut[kept++] = p;
      if ((height_p < 0.0) != (height_q < 0.0)) cut[kept++] = p + height_p / (height_p - height_q) * (q - p);
    }
    polygon = cut;
    count = kept;
  }
  CommonFace face;
  face.triangle[0] = pair.a;
  face.triangle[1] = pair.b;
  face.opposite = opposite;
  face.inside = b_below && !opposite ? Side::B : Side::A;
  face.area = 0.0;
  face.centroid.setZero();
  face.corners = polygon;
  face.corner_count = count;
  for (std::size_t i = 2; i < count; ++i) {
    const double area = triangleArea(polygon[0], polygon[i - 1], polygon[i]);
    face.area += area;
    face.centroid += area / 3.0 * (polygon[0] + polygon[i - 1] + polygon[i]);
  }
  if (!(face.area > 0.0)) return;
  face.centroid /= face.area;
  common_faces_.push_back(face);
}

void CrossingCurves::appendEnd(Side side, NodeIndex from, NodeIndex to, TriangleIndex triangle, bool enters,
                               bool closed) {
  const bool ascending = from < to;
  const NodeIndex low = ascending ? from : to;
  const NodeIndex high = ascending ? to : from;
  const std::uint64_t of = (closed ? 0U : kOpen) | (at(side) == 0 ? 0U : kSideB) | triangle.value;
  ends_.push_back(
      {pairKey(low, high), of, static_cast<std::uint32_t>(segments_.size()), false, enters == ascending});
}

void CrossingCurves::joinEnds(WorkingFrame& frame) {
  std::sort(ends_.begin(), ends_.end(), [](const End& l, const End& r) {
    if (l.triangle != r.triangle) return l.triangle < r.triangle;
    if (l.edge != r.edge) return l.edge < r.edge;
    return l.segment < r.segment;
  });
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const End& end = ends_[i];
    if (i == 0 || end.triangle != ends_[i - 1].triangle || end.edge != ends_[i - 1].edge) {
      CrossingNode node{};
      node.edge_side = (end.triangle & kSideB) == 0 ? Side::A : Side::B;
      node.low = NodeIndex{static_cast<std::uint32_t>(end.edge >> 32U)};
      node.high = NodeIndex{static_cast<std::uint32_t>(end.edge)};
      node.triangle = TriangleIndex{static_cast<std::uint32_t>(end.triangle)};
      node.enters = end.enters;
      const Corners triangle = frame.corners(other(node.edge_side), node.triangle);
      const Eigen::Vector3d& low = frame.point(node.edge_side, node.low);
      const Eigen::Vector3d& high = frame.point(node.edge_side, node.high);
      const double height_low = orientationValue(*triangle[0], *triangle[1], *triangle[2], low);
      const double height_high = orientationValue(*triangle[0], *triangle[1], *triangle[2], high);
      node.parameter = height_low == 0.0 ? 0.0 : height_low / (height_low - height_high);
      // From the nearer end, so that what the parameter's rounding moves is least.
      node.position = node.parameter <= 0.5
                          ? Eigen::Vector3d(low + node.parameter * (high - low))
                          : Eigen::Vector3d(high + height_high / (height_high - height_low) * (low - high));
      nodes_.push_back(node);
    }
    const auto index = static_cast<std::uint32_t>(nodes_.size() - 1);
    (end.is_start ? segments_[end.segment].start : segments_[end.segment].end) = index;
  }
}

}  // namespace concave_distance::detail
