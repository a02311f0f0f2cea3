#include "feature_pairs.h"

#include <algorithm>
#include <cmath>

#include "mesh/surface/triangle_adjacency.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Kind = NormalConeTree::Kind;
using Item = NormalConeTree::Item;

/// Radians that the direction between two features may be off before its cone is asked, besides rounding.
constexpr double kDirectionSlack = 1e-6;

double unitClamp(double x) {
  return x < 0.0 ? 0.0 : (x > 1.0 ? 1.0 : x);
}

Vector3d closestOnSegment(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d edge = to - from;
  const double squared_length = edge.squaredNorm();
  return squared_length > 0.0 ? Vector3d(from + unitClamp(edge.dot(point - from) / squared_length) * edge)
                              : from;
}

}  // namespace

/// A cap's axis in the scene's frame.
struct FeaturePairs::FacingCap {
  Vector3d axis;
  double cosine;
  double sine;

  /// Whether `direction` (of length `length`) lies in it, or may within a turn.
  bool holds(const Vector3d& direction, double length, double turn_cosine, double turn_sine) const {
    const double sine_of_sum = turn_sine * cosine + turn_cosine * sine;
    return sine_of_sum <= 0.0 ||
           direction.dot(axis) >= (turn_cosine * cosine - turn_sine * sine - 1e-14) * length;
  }
};

FeaturePairs::FeaturePairs(const MinimaScene& scene, double cutoff)
    : scene_(scene),
      // Spheres and distances carry the rounding of the scene.
      slack_(4.0 * scene.rounding),
      cutoff_(cutoff + slack_) {}

FeaturePairs::Between FeaturePairs::between(const Vector3d& from, const Vector3d& to) {
  const Vector3d displacement = to - from;
  return {from, to, displacement, displacement.squaredNorm()};
}

/// Two segments, as in the triangle kernel: parallel ones may give any of their closest pairs.
FeaturePairs::Between FeaturePairs::betweenSegments(const Vector3d& a0, const Vector3d& a1,
                                                    const Vector3d& b0, const Vector3d& b1) {
  const Vector3d u = a1 - a0;
  const Vector3d v = b1 - b0;
  const Vector3d n = u.cross(v);
  const double nn = n.squaredNorm();
  const double s = nn > 0.0 ? unitClamp((b0 - a0).cross(v).dot(n) / nn) : 0.0;
  const Vector3d on_b = closestOnSegment(a0 + s * u, b0, b1);
  return between(closestOnSegment(on_b, a0, a1), on_b);
}

std::optional<double> FeaturePairs::findMinimum(const Item& a, const Item& b) const {
  const FacingCap cap_a{a.cap.axis, a.cap.cosine, a.cap.sine};
  const FacingCap cap_b{-(scene_.frames.rotation * b.cap.axis), b.cap.cosine, b.cap.sine};
  if (a.kind == Kind::Edge && b.kind == Kind::Edge && !edgesMayFace(a, b, cap_a, cap_b)) return std::nullopt;
  const Between found = closest(a, b);
  if (found.squared_distance > cutoff_ * cutoff_) return std::nullopt;
  const double distance = std::sqrt(found.squared_distance);
  if (distance <= slack_) return std::nullopt;  // meeting triangles are collected apart
  const double turn = std::min(0.5, kDirectionSlack + slack_ / distance);
  const double turn_cosine = 1.0 - 0.5 * turn * turn;
  if (!cap_a.holds(found.displacement, distance, turn_cosine, turn) ||
      !cap_b.holds(found.displacement, distance, turn_cosine, turn)) {
    return std::nullopt;
  }
  if (!isPeak(scene_.a, a, found.from, found.displacement / distance, distance,
              [this](NodeIndex n) { return scene_.vertexOfA(n); }) ||
      !isPeak(scene_.b, b, found.to, -found.displacement / distance, distance,
              [this](NodeIndex n) { return scene_.vertexOfB(n); })) {
    return std::nullopt;
  }
  return distance;
}

/// Two edges at an angle are closest along the direction across both: whether that lies in the caps of
/// both needs no closest points.
bool FeaturePairs::edgesMayFace(const Item& a, const Item& b, const FacingCap& cap_a,
                                const FacingCap& cap_b) const {
  const Vector3d along_a = edgeOfA(a);
  const Vector3d along_b = edgeOfB(b);
  const Vector3d across = along_a.cross(along_b);
  const double length = across.norm();
  const double lengths = std::sqrt(along_a.squaredNorm() * along_b.squaredNorm());
  if (!(length > kNearlyParallel * lengths)) return true;
  constexpr double kTurnCosine = 1.0 - 0.5 * kDirectionSlack * kDirectionSlack;
  const auto both_hold = [&](const Vector3d& direction) {
    return cap_a.holds(direction, length, kTurnCosine, kDirectionSlack) &&
           cap_b.holds(direction, length, kTurnCosine, kDirectionSlack);
  };
  return both_hold(across) || both_hold(-across);
}

/// Whether no vertex next to the feature rises towards the other body by more than rounding: the normal
/// cone itself, which the cap is around. Points are off by less than the slack, the direction between them
/// by that over their distance.
template <typename VertexOf>
bool FeaturePairs::isPeak(const BodyMesh& body, const Item& item, const Vector3d& point,
                          const Vector3d& direction, double distance, const VertexOf& vertex_of) const {
  const auto rises = [&](NodeIndex node) {
    const Vector3d displacement = vertex_of(node) - point;
    const double over = direction.dot(displacement) - slack_;
    const double turn = slack_ / distance;
    return over > 0.0 && over * over > turn * turn * displacement.squaredNorm();
  };
  const TriangleNodes& nodes = body.surface().triangle(item.triangle);
  // The end of an edge counts with all that is around it.
  for (const NodeIndex node : nodes) {
    if ((vertex_of(node) - point).squaredNorm() > slack_ * slack_) continue;
    const auto around = body.topology().neighbours_of_vertex.row(node.value);
    return std::none_of(around.begin(), around.end(), rises);
  }
  if (std::any_of(nodes.begin(), nodes.end(), rises)) return false;
  if (item.kind == Kind::Face) return true;
  const NodeIndex from = nodes[item.element];
  const NodeIndex to = nodes[(item.element + 1U) % 3];
  for (const AdjacentTriangle& next : body.adjacency().row(item.triangle.value)) {
    if (next.from != from || next.to != to) continue;
    const TriangleNodes& beyond = body.surface().triangle(next.triangle);
    if (std::any_of(beyond.begin(), beyond.end(), rises)) return false;
  }
  return true;
}

namespace {

Vector3d edgeOf(const SurfaceMesh& mesh, const Item& item) {
  return mesh.corner(item.triangle, (item.element + 1) % 3) - mesh.corner(item.triangle, item.element);
}

}  // namespace

Vector3d FeaturePairs::edgeOfA(const Item& item) const {
  return edgeOf(scene_.a.surface(), item);
}

Vector3d FeaturePairs::edgeOfB(const Item& item) const {
  return scene_.frames.rotation * edgeOf(scene_.b.surface(), item);
}

FeaturePairs::Between FeaturePairs::closest(const Item& a, const Item& b) const {
  const TrianglePoints ta = scene_.cornersOfA(a.triangle);
  const TrianglePoints tb = scene_.cornersOfB(b.triangle);
  const Vector3d& a0 = ta[a.element];
  const Vector3d& b0 = tb[b.element];
  const auto next_of = [](const TrianglePoints& t, std::size_t k) -> const Vector3d& {
    return t[k == 2 ? 0 : k + 1];
  };
  if (a.kind == Kind::Vertex) {
    if (b.kind == Kind::Vertex) return between(a0, b0);
    if (b.kind == Kind::Edge) return between(a0, closestOnSegment(a0, b0, next_of(tb, b.element)));
    return between(a0, pointTriangleDistance(a0, tb).point);
  }
  if (b.kind == Kind::Vertex) {
    if (a.kind == Kind::Edge) return between(closestOnSegment(b0, a0, next_of(ta, a.element)), b0);
    return between(pointTriangleDistance(b0, ta).point, b0);
  }
  return betweenSegments(a0, next_of(ta, a.element), b0, next_of(tb, b.element));
}

}  // namespace concave_distance::detail
