#include "surface_pieces.h"

#include <algorithm>
#include <limits>

#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
void SurfacePieces::startStamp(const WorkingFrame& frame) {
  const SurfaceMesh& surface = frame.surface(side_);
  if (vertex_marks_.size() < surface.vertexCount()) vertex_marks_.resize(surface.vertexCount());
  if (triangle_marks_.size() < surface.triangleCount()) triangle_marks_.resize(surface.triangleCount());
  if (++stamp_ != 0) return;
  std::fill(vertex_marks_.begin(), vertex_marks_.end(), Mark{});
  std::fill(triangle_marks_.begin(), triangle_marks_.end(), Mark{});
  stamp_ = 1;
}

void SurfacePieces::collect(WorkingFrame& frame, PerturbedPredicates& predicates, Containment& containment,
                            const CrossingCurves& curves, Side side, UnionFind& sets) {
  side_ = side;
  edges_.clear();
  wholes_.clear();
  waiting_.clear();
  startStamp(frame);
  segments_.clear();
  for (std::uint32_t s = 0; s < curves.segments().size(); ++s) {
    const CrossingSegment& segment = curves.segments()[s];
    if (!segment.closed) continue;
    segments_.push_back(s);
    triangle_marks_[segment.triangle[at(side)].value] = {stamp_, kCrossed};
    sets.unite(segment.start, segment.end);
  }
  const auto triangle_of = [&](std::uint32_t s) { return curves.segments()[s].triangle[at(side)]; };
  std::sort(segments_.begin(), segments_.end(), [&](std::uint32_t l, std::uint32_t r) {
    return triangle_of(l) != triangle_of(r) ? triangle_of(l) < triangle_of(r) : l < r;
  });
  segment_after_node_.assign(curves.nodes().size(), kNone);
  for (const std::uint32_t s : segments_) {
    const CrossingSegment& segment = curves.segments()[s];
    segment_after_node_[side == Side::A ? segment.start : segment.end] = s;
  }
  crossed_edges_.collect(frame, predicates, curves, side, segments_);
  seedFromEdges(curves, sets);
  spread(frame, sets);
  seedFromLoops(frame, predicates, containment, curves, sets);
  seen_.assign(curves.segments().size(), 0);
  for (std::size_t first = 0; first < segments_.size();) {
    std::size_t last = first + 1;
    while (last < segments_.size() && triangle_of(segments_[last]) == triangle_of(segments_[first])) ++last;
    emitTriangle(frame, curves, first, last, sets);
    first = last;
  }
}

std::uint32_t SurfacePieces::markInside(NodeIndex vertex, UnionFind& sets) {
  Mark& mark = vertex_marks_[vertex.value];
  if (mark.stamp != stamp_) {
    mark = {stamp_, sets.add()};
    waiting_.push_back(vertex);
  }
  return mark.value;
}

void SurfacePieces::seedFromEdges(const CrossingCurves& curves, UnionFind& sets) {
  for (const CrossedEdges::Edge& edge : crossed_edges_.edges()) {
    const std::uint32_t first = crossed_edges_.node(edge.first);
    const std::uint32_t last = crossed_edges_.node(edge.last - 1);
    const CrossingNode& node = curves.nodes()[first];
    if (!node.enters) sets.unite(markInside(node.low, sets), first);
    if (curves.nodes()[last].enters) sets.unite(markInside(node.high, sets), last);
  }
}

// Where only the other body's edges run through a triangle, its corners may lie inside all the same: a pit in
// the other body's surface meets it.
void SurfacePieces::seedFromLoops(WorkingFrame& frame, PerturbedPredicates& predicates,
                                  Containment& containment, const CrossingCurves& curves, UnionFind& sets) {
  TriangleIndex previous = kNoTriangle;
  for (const std::uint32_t s : segments_) {
    const TriangleIndex triangle = curves.segments()[s].triangle[at(side_)];
    if (triangle == previous) continue;
    previous = triangle;
    const TriangleNodes& nodes = frame.surface(side_).triangle(triangle);
    if (isInside(nodes[0]) || crossed_edges_.find(nodes[0], nodes[1]) != nullptr ||
        crossed_edges_.find(nodes[1], nodes[2]) != nullptr ||
        crossed_edges_.find(nodes[2], nodes[0]) != nullptr)
      continue;
    if (containment.winding(frame, predicates, side_, frame.point(side_, nodes[0])) > 0) {
      const std::uint32_t element = markInside(nodes[0], sets);
      sets.unite(element, markInside(nodes[1], sets));
      sets.unite(element, markInside(nodes[2], sets));
      spread(frame, sets);
    }
  }
}

void SurfacePieces::spread(const WorkingFrame& frame, UnionFind& sets, std::uint32_t open_shell) {
  const SurfaceMesh& surface = frame.surface(side_);
  const MeshTopology& topology = frame.body(side_).topology();
  while (!waiting_.empty()) {
    const NodeIndex vertex = waiting_.back();
    waiting_.pop_back();
    const std::uint32_t element = vertex_marks_[vertex.value].value;
    for (const TriangleIndex triangle : topology.triangles_of_vertex.row(vertex.value)) {
      const std::uint32_t shell = topology.shell_of_triangle[triangle.value];
      if (open_shell == kNone ? !topology.shell_is_closed[shell] : shell != open_shell) continue;
      const TriangleNodes& nodes = surface.triangle(triangle);
      Mark& mark = triangle_marks_[triangle.value];
      const bool crossed = mark.stamp == stamp_ && mark.value == kCrossed;
      if (!crossed && mark.stamp != stamp_) {
        mark = {stamp_, kWhole};
        wholes_.push_back({triangle, element});
      }
      for (const NodeIndex neighbour : nodes) {
        if (neighbour == vertex || (crossed && crossed_edges_.find(vertex, neighbour) != nullptr)) continue;
        sets.unite(element, markInside(neighbour, sets));
      }
    }
  }
}

void SurfacePieces::addShell(WorkingFrame& frame, TriangleIndex triangle, UnionFind& sets) {
  const MeshTopology& topology = frame.body(side_).topology();
  const std::uint32_t shell = topology.shell_of_triangle[triangle.value];
  const bool open = !topology.shell_is_closed[shell];
  if (open) startStamp(frame);  // a sheet attached to a solid shares vertices with it
  markInside(frame.surface(side_).triangle(triangle)[0], sets);
  spread(frame, sets, open ? shell : kNone);
}

void SurfacePieces::emitTriangle(WorkingFrame& frame, const CrossingCurves& curves, std::size_t first,
                                 std::size_t last, UnionFind& sets) {
  const std::size_t first_edge = edges_.size();
  const TriangleIndex triangle = curves.segments()[segments_[first]].triangle[at(side_)];
  for (std::size_t i = first; i < last; ++i) {
    const CrossingSegment& segment = curves.segments()[segments_[i]];
    const Eigen::Vector3d& start = curves.nodes()[segment.start].position;
    const Eigen::Vector3d& end = curves.nodes()[segment.end].position;
    if (side_ == Side::A) {
      edges_.push_back({triangle, segment.start, start, end});
    } else {
      edges_.push_back({triangle, segment.start, end, start});
    }
  }
  const TriangleNodes& nodes = frame.surface(side_).triangle(triangle);
  for (std::size_t k = 0; k < 3; ++k) emitEdge(frame, curves, triangle, nodes[k], nodes[(k + 1) % 3], sets);
  uniteHoles(frame, curves, first, last, first_edge, sets);
}

void SurfacePieces::emitEdge(WorkingFrame& frame, const CrossingCurves& curves, TriangleIndex triangle,
                             NodeIndex from, NodeIndex to, UnionFind& sets) {
  const CrossedEdges::Edge* crossed = crossed_edges_.find(from, to);
  if (crossed == nullptr) {
    if (isInside(from)) {
      edges_.push_back(
          {triangle, vertex_marks_[from.value].value, frame.point(side_, from), frame.point(side_, to)});
    }
    return;
  }
  const NodeIndex low = std::min(from, to);
  const NodeIndex high = std::max(from, to);
  const auto emit = [&](std::uint32_t element, const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    if (from == low) {
      edges_.push_back({triangle, element, p, q});
    } else {
      edges_.push_back({triangle, element, q, p});
    }
  };
  bool inside = !curves.nodes()[crossed_edges_.node(crossed->first)].enters;
  Eigen::Vector3d start = frame.point(side_, low);
  std::uint32_t start_element = kNone;
  for (std::uint32_t i = crossed->first; i < crossed->last; ++i) {
    const std::uint32_t n = crossed_edges_.node(i);
    const CrossingNode& node = curves.nodes()[n];
    if (inside && !node.enters) {
      if (start_element != kNone) sets.unite(start_element, n);
      emit(n, start, node.position);
      inside = false;
    } else if (!inside && node.enters) {
      start = node.position;
      start_element = n;
      inside = true;
    }
  }
  if (inside) emit(start_element, start, frame.point(side_, high));
}

// The outline and the holes of a piece are no neighbours: each loop within the triangle
// looks from its outermost corner for what it lies in.
void SurfacePieces::uniteHoles(WorkingFrame& frame, const CrossingCurves& curves, std::size_t first,
                               std::size_t last, std::size_t first_edge, UnionFind& sets) {
  const std::vector<CrossingSegment>& segments = curves.segments();
  const TriangleIndex triangle = segments[segments_[first]].triangle[at(side_)];
  const Corners corners = frame.corners(side_, triangle);
  const Eigen::Vector3d normal = (*corners[1] - *corners[0]).cross(*corners[2] - *corners[0]);
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const Eigen::Index u = normal[dropped] > 0.0 ? (dropped + 1) % 3 : (dropped + 2) % 3;
  const Eigen::Index v = normal[dropped] > 0.0 ? (dropped + 2) % 3 : (dropped + 1) % 3;
  // Turned by an angle that no mesh has, or the way out would meet corner after corner of loops in a row.
  const auto flat = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(0.829 * p[u] - 0.559 * p[v], 0.559 * p[u] + 0.829 * p[v]);
  };
  for (std::size_t i = first; i < last; ++i) {
    std::uint32_t s = segments_[i];
    if (seen_[s] != 0) continue;
    std::uint32_t outermost = side_ == Side::A ? segments[s].end : segments[s].start;
    bool loop = false;
    while (true) {
      seen_[s] = 1;
      const std::uint32_t n = side_ == Side::A ? segments[s].end : segments[s].start;
      if (curves.nodes()[n].edge_side == side_) break;
      if (flat(curves.nodes()[n].position)[0] < flat(curves.nodes()[outermost].position)[0]) outermost = n;
      s = segment_after_node_[n];
      loop = s == segments_[i];
      if (s == kNone || seen_[s] != 0 || segments[s].triangle[at(side_)] != triangle) break;
    }
    if (!loop) continue;
    const Eigen::Vector2d corner = flat(curves.nodes()[outermost].position);
    double nearest = -std::numeric_limits<double>::infinity();
    const PieceEdge* hit = nullptr;
    int winding = 0;  // edges that run down have the inside on the loop's side
    for (std::size_t e = first_edge; e < edges_.size(); ++e) {
      const Eigen::Vector2d from = flat(edges_[e].from);
      const Eigen::Vector2d to = flat(edges_[e].to);
      const bool down = to[1] <= corner[1];
      if ((from[1] <= corner[1]) == down) continue;
      const double at_u = from[0] + (corner[1] - from[1]) / (to[1] - from[1]) * (to[0] - from[0]);
      if (!(at_u < corner[0])) continue;
      winding += down ? 1 : -1;
      if (!down || at_u <= nearest) continue;
      nearest = at_u;
      hit = &edges_[e];
    }
    if (winding > 0 && hit != nullptr) sets.unite(hit->element, outermost);
  }
}

}  // namespace concave_distance::detail
