#include "patch_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "base/random_engine.h"

namespace concave_distance::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// Angles closer than this to flat, or to the Delaunay condition's limit, count as there: what rounding may
/// decide is left alone, so that no edge is flipped back and forth.
constexpr double kAngleTolerance = 1e-9;

/// Flips allowed for each node; Lawson's count is far below. The last guard against endless flipping.
constexpr std::size_t kFlipsPerNode = 200;

std::uint64_t edgeKey(NodeIndex a, NodeIndex b) {
  return (std::uint64_t{std::min(a.value, b.value)} << 32U) | std::max(a.value, b.value);
}

}  // namespace

PatchTriangulation::PatchTriangulation(EditableMesh& mesh, const std::vector<PatchFrame>& frames,
                                       std::vector<TriangleIndex> original_triangle_of_node)
    : mesh_(mesh),
      frames_(frames),
      original_triangle_of_node_(std::move(original_triangle_of_node)),
      first_pending_(mesh.triangles().size(), kNone),
      flips_left_(kFlipsPerNode * mesh.triangles().size()) {}

bool PatchTriangulation::isInterior(std::size_t edge) const {
  const HalfEdge h = mesh_.edge(edge).first;
  const HalfEdge g = mesh_.next(h);
  return g != kNoHalfEdge && mesh_.next(g) == kNoHalfEdge && mesh_.tag(h / 3) == mesh_.tag(g / 3) &&
         startOf(mesh_.triangles(), h) != startOf(mesh_.triangles(), g);
}

Eigen::Vector2d PatchTriangulation::project(std::uint32_t patch, NodeIndex node) const {
  return frames_[patch].project(mesh_.vertices()[node.value]);
}

bool PatchTriangulation::shouldFlip(std::size_t edge) const {
  const HalfEdge h = mesh_.edge(edge).first;
  const HalfEdge g = mesh_.next(h);
  const std::uint32_t patch = mesh_.tag(h / 3);
  const TriangleNodes& t = mesh_.triangles()[h / 3];
  const TriangleNodes& u = mesh_.triangles()[g / 3];
  const Eigen::Vector2d a = project(patch, t[h % 3]);
  const Eigen::Vector2d b = project(patch, t[(h % 3 + 1) % 3]);
  const Eigen::Vector2d c = project(patch, t[(h % 3 + 2) % 3]);
  const Eigen::Vector2d d = project(patch, u[(g % 3 + 2) % 3]);
  const Eigen::Vector2d ca = (a - c).normalized();
  const Eigen::Vector2d cb = (b - c).normalized();
  const Eigen::Vector2d db = (b - d).normalized();
  const Eigen::Vector2d da = (a - d).normalized();
  // Delaunay: the angles opposite the edge add up to no more than half a turn.
  const double sine_of_sum = cross(ca, cb) * db.dot(da) + ca.dot(cb) * cross(db, da);
  if (sine_of_sum >= -kAngleTolerance) {
    return false;
  }
  // The quadrilateral must be convex at a and b, or the new triangles would overlap.
  const Eigen::Vector2d cd = (d - c).normalized();
  return cross(ca, cd) > kAngleTolerance && cross(cd, cb) > kAngleTolerance &&
         cross(db, -cd) > kAngleTolerance && cross(-cd, da) > kAngleTolerance &&
         !areJoined(t[(h % 3 + 2) % 3], u[(g % 3 + 2) % 3]);
}

void PatchTriangulation::rememberEdges() {
  remembered_nodes_ = mesh_.vertices().size();
  for (std::size_t e = 0; e < mesh_.edgeCount(); ++e) {
    remembered_edges_.push_back(edgeKey(mesh_.edge(e).a, mesh_.edge(e).b));
  }
  std::sort(remembered_edges_.begin(), remembered_edges_.end());
}

/// An edge that has been flipped away still counts: Delaunay flips never bring one back.
bool PatchTriangulation::areJoined(NodeIndex c, NodeIndex d) const {
  return c.value < remembered_nodes_ && d.value < remembered_nodes_ &&
         (std::binary_search(remembered_edges_.begin(), remembered_edges_.end(), edgeKey(c, d)) ||
          added_edges_.count(edgeKey(c, d)) != 0);
}

void PatchTriangulation::legalise(std::vector<std::uint32_t>& edges, std::vector<std::uint32_t>& changed) {
  while (!edges.empty()) {
    const std::uint32_t edge = edges.back();
    edges.pop_back();
    if (!isInterior(edge) || flips_left_ == 0 || !shouldFlip(edge)) {
      continue;
    }
    --flips_left_;
    const std::uint32_t t = mesh_.edge(edge).first / 3;
    const std::uint32_t u = mesh_.next(mesh_.edge(edge).first) / 3;
    mesh_.flip(edge);
    const EditableMesh::Edge& flipped = mesh_.edge(edge);
    if (flipped.a.value < remembered_nodes_ && flipped.b.value < remembered_nodes_) {
      added_edges_.insert(edgeKey(flipped.a, flipped.b));
    }
    changed.push_back(edge);
    if (first_pending_[t] != kNone || first_pending_[u] != kNone) {
      redistribute({t, u});
    }
    for (const std::uint32_t triangle : {t, u}) {
      for (HalfEdge h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        if (mesh_.edgeOf(h) != edge) {
          edges.push_back(mesh_.edgeOf(h));
        }
      }
    }
  }
}

void PatchTriangulation::splitEdge(std::size_t edge, const GridPoint& point) {
  touched_.clear();
  for (HalfEdge h = mesh_.edge(edge).first; h != kNoHalfEdge; h = mesh_.next(h)) {
    touched_.push_back(h / 3);
  }
  const auto before = static_cast<std::uint32_t>(mesh_.triangles().size());
  mesh_.split(edge, point.position);
  original_triangle_of_node_.push_back(point.original_triangle);
  for (auto t = before; t < mesh_.triangles().size(); ++t) {
    touched_.push_back(t);
  }
  first_pending_.resize(mesh_.triangles().size(), kNone);
  flips_left_ += kFlipsPerNode;
  redistribute(touched_);
}

void PatchTriangulation::appendTouchedEdges(std::vector<std::uint32_t>& edges) const {
  for (const std::uint32_t t : touched_) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      edges.push_back(mesh_.edgeOf(h));
    }
  }
}

void PatchTriangulation::addPending(std::uint32_t triangle, const GridPoint& point) {
  pending_.push_back({point, triangle, kNone, false});
  notePending(triangle, static_cast<std::uint32_t>(pending_.size() - 1));
}

void PatchTriangulation::notePending(std::uint32_t triangle, std::uint32_t pending) {
  pending_[pending].triangle = triangle;
  pending_[pending].following = first_pending_[triangle];
  first_pending_[triangle] = pending;
}

PlaneTriangle PatchTriangulation::project(std::uint32_t triangle) const {
  const TriangleNodes& nodes = mesh_.triangles()[triangle];
  const std::uint32_t patch = mesh_.tag(triangle);
  return {project(patch, nodes[0]), project(patch, nodes[1]), project(patch, nodes[2])};
}

void PatchTriangulation::redistribute(const std::vector<std::uint32_t>& triangles) {
  moved_.clear();
  for (const std::uint32_t t : triangles) {
    for (std::uint32_t i = first_pending_[t]; i != kNone; i = pending_[i].following) {
      if (!pending_[i].done) {
        moved_.push_back(i);
      }
    }
    first_pending_[t] = kNone;
  }
  for (const std::uint32_t i : moved_) {
    double best = -std::numeric_limits<double>::infinity();
    std::uint32_t home = triangles.front();
    for (const std::uint32_t t : triangles) {
      const Eigen::Vector2d place = frames_[mesh_.tag(t)].project(pending_[i].point.position);
      const double height = leastHeight(project(t), place).value;
      if (height > best) {
        best = height;
        home = t;
      }
    }
    notePending(home, i);
  }
}

void PatchTriangulation::insertPoint(std::uint32_t triangle, const GridPoint& point) {
  const Eigen::Vector2d place = frames_[mesh_.tag(triangle)].project(point.position);
  const Height height = leastHeight(project(triangle), place);
  const std::uint32_t edge = mesh_.edgeOf(3 * triangle + height.edge);
  constexpr double kOnEdge = 1e-6;
  if (height.value < kOnEdge * std::sqrt(mesh_.squaredLength(edge))) {
    if (!isInterior(edge)) {
      return;
    }
    splitEdge(edge, point);
  } else {
    const auto before = static_cast<std::uint32_t>(mesh_.triangles().size());
    mesh_.insert(triangle, point.position);
    original_triangle_of_node_.push_back(point.original_triangle);
    first_pending_.resize(mesh_.triangles().size(), kNone);
    flips_left_ += kFlipsPerNode;
    touched_ = {triangle, before, before + 1};
    redistribute(touched_);
  }
  appendTouchedEdges(stack_);
  legalise(stack_, ignored_);
  ignored_.clear();
}

void PatchTriangulation::insertPending(double least_distance) {
  std::vector<std::uint32_t> order(pending_.size());
  std::iota(order.begin(), order.end(), 0U);
  RandomEngine engine(order.size());
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[uniformIndex(engine, static_cast<std::uint32_t>(i))]);
  }
  const double least_squared = least_distance * least_distance;
  for (const std::uint32_t i : order) {
    pending_[i].done = true;
    const GridPoint& point = pending_[i].point;
    const TriangleNodes& nodes = mesh_.triangles()[pending_[i].triangle];
    const bool crowded = std::any_of(nodes.begin(), nodes.end(), [&](NodeIndex node) {
      return (mesh_.vertices()[node.value] - point.position).squaredNorm() < least_squared;
    });
    if (!crowded) {
      insertPoint(pending_[i].triangle, point);
    }
  }
  pending_.clear();
  std::fill(first_pending_.begin(), first_pending_.end(), kNone);
}

}  // namespace concave_distance::detail
