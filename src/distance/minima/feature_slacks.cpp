#include "feature_slacks.h"

#include <algorithm>
#include <cmath>

#include "mesh/trees/normal_cone.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Kind = NormalConeTree::Kind;

/// Length of the cross product of two unit normals below which the arc between them is a point.
constexpr double kShortArc = 1e-6;
/// Radians that the normals of two arcs may be off: what the caps of features are widened by, for each.
constexpr double kNormalSlack = 4e-9;
/// Two faces whose normals are nearly opposite have no arc between them.
constexpr double kOpposite = -0.999;

/// The shorter arc between two unit vectors.
struct Arc {
  Vector3d first;
  Vector3d last;
  Vector3d across;
  double width = 0.0;  ///< length of `across`

  bool isShort() const { return !(width > kShortArc); }

  /// Radians from a unit vector, or less. An arc's chord is no longer than the arc, nor its sine.
  double gapTo(const Vector3d& direction) const {
    const double to_end =
        std::sqrt(std::min((direction - first).squaredNorm(), (direction - last).squaredNorm()));
    if (isShort()) return to_end;
    const bool is_beside =
        first.cross(direction).dot(across) >= 0.0 && direction.cross(last).dot(across) >= 0.0;
    return is_beside ? std::abs(across.dot(direction)) / width : to_end;
  }
};

/// Returns whether the arcs of two circles, neither of them short, have a point in common.
bool doCross(const Arc& l, const Arc& r) {
  const double first = l.across.dot(r.first);
  const double last = l.across.dot(r.last);
  if (first * last > 0.0 || r.across.dot(l.first) * r.across.dot(l.last) > 0.0) return false;
  // Each crosses the other's circle: at one point, or at two that are opposite.
  return l.across.cross(r.across).dot(l.first + l.last) * (last - first) >= 0.0;
}

/// Radians between two arcs, or less; not above 0 where they cross.
double gapBetween(const Arc& l, const Arc& r) {
  double less = 0.0;
  for (const Arc* arc : {&l, &r}) less += arc->isShort() ? arc->width : 0.0;
  if (less == 0.0 && doCross(l, r)) return 0.0;
  return std::min({l.gapTo(r.first), l.gapTo(r.last), r.gapTo(l.first), r.gapTo(l.last)}) - less;
}

}  // namespace

void FeatureSlacks::offer(const Item& a, const Item& b, SlackOffers& offers) const {
  const FeatureBody body_a(pairs_.frame(), Side::A);
  const FeatureBody body_b(pairs_.frame(), Side::B);
  if (a.kind == Kind::Vertex) {
    if (b.kind == Kind::Vertex) return offerVertexToVertex(a, b, offers);
    if (b.kind == Kind::Edge) return offerVertexToEdge(body_a, a, body_b, b, offers);
    return offerVertexToFace(body_a, a, body_b, b, offers);
  }
  if (b.kind == Kind::Vertex) {
    if (a.kind == Kind::Edge) return offerVertexToEdge(body_b, b, body_a, a, offers);
    return offerVertexToFace(body_b, b, body_a, a, offers);
  }
  offerEdgeToEdge(a, b, offers);
}

// The displacement changes by no more than the other vertex moves; a neighbour that rises along it is closer.
void FeatureSlacks::offerVertexToVertex(const Item& a, const Item& b, SlackOffers& offers) const {
  const FeatureBody body_a(pairs_.frame(), Side::A);
  const FeatureBody body_b(pairs_.frame(), Side::B);
  const Vector3d displacement = body_b.inOther(body_b.corner(b, b.element)) - body_a.corner(a, a.element);
  offers.offerMotion(Side::B, body_a.rise(body_a.node(a, a.element), displacement, pairs_.slack()));
  offers.offerMotion(Side::A, body_b.rise(body_b.node(b, b.element), body_b.directionFromOther(-displacement),
                                          pairs_.slack()));
  const double beyond = displacement.norm() - pairs_.cutoff();
  offers.offerMotion(Side::A, beyond);
  offers.offerMotion(Side::B, beyond);
}

// Beyond an end of an edge, that vertex is closer; in front of a face of the edge, the face is.
void FeatureSlacks::offerBesideEdge(const FeatureBody& of_edge, const Item& edge, const Vector3d& first,
                                    const Vector3d& last, double radius, SlackOffers& offers) const {
  const Side side = of_edge.side == Side::A ? Side::B : Side::A;
  const Vector3d from = of_edge.corner(edge, edge.element);
  const Vector3d span = of_edge.corner(edge, edge.element + 1U) - from;
  const double length = span.norm();
  const Vector3d along = span / length;
  const Vector3d to_first = first - from;
  const Vector3d to_last = last - from;
  const double low = std::min(along.dot(to_first), along.dot(to_last));
  const double high = std::max(along.dot(to_first), along.dot(to_last));
  offers.offerMotion(side, std::max(-high, low - length) - pairs_.slack(), radius);
  const double reach = std::max(to_first.norm(), to_last.norm());
  const NodeIndex begin = of_edge.node(edge, edge.element);
  const NodeIndex end = of_edge.node(edge, edge.element + 1U);
  const auto offer_face = [&](TriangleIndex triangle) {
    for (const NodeIndex apex : of_edge.mesh.surface().triangle(triangle)) {
      if (apex == begin || apex == end) continue;
      Vector3d inward = of_edge.vertex(apex) - from;
      inward -= along.dot(inward) * along;
      const double height = inward.norm();
      const double in_front = std::min(to_first.dot(inward), to_last.dot(inward));
      offers.offerMotion(side, (in_front - 2.0 * pairs_.slack() * std::max(height, reach)) / height, radius);
    }
  };
  offer_face(edge.triangle);
  const TriangleIndex across =
      of_edge.mesh.topology().triangle_across_edge[edge.triangle.value][edge.element];
  if (across != kNoTriangle && !of_edge.mesh.shellContacts().isHidden(across)) offer_face(across);
}

void FeatureSlacks::offerVertexToEdge(const FeatureBody& of_vertex, const Item& vertex,
                                      const FeatureBody& of_edge, const Item& edge,
                                      SlackOffers& offers) const {
  const Side side = of_vertex.side;
  const Vector3d point = of_vertex.inOther(of_vertex.corner(vertex, vertex.element));
  offerBesideEdge(of_edge, edge, point, point, 0.0, offers);
  const Vector3d from = of_edge.corner(edge, edge.element);
  const Vector3d along = (of_edge.corner(edge, edge.element + 1U) - from).normalized();
  const Vector3d displacement = point - from;
  // The way to the foot turns with the bodies and moves with the foot.
  const Vector3d to_foot = along.dot(displacement) * along - displacement;
  const double rise = of_vertex.rise(of_vertex.node(vertex, vertex.element),
                                     of_vertex.directionFromOther(to_foot), pairs_.slack());
  const double distance = to_foot.norm();
  offers.offerMotion(side, rise, distance);
  offers.offerMotion(side, distance - pairs_.cutoff());
}

void FeatureSlacks::offerVertexToFace(const FeatureBody& of_vertex, const Item& vertex,
                                      const FeatureBody& of_face, const Item& face,
                                      SlackOffers& offers) const {
  if (face.cap.isFull()) return;
  const Side side = of_vertex.side;
  const Vector3d point = of_vertex.inOther(of_vertex.corner(vertex, vertex.element));
  const Vector3d& normal = face.cap.axis;
  const double height = normal.dot(point - of_face.corner(face, 0));
  // Behind the face, or beside it, it is not closest; what rises along its normal is closer than the vertex.
  double outside = -height;
  double reach = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d from = of_face.corner(face, k);
    reach = std::max(reach, (point - from).norm());
    const Vector3d along = (of_face.corner(face, k + 1) - from).normalized();
    Vector3d outward = from - of_face.corner(face, k + 2);
    outward -= along.dot(outward) * along;
    outside = std::max(outside, outward.normalized().dot(point - from));
  }
  // Directions across and along the face of a thin triangle are as uncertain as its normal.
  const double error = 2.0 * pairs_.slack() + face.cap.sine * reach;
  offers.offerMotion(side, outside - error);
  offers.offerMotion(side, height - error - pairs_.cutoff());
  const double rise = of_vertex.rise(of_vertex.node(vertex, vertex.element),
                                     of_vertex.directionFromOther(-normal), pairs_.slack());
  offers.offerTurn(rise - face.cap.sine);
}

// A minimum inside both edges lies along the direction across them, which must be in the arc of normals of
// each.
void FeatureSlacks::offerEdgeToEdge(const Item& a, const Item& b, SlackOffers& offers) const {
  const FeatureBody body_a(pairs_.frame(), Side::A);
  const FeatureBody body_b(pairs_.frame(), Side::B);
  const Vector3d from_a = body_a.corner(a, a.element);
  const Vector3d from_b = body_b.inOther(body_b.corner(b, b.element));
  const Vector3d span_a = body_a.edgeInFrame(a);
  const Vector3d span_b = body_b.edgeInFrame(b);
  const double beyond =
      std::sqrt(pairs_.squaredDistance(from_a, from_a + span_a, from_b, from_b + span_b)) - pairs_.cutoff();
  offers.offerMotion(Side::B, beyond, b.radius);
  offerBesideEdge(body_a, a, from_b, from_b + span_b, b.radius, offers);
  const Vector3d first_of_a = body_a.inOther(from_a);
  const Vector3d last_of_a = body_a.inOther(Vector3d(from_a + span_a));
  offerBesideEdge(body_b, b, first_of_a, last_of_a, a.radius, offers);

  const auto arc_of = [](const FeatureBody& body, const Item& item, Arc& arc) {
    const MeshTopology& topology = body.mesh.topology();
    const TriangleIndex beyond_edge = topology.triangle_across_edge[item.triangle.value][item.element];
    if (beyond_edge == kNoTriangle || body.mesh.shellContacts().isHidden(beyond_edge)) return false;
    const double error =
        normalError(body.mesh.surface(), item.triangle) + normalError(body.mesh.surface(), beyond_edge);
    if (!(2.0 * error < kNormalSlack)) return false;
    arc.first = topology.triangle_normals[item.triangle.value];
    arc.last = topology.triangle_normals[beyond_edge.value];
    // Sides of one winding; the other winding has the edge in the other direction.
    const TriangleNodes& nodes = body.mesh.surface().triangle(beyond_edge);
    const auto at = static_cast<std::size_t>(
        std::find(nodes.begin(), nodes.end(), body.node(item, item.element + 1U)) - nodes.begin());
    if (at == 3 || nodes[(at + 1) % 3] != body.node(item, item.element)) return false;
    if (!(arc.first.dot(arc.last) > kOpposite) || arc.first.isZero(0.0) || arc.last.isZero(0.0)) return false;
    if (item.cap.axis.dot(arc.first + arc.last) < 0.0) {
      arc.first = -arc.first;
      arc.last = -arc.last;
    }
    arc.across = arc.first.cross(arc.last);
    arc.width = arc.across.norm();
    return true;
  };
  Arc arc_a;
  Arc arc_b;
  if (!arc_of(body_a, a, arc_a) || !arc_of(body_b, b, arc_b)) return;
  for (Vector3d* normal : {&arc_b.first, &arc_b.last}) *normal = -(pairs_.frame().rotation * *normal);
  arc_b.across = pairs_.frame().rotation * arc_b.across;
  offers.offerTurn(gapBetween(arc_a, arc_b) - kNormalSlack);

  const double length_a = span_a.norm();
  const double length_b = span_b.norm();
  Vector3d across = span_a.cross(span_b);
  const double sine = across.norm() / (length_a * length_b);
  if (!(sine > kNearlyParallel)) return;
  across.normalize();
  const Vector3d middle = (arc_a.first + arc_a.last).normalized();
  if (across.dot(middle) < 0.0) across = -across;
  const double rounding = 4.0 * pairs_.slack() / sine;
  // The direction across turns by no more than 2 / sine times the bodies' turn while that is below sine / 2.
  const auto offer = [&](Side side, double radius, double metres, double reach) {
    offers.offerMotion(side, metres - rounding, radius + 2.0 * (reach + metres) / sine);
  };
  const Vector3d displacement = from_b - from_a;
  // It turns by at most 0.5 before a slack is used up: so far from the middle it may not change over to its
  // opposite.
  if (across.dot(middle) > 0.5) {
    const Vector3d to_middle = displacement + 0.5 * span_b;
    offer(Side::B, b.radius, -across.dot(to_middle), to_middle.norm());
  }
  // Seen along it, both ends of one edge on one side of the other.
  const auto one_side = [](const Vector3d& from, const Vector3d& to, const Vector3d& side_normal) {
    const double first = side_normal.dot(from);
    const double last = side_normal.dot(to);
    return first * last > 0.0 ? std::min(std::abs(first), std::abs(last)) : 0.0;
  };
  const auto reach = [](const Vector3d& from, const Vector3d& to) {
    return std::max(from.norm(), to.norm());
  };
  offer(Side::B, b.radius, one_side(displacement, displacement + span_b, (span_a / length_a).cross(across)),
        reach(displacement, displacement + span_b));
  offer(Side::A, a.radius, one_side(-displacement, span_a - displacement, (span_b / length_b).cross(across)),
        reach(-displacement, span_a - displacement));
}

}  // namespace concave_distance::detail
