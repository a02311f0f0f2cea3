#include "surface_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pair_key.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

/// Parameters farther apart than this are in their order in spite of rounding.
constexpr double kSureOrder = 0x1.0p-46;

std::uint64_t edgeKey(NodeIndex p, NodeIndex q) {
  return pairKey(std::min(p, q), std::max(p, q));
}

std::uint64_t edgeKey(const CrossingNode& node) {
  return edgeKey(node.low, node.high);
}

}  // namespace

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
                            const CrossingCurves& curves, Side side, ElementSets& sets) {
  side_ = side;
  contradiction_ = kNone;
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
  sortEdgeNodes(frame, predicates, curves);
  seedFromEdges(curves, sets);
  flood(frame, sets);
  seedFromLoops(frame, predicates, containment, curves, sets);
  seen_.assign(curves.segments().size(), 0);
  for (std::size_t first = 0; first < segments_.size();) {
    std::size_t last = first + 1;
    while (last < segments_.size() && triangle_of(segments_[last]) == triangle_of(segments_[first])) ++last;
    emitTriangle(frame, curves, first, last, sets);
    first = last;
  }
}

void SurfacePieces::sortEdgeNodes(WorkingFrame& frame, PerturbedPredicates& predicates,
                                  const CrossingCurves& curves) {
  const std::vector<CrossingNode>& nodes = curves.nodes();
  edge_nodes_.clear();
  for (const std::uint32_t s : segments_) {
    const CrossingSegment& segment = curves.segments()[s];
    for (const std::uint32_t n : {segment.start, segment.end}) {
      if (nodes[n].edge_side == side_) edge_nodes_.push_back(n);
    }
  }
  std::sort(edge_nodes_.begin(), edge_nodes_.end(), [&](std::uint32_t l, std::uint32_t r) {
    const std::uint64_t key_l = edgeKey(nodes[l]);
    const std::uint64_t key_r = edgeKey(nodes[r]);
    if (key_l != key_r) return key_l < key_r;
    if (nodes[l].parameter != nodes[r].parameter) return nodes[l].parameter < nodes[r].parameter;
    return l < r;
  });
  edge_nodes_.erase(std::unique(edge_nodes_.begin(), edge_nodes_.end()), edge_nodes_.end());
  crossed_edges_.clear();
  for (std::uint32_t i = 0; i < edge_nodes_.size(); ++i) {
    const std::uint64_t key = edgeKey(nodes[edge_nodes_[i]]);
    if (crossed_edges_.empty() || crossed_edges_.back().key != key) crossed_edges_.push_back({key, i, i});
    // What rounding may have swapped is put right exactly.
    std::uint32_t j = i;
    while (j > crossed_edges_.back().first &&
           before(frame, predicates, nodes[edge_nodes_[j]], nodes[edge_nodes_[j - 1]])) {
      std::swap(edge_nodes_[j], edge_nodes_[j - 1]);
      --j;
    }
    crossed_edges_.back().last = i + 1;
  }
  for (const CrossedEdge& edge : crossed_edges_) {
    for (std::uint32_t i = edge.first + 1; i < edge.last; ++i) {
      if (nodes[edge_nodes_[i]].enters == nodes[edge_nodes_[i - 1]].enters) contradiction_ = edge_nodes_[i];
    }
  }
}

bool SurfacePieces::before(WorkingFrame& frame, PerturbedPredicates& predicates, const CrossingNode& l,
                           const CrossingNode& r) const {
  if (std::abs(l.parameter - r.parameter) > kSureOrder) return l.parameter < r.parameter;
  const auto plane = [&](const CrossingNode& node) {
    const Corners corners = frame.corners(other(side_), node.triangle);
    return PlaneOnSegment{{corners[0], corners[1], corners[2]}, node.enters ? 1 : -1};
  };
  return predicates.order(frame.point(side_, l.low), frame.point(side_, l.high), plane(l), plane(r), side_) <
         0;
}

const SurfacePieces::CrossedEdge* SurfacePieces::crossedEdge(NodeIndex p, NodeIndex q) const {
  const std::uint64_t key = edgeKey(p, q);
  const auto found =
      std::lower_bound(crossed_edges_.begin(), crossed_edges_.end(), key,
                       [](const CrossedEdge& edge, std::uint64_t sought) { return edge.key < sought; });
  return found != crossed_edges_.end() && found->key == key ? &*found : nullptr;
}

std::uint32_t SurfacePieces::markInside(NodeIndex vertex, ElementSets& sets) {
  Mark& mark = vertex_marks_[vertex.value];
  if (mark.stamp != stamp_) {
    mark = {stamp_, sets.add()};
    waiting_.push_back(vertex);
  }
  return mark.value;
}

void SurfacePieces::seedFromEdges(const CrossingCurves& curves, ElementSets& sets) {
  for (const CrossedEdge& edge : crossed_edges_) {
    const std::uint32_t first = edge_nodes_[edge.first];
    const std::uint32_t last = edge_nodes_[edge.last - 1];
    const CrossingNode& node = curves.nodes()[first];
    if (!node.enters) sets.unite(markInside(node.low, sets), first);
    if (curves.nodes()[last].enters) sets.unite(markInside(node.high, sets), last);
  }
}

// Where only the other body's edges run through a triangle, its corners may lie inside all the same: a pit in
// the other body's surface meets it.
void SurfacePieces::seedFromLoops(WorkingFrame& frame, PerturbedPredicates& predicates,
                                  Containment& containment, const CrossingCurves& curves, ElementSets& sets) {
  TriangleIndex previous = kNoTriangle;
  for (const std::uint32_t s : segments_) {
    const TriangleIndex triangle = curves.segments()[s].triangle[at(side_)];
    if (triangle == previous) continue;
    previous = triangle;
    const TriangleNodes& nodes = frame.surface(side_).triangle(triangle);
    if (isInside(nodes[0]) || crossedEdge(nodes[0], nodes[1]) != nullptr ||
        crossedEdge(nodes[1], nodes[2]) != nullptr || crossedEdge(nodes[2], nodes[0]) != nullptr)
      continue;
    if (containment.winding(frame, predicates, side_, frame.point(side_, nodes[0])) > 0) {
      const std::uint32_t element = markInside(nodes[0], sets);
      sets.unite(element, markInside(nodes[1], sets));
      sets.unite(element, markInside(nodes[2], sets));
      flood(frame, sets);
    }
  }
}

void SurfacePieces::flood(const WorkingFrame& frame, ElementSets& sets, std::uint32_t open_shell) {
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
        if (neighbour == vertex || (crossed && crossedEdge(vertex, neighbour) != nullptr)) continue;
        sets.unite(element, markInside(neighbour, sets));
      }
    }
  }
}

void SurfacePieces::addShell(WorkingFrame& frame, TriangleIndex triangle, ElementSets& sets) {
  const MeshTopology& topology = frame.body(side_).topology();
  const std::uint32_t shell = topology.shell_of_triangle[triangle.value];
  const bool open = !topology.shell_is_closed[shell];
  if (open) startStamp(frame);  // a sheet attached to a solid shares vertices with it
  markInside(frame.surface(side_).triangle(triangle)[0], sets);
  flood(frame, sets, open ? shell : kNone);
}

void SurfacePieces::emitTriangle(WorkingFrame& frame, const CrossingCurves& curves, std::size_t first,
                                 std::size_t last, ElementSets& sets) {
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
                             NodeIndex from, NodeIndex to, ElementSets& sets) {
  const CrossedEdge* crossed = crossedEdge(from, to);
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
  bool inside = !curves.nodes()[edge_nodes_[crossed->first]].enters;
  Eigen::Vector3d start = frame.point(side_, low);
  std::uint32_t start_element = kNone;
  for (std::uint32_t i = crossed->first; i < crossed->last; ++i) {
    const std::uint32_t n = edge_nodes_[i];
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

// Of a piece with holes the outline and the holes' loops are no neighbours: each loop within the triangle
// looks from its outermost corner for what it lies in.
void SurfacePieces::uniteHoles(WorkingFrame& frame, const CrossingCurves& curves, std::size_t first,
                               std::size_t last, std::size_t first_edge, ElementSets& sets) {
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
