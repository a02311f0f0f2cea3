#include "minimum_slacks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Kind = NormalConeTree::Kind;

/// Sine of the angle between two edges from which on a minimum between them has a slack.
constexpr double kCrossed = 4e-3;

}  // namespace

bool MinimumSlacks::offer(const Item& a, const Item& b, const MinimumCandidate& minimum,
                          SlackOffers& offers) const {
  const FeatureBody body_a(pairs_.frame(), Side::A);
  const FeatureBody body_b(pairs_.frame(), Side::B);
  const Vector3d displacement = minimum.point_b - minimum.point_a;
  if (a.kind == Kind::Edge && b.kind == Kind::Edge) {
    offerOfEdges(body_a, a, body_b, b, displacement, offers);
  } else if (b.kind == Kind::Vertex) {
    offerOfVertex(body_b, b, body_a, a, -displacement, offers);
  } else {
    offerOfVertex(body_a, a, body_b, b, body_b.directionFromOther(displacement), offers);
  }
  return !offers.empty();
}

// While nothing around an end of the displacement falls by less than this along it, per length, that end
// stays a peak. What is as high as the end may rise at once.
double MinimumSlacks::fallAround(const FeatureBody& body, const Item& item,
                                 const Vector3d& displacement) const {
  if (item.kind == Kind::Face) return std::numeric_limits<double>::infinity();
  const Vector3d from = body.corner(item, item.element);
  const double level = 2.0 * pairs_.level();
  const double slack = level * displacement.norm();
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](NodeIndex node) {
    const Vector3d edge = body.vertex(node) - from;
    least = std::min(least, (-displacement.dot(edge) - slack) / (edge.norm() + level));
  };
  if (item.kind == Kind::Vertex) {
    body.forEachNeighbour(body.node(item, item.element), look);
    return least;
  }
  const NodeIndex begin = body.node(item, item.element);
  const NodeIndex end = body.node(item, item.element + 1U);
  body.forEachApex(begin, end, look);
  return least;
}

// From the vertex to the other body's closest point, in that body's axes, the displacement changes by no more
// than the vertex moves; in the vertex's own axes it turns besides. It may double.
void MinimumSlacks::offerOfVertex(const FeatureBody& of_vertex, const Item& vertex,
                                  const FeatureBody& of_other, const Item& other, const Vector3d& to_other,
                                  SlackOffers& offers) const {
  const double distance = to_other.norm();
  double metres = std::min(distance - pairs_.slack(), pairs_.cutoff() - distance - 2.0 * pairs_.slack());
  metres = std::min(metres, fallAround(of_vertex, vertex, of_vertex.directionFromOther(to_other)));
  metres = std::min(metres, fallAround(of_other, other, -to_other));
  const Vector3d point = of_vertex.inOther(of_vertex.corner(vertex, vertex.element));
  if (other.kind == Kind::Edge) {
    const Vector3d from = of_other.corner(other, other.element);
    const Vector3d span = of_other.corner(other, other.element + 1U) - from;
    const double length = span.norm();
    const double position = span.dot(point - from) / length;
    metres = std::min({metres, position - 2.0 * pairs_.slack(), length - position - 2.0 * pairs_.slack()});
  } else if (other.kind == Kind::Face) {
    if (other.cap.isFull()) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d from = of_other.corner(other, k);
      const Vector3d along = (of_other.corner(other, k + 1) - from).normalized();
      Vector3d inward = of_other.corner(other, k + 2) - from;
      inward -= along.dot(inward) * along;
      metres = std::min(metres, inward.normalized().dot(point - from) - 2.0 * pairs_.slack());
    }
  }
  offers.offerMotion(of_vertex.side, metres, 2.0 * distance);
}

// The direction across both edges turns by no more than 2 / sine times the bodies' turn, as seen from A, and
// by that turn more as seen from B, while the turn is below sine / 2.
void MinimumSlacks::offerOfEdges(const FeatureBody& body_a, const Item& a, const FeatureBody& body_b,
                                 const Item& b, const Vector3d& displacement, SlackOffers& offers) const {
  const Vector3d from_a = body_a.corner(a, a.element);
  const Vector3d from_b = body_b.inOther(body_b.corner(b, b.element));
  const Vector3d span_a = body_a.edgeInFrame(a);
  const Vector3d span_b = body_b.edgeInFrame(b);
  const double lengths = span_a.norm() * span_b.norm();
  Vector3d across = span_a.cross(span_b);
  const double sine = across.norm() / lengths;
  if (!(sine > kCrossed)) return;
  across.normalize();
  const Vector3d between = from_b - from_a;
  const double distance = displacement.norm();
  const double reach = std::max({between.norm(), (between + span_b).norm(), (span_a - between).norm()});
  double metres =
      std::min({distance - pairs_.slack(), pairs_.cutoff() - distance - 2.0 * pairs_.slack(), reach});
  // Each edge's ends are on both sides of the other, seen along the direction across.
  const auto part = [&](const Vector3d& from, const Vector3d& to, const Vector3d& normal) {
    const double first = normal.dot(from);
    const double last = normal.dot(to);
    metres = std::min(metres, first * last < 0.0 ? std::min(std::abs(first), std::abs(last)) : 0.0);
  };
  part(between, between + span_b, span_a.normalized().cross(across));
  part(-between, span_a - between, span_b.normalized().cross(across));
  metres -= 4.0 * pairs_.slack() / sine;
  // Per unit of the displacement, falls are radians that it may turn by.
  const double fall = std::min(fallAround(body_a, a, displacement),
                               fallAround(body_b, b, body_b.directionFromOther(-displacement)));
  metres = std::min(metres, reach * fall / distance);
  offers.offerMotion(Side::B, metres, b.radius + (1.0 + 2.0 / sine) * (reach + metres));
}

}  // namespace concave_distance::detail
