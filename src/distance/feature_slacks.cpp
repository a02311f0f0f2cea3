#include <algorithm>
#include <cmath>

#include "feature_pairs.h"

// How far bodies may move until a pair of features can hold a local minimum (doc/algorithm.md, section 7).

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

}  // namespace

/// One body in its own axes, relative to its centre in the scene.
struct FeaturePairs::Body {
  Body(const MinimaScene& scene, Side of)
      : side(of),
        mesh(of == Side::A ? scene.a : scene.b),
        centre(of == Side::A ? scene.frames.centre_a : scene.frames.centre_b),
        frames(scene.frames) {}

  Vector3d vertex(NodeIndex node) const { return mesh.surface().vertex(node) - centre; }
  Vector3d corner(const Item& item, std::size_t k) const {
    return mesh.surface().corner(item.triangle, static_cast<int>(k % 3)) - centre;
  }
  NodeIndex node(const Item& item, std::size_t k) const {
    return mesh.surface().triangle(item.triangle)[k % 3];
  }

  /// A point of this body in the other's axes, and a direction of the other body in this one's.
  Vector3d inOther(const Vector3d& point) const {
    return side == Side::A ? frames.pointInB(point) : Vector3d(frames.rotation * point + frames.offset);
  }
  Vector3d directionFromOther(const Vector3d& direction) const {
    return side == Side::A ? Vector3d(frames.rotation * direction)
                           : Vector3d(frames.rotation.transpose() * direction);
  }

  /// How far, at most, a neighbour of the vertex rises along `displacement`, per length of its edge; what is
  /// within rounding does not count.
  double rise(NodeIndex node, const Vector3d& displacement, double slack) const {
    const Vector3d here = vertex(node);
    const double reach = displacement.norm();
    double most = 0.0;
    for (const NodeIndex neighbour : mesh.topology().neighbours_of_vertex.row(node.value)) {
      const Vector3d edge = vertex(neighbour) - here;
      const double length = edge.norm();
      most = std::max(most, (displacement.dot(edge) - 2.0 * slack * std::max(length, reach)) / length);
    }
    return most;
  }

  Side side;
  const BodyMesh& mesh;
  const Vector3d& centre;
  const LocalFrames& frames;
};

void FeaturePairs::offerSlacks(const Item& a, const Item& b, SlackOffers& offers) const {
  const Body body_a(scene_, Side::A);
  const Body body_b(scene_, Side::B);
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
void FeaturePairs::offerVertexToVertex(const Item& a, const Item& b, SlackOffers& offers) const {
  const Body body_a(scene_, Side::A);
  const Body body_b(scene_, Side::B);
  const Vector3d displacement = body_b.inOther(body_b.corner(b, b.element)) - body_a.corner(a, a.element);
  offers.offerMotion(Side::B, body_a.rise(body_a.node(a, a.element), displacement, slack_));
  offers.offerMotion(
      Side::A, body_b.rise(body_b.node(b, b.element), body_b.directionFromOther(-displacement), slack_));
  const double beyond = displacement.norm() - cutoff_;
  offers.offerMotion(Side::A, beyond);
  offers.offerMotion(Side::B, beyond);
}

void FeaturePairs::offerVertexToEdge(const Body& of_vertex, const Item& vertex, const Body& of_edge,
                                     const Item& edge, SlackOffers& offers) const {
  const Side side = of_vertex.side;
  const Vector3d point = of_vertex.inOther(of_vertex.corner(vertex, vertex.element));
  const Vector3d from = of_edge.corner(edge, edge.element);
  const Vector3d span = of_edge.corner(edge, edge.element + 1U) - from;
  const double length = span.norm();
  const Vector3d along = span / length;
  const Vector3d displacement = point - from;
  const double position = along.dot(displacement);
  // Beyond an end, that vertex is closer; in front of a face of the edge, the face is.
  offers.offerMotion(side, std::max(-position, position - length) - slack_);
  const auto offer_face = [&](TriangleIndex triangle) {
    const SurfaceMesh& surface = of_edge.mesh.surface();
    const TriangleNodes& nodes = surface.triangle(triangle);
    const NodeIndex begin = of_edge.node(edge, edge.element);
    const NodeIndex end = of_edge.node(edge, edge.element + 1U);
    for (const NodeIndex apex : nodes) {
      if (apex == begin || apex == end) continue;
      Vector3d inward = of_edge.vertex(apex) - from;
      inward -= along.dot(inward) * along;
      const double height = inward.norm();
      offers.offerMotion(
          side, (displacement.dot(inward) - 2.0 * slack_ * std::max(height, displacement.norm())) / height);
    }
  };
  offer_face(edge.triangle);
  const TriangleIndex across =
      of_edge.mesh.topology().triangle_across_edge[edge.triangle.value][edge.element];
  if (across != kNoTriangle) offer_face(across);
  // The way to the foot turns with the bodies and moves with the foot.
  const Vector3d to_foot = position * along - displacement;
  const double rise =
      of_vertex.rise(of_vertex.node(vertex, vertex.element), of_vertex.directionFromOther(to_foot), slack_);
  const double distance = to_foot.norm();
  offers.offerMotion(side, rise, distance);
  offers.offerMotion(side, distance - cutoff_);
}

void FeaturePairs::offerVertexToFace(const Body& of_vertex, const Item& vertex, const Body& of_face,
                                     const Item& face, SlackOffers& offers) const {
  if (face.cap.isFull()) return;
  const Side side = of_vertex.side;
  const Vector3d point = of_vertex.inOther(of_vertex.corner(vertex, vertex.element));
  const Vector3d& normal = face.cap.axis;
  const double height = normal.dot(point - of_face.corner(face, 0));
  // Behind the face, or beside it, it is not closest; what rises along its normal is closer than the vertex.
  double outside = -height;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d from = of_face.corner(face, k);
    const Vector3d along = (of_face.corner(face, k + 1) - from).normalized();
    Vector3d outward = from - of_face.corner(face, k + 2);
    outward -= along.dot(outward) * along;
    outside = std::max(outside, outward.normalized().dot(point - from));
  }
  offers.offerMotion(side, outside - 2.0 * slack_);
  offers.offerMotion(side, height - cutoff_);
  const double rise =
      of_vertex.rise(of_vertex.node(vertex, vertex.element), of_vertex.directionFromOther(-normal), slack_);
  offers.offerTurn(rise - face.cap.sine);
}

// A minimum inside both edges lies along the direction across them, which must be in the arc of normals of
// each.
void FeaturePairs::offerEdgeToEdge(const Item& a, const Item& b, SlackOffers& offers) const {
  const Body body_a(scene_, Side::A);
  const Body body_b(scene_, Side::B);
  const Vector3d from_a = body_a.corner(a, a.element);
  const Vector3d from_b = body_b.inOther(body_b.corner(b, b.element));
  const Vector3d span_a = edgeOfA(a);
  const Vector3d span_b = edgeOfB(b);
  const double beyond =
      std::sqrt(betweenSegments(from_a, from_a + span_a, from_b, from_b + span_b).squared_distance) - cutoff_;
  offers.offerMotion(Side::B, beyond, b.radius);

  struct Arc {
    Vector3d first;
    Vector3d last;
    Vector3d across;
    double width = 0.0;  ///< length of `across`
  };
  const auto arc_of = [](const Body& body, const Item& item, Arc& arc) {
    const MeshTopology& topology = body.mesh.topology();
    const TriangleIndex beyond_edge = topology.triangle_across_edge[item.triangle.value][item.element];
    if (beyond_edge == kNoTriangle || item.cap.isFull()) return false;
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
  for (Vector3d* normal : {&arc_b.first, &arc_b.last}) *normal = -(scene_.frames.rotation * *normal);
  arc_b.across = scene_.frames.rotation * arc_b.across;
  const auto parted = [](const Arc& circle, const Arc& arc) {
    if (!(circle.width > kShortArc)) return 0.0;
    const double first = circle.across.dot(arc.first);
    const double last = circle.across.dot(arc.last);
    return first * last > 0.0 ? std::min(std::abs(first), std::abs(last)) / circle.width : 0.0;
  };
  offers.offerTurn(std::max(parted(arc_a, arc_b), parted(arc_b, arc_a)) - kNormalSlack);

  const double length_a = span_a.norm();
  const double length_b = span_b.norm();
  Vector3d across = span_a.cross(span_b);
  const double sine = across.norm() / (length_a * length_b);
  if (!(sine > kNearlyParallel)) return;
  across.normalize();
  const Vector3d middle = (arc_a.first + arc_a.last).normalized();
  if (across.dot(middle) < 0.0) across = -across;
  const double rounding = 4.0 * slack_ / sine;
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
