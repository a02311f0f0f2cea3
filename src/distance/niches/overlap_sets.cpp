#include "overlap_sets.h"

#include <algorithm>
#include <tuple>

#include "facet_pair_neighbours.h"
#include "mesh/trees/ray_crossing.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

std::size_t indexOf(Side side) {
  return side == Side::A ? 0 : 1;
}

bool hasMaterial(const BodyMesh& body) {
  const std::vector<bool>& closed = body.topology().shell_is_closed;
  return std::find(closed.begin(), closed.end(), true) != closed.end();
}

}  // namespace

bool OverlapSets::join(const PairFrame& frame, const MeetingPairs& met, WorkLimit& limit) {
  frame_ = &frame;
  met_ = &met;
  limit_ = &limit;
  tolerance_ = meetingTolerance(frame);
  if (!joinCurves()) return false;
  at(Side::A).may_be_inside = hasMaterial(frame.b);
  at(Side::B).may_be_inside = hasMaterial(frame.a);
  for (const Side side : {Side::A, Side::B}) {
    if (count_ > 1 && at(side).may_be_inside) begin(side);
  }
  for (const auto step : {&OverlapSets::joinAlongEdges, &OverlapSets::joinInFacets, &OverlapSets::spread}) {
    for (const Side side : {Side::A, Side::B}) {
      if (count_ > 1 && at(side).may_be_inside && !(this->*step)(side)) return false;
    }
  }
  return count_ <= 1 || joinThroughInside();
}

void OverlapSets::unite(std::uint32_t l, std::uint32_t r) {
  const std::uint32_t root_l = sets_.find(l);
  const std::uint32_t root_r = sets_.find(r);
  if (root_l == root_r) return;
  if (std::max(root_l, root_r) < met_->pairs().size()) --count_;
  sets_.unite(root_l, root_r);
}

/// Joins pairs that have a point in common: what two facets share is within the tolerance of a third one.
bool OverlapSets::joinCurves() {
  const std::size_t count = met_->pairs().size();
  for (UnionFind* sets : {&sets_, &surfaces_[0].clusters, &surfaces_[1].clusters}) {
    sets->reset(count);
  }
  count_ = count;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (limit_->isOverNow()) return false;
    for (const Side side : {Side::A, Side::B}) joinNeighbours(side, i);
  }
  return true;
}

void OverlapSets::joinNeighbours(Side side, std::uint32_t pair) {
  const MeetingPair& met = met_->pairs()[pair];
  const TriangleIndex facet = side == Side::A ? met.a : met.b;
  const TriangleIndex other = side == Side::A ? met.b : met.a;
  const std::array<NodeIndex, 4>& nodes = facets(side).nodes[facet.value];
  const auto& adjacency = side == Side::A ? *frame_->adjacency_a : *frame_->adjacency_b;
  UnionFind& clusters = at(otherOf(side)).clusters;
  for (const AdjacentTriangle& next : adjacency.row(facet.value)) {
    const bool is_edge = next.from != next.to && !PairFrame::isJoint(body(side), next);
    if (is_edge) {
      std::size_t k = 0;
      while (k < 3 && nodes[k] != next.from) ++k;
      if ((met.met_edges[indexOf(side)] >> k & 1U) == 0) continue;
    }
    const std::uint32_t beside =
        side == Side::A ? met_->find(next.triangle, other) : met_->find(other, next.triangle);
    if (beside == MeetingPairs::kNone || clusters.areJoined(pair, beside)) continue;
    if (!is_edge &&
        closestOver(*frame_, {side, next.from, next.to, other}).squared_distance > tolerance_ * tolerance_) {
      continue;
    }
    clusters.unite(pair, beside);
    unite(pair, beside);
  }
}

void OverlapSets::begin(Side side) {
  Surface& surface = at(side);
  const std::size_t vertices = body(side).surface().vertexCount();
  const std::size_t triangles = body(side).surface().triangleCount();
  reserve(surface.vertices, vertices);
  reserve(surface.facets, triangles);
  if (++surface.stamp == 0) {
    std::fill(surface.vertices.begin(), surface.vertices.end(), Mark{});
    std::fill(surface.facets.begin(), surface.facets.end(), Mark{});
    surface.stamp = 1;
  }
  const std::size_t count = met_->pairs().size();
  surface.waiting.clear();
  surface.met.clear();
  surface.pairs.clear();
  for (std::uint32_t i = 0; i < count; ++i) surface.pairs.push_back(i);
  std::sort(surface.pairs.begin(), surface.pairs.end(), [&](std::uint32_t l, std::uint32_t r) {
    const TriangleIndex of_l = facetIn(side, l);
    const TriangleIndex of_r = facetIn(side, r);
    return of_l != of_r ? of_l < of_r : l < r;
  });
  for (std::uint32_t first = 0, last = 0; first < count; first = last) {
    const TriangleIndex facet = facetIn(side, surface.pairs[first]);
    while (last < count && facetIn(side, surface.pairs[last]) == facet) ++last;
    surface.facets[facet.value] = {surface.stamp, static_cast<std::uint32_t>(surface.met.size())};
    surface.met.push_back({facet, first, last});
  }
}

void OverlapSets::reserve(std::vector<Mark>& marks, std::size_t count) {
  if (marks.size() < count) marks.resize(count);
}

bool OverlapSets::isInside(Side side, NodeIndex vertex) {
  const Surface& surface = at(side);
  const Mark& mark = surface.vertices[vertex.value];
  if (mark.stamp == surface.stamp) return mark.value != kNone;
  const bool inside =
      holds(otherOf(side), side == Side::A ? frame_->vertexOfA(vertex) : frame_->vertexOfB(vertex));
  if (inside) {
    markInside(side, vertex);
  } else {
    markOutside(side, vertex);
  }
  return inside;
}

std::uint32_t OverlapSets::markInside(Side side, NodeIndex vertex) {
  Surface& surface = at(side);
  Mark& mark = surface.vertices[vertex.value];
  if (mark.stamp != surface.stamp || mark.value == kNone) {
    mark = {surface.stamp, sets_.add()};
    surface.waiting.push_back(vertex);
  }
  return mark.value;
}

/// Goes on from the vertices that are inside over all facets that the other body does not meet.
bool OverlapSets::spread(Side side) {
  Surface& surface = at(side);
  const MeshTopology& topology = body(side).topology();
  const ShellContacts& contacts = body(side).shellContacts();
  while (!surface.waiting.empty() && count_ > 1) {
    const NodeIndex vertex = surface.waiting.back();
    surface.waiting.pop_back();
    for (const TriangleIndex triangle : topology.triangles_of_vertex.row(vertex.value)) {
      if (contacts.isHidden(triangle)) continue;
      const TriangleIndex facet = facets(side).facet_of_triangle[triangle.value];
      Mark& mark = surface.facets[facet.value];
      if (mark.stamp == surface.stamp) continue;
      mark = {surface.stamp, kNone};
      if (limit_->isOverNow()) return false;
      const std::uint32_t element = surface.vertices[vertex.value].value;
      for (const NodeIndex node : facets(side).nodes[facet.value]) unite(element, markInside(side, node));
      if (!joinOverJoints(side, facet, false)) return false;
    }
  }
  return true;
}

bool OverlapSets::joinOverJoints(Side side, TriangleIndex facet, bool is_met) {
  const auto& adjacency = side == Side::A ? *frame_->adjacency_a : *frame_->adjacency_b;
  for (const AdjacentTriangle& next : adjacency.row(facet.value)) {
    if (!PairFrame::isJoint(body(side), next)) continue;
    if (limit_->isOverNow()) return false;
    Vector3d middle = 0.5 * (frame_->ownVertex(side, next.from) + frame_->ownVertex(side, next.to));
    if (side == Side::B) middle = frame_->rotation * middle + frame_->offset;
    if (is_met && !holds(otherOf(side), middle)) continue;
    const std::uint32_t here = elementAt(side, facet, middle);
    unite(here, elementAt(side, next.triangle, middle));
  }
  return true;
}

/// Joins the parts of the overlap's boundary, of which one may hold another, across what is between them.
bool OverlapSets::joinThroughInside() {
  if (!at(Side::A).may_be_inside || !at(Side::B).may_be_inside) return true;
  for (std::uint32_t pair = 0; pair < met_->pairs().size() && count_ > 1; ++pair) {
    if (sets_.find(pair) == pair && !joinAlongRay(pair)) return false;
  }
  return spread(Side::A) && spread(Side::B);
}

bool OverlapSets::joinAlongRay(std::uint32_t pair) {
  static const Vector3d direction = Vector3d(0.8431, 0.2749, 0.4620).normalized();
  const Vector3d from = pointOf(Side::A, pair);
  ray_hits_.clear();
  for (const Side side : {Side::A, Side::B}) {
    const Vector3d origin = inBody(side, from);
    const Vector3d along = side == Side::A ? direction : Vector3d(frame_->rotation.transpose() * direction);
    const ShearedRay ray(origin, along);
    const double longest_part = along.cwiseAbs().maxCoeff();
    const SurfaceMesh& mesh = body(side).surface();
    visitLeaves(body(side).tree(), SlabTest(origin, along, 4.0 * mesh.diameter()), [&](TriangleIndex t) {
      if (body(side).shellContacts().isHidden(t)) return false;
      const ShearedRay::Meeting met = ray.meeting(cornersOf(mesh, t));
      if (met.side == 0 || !(met.height > 0.0)) return false;
      ray_hits_.push_back({met.height / (met.weight * longest_part), side, t});
      return false;
    });
  }
  std::sort(ray_hits_.begin(), ray_hits_.end(), [](const RayHit& l, const RayHit& r) {
    return std::tie(l.at, l.side, l.triangle) < std::tie(r.at, r.side, r.triangle);
  });
  const auto element_at = [&](const RayHit& hit) {
    const TriangleIndex facet = facets(hit.side).facet_of_triangle[hit.triangle.value];
    return elementAt(hit.side, facet, from + hit.at * direction);
  };
  double reached = 0.0;
  const RayHit* last = nullptr;
  for (const RayHit& hit : ray_hits_) {
    if (limit_->isOverNow()) return false;
    const Vector3d middle = from + 0.5 * (reached + hit.at) * direction;
    if (hit.at - reached > kLeastGap * tolerance_ && holds(Side::A, middle) && holds(Side::B, middle)) {
      const std::uint32_t before = last == nullptr ? pair : element_at(*last);
      unite(before, element_at(hit));
    }
    reached = hit.at;
    last = &hit;
  }
  return true;
}

bool OverlapSets::holds(Side of, const Vector3d& point) const {
  const MeshTopology& topology = body(of).topology();
  return containsPoint(body(of).tree(), body(of).surface(), topology.shell_is_closed,
                       topology.shell_of_triangle, inBody(of, point));
}

}  // namespace concave_distance::detail
