#include "feature_pairs.h"

#include <algorithm>
#include <cmath>

#include "distance/kernels/prepared_triangle.h"
#include "feature_body.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Kind = NormalConeTree::Kind;
using Item = NormalConeTree::Item;

/// Radians that the direction between two features may be off before its cone is asked, besides rounding.
constexpr double kDirectionSlack = 1e-6;
/// Heights that differ by less, relative to the bodies' size, are looked at as equal: more than what extents
/// are measured with.
constexpr double kLevelTolerance = 1.5e-9;
/// Sine of the angle between edges below which they may share more than a point.
constexpr double kMayBeParallel = 1e-3;

struct Foot {
  Vector3d point;
  bool is_beyond;
};

/// @param error metres that the foot may be off by
Foot footOnSegment(const Vector3d& point, const Vector3d& from, const Vector3d& to, double error) {
  const Vector3d edge = to - from;
  const double squared_length = edge.squaredNorm();
  if (!(squared_length > 0.0)) return {from, true};
  const double share = edge.dot(point - from) / squared_length;
  const double beyond = std::max(-share, share - 1.0);
  return {from + std::clamp(share, 0.0, 1.0) * edge,
          beyond > 0.0 && beyond * beyond * squared_length > error * error};
}

/// @param angle radians that the face's normal may be off by
Foot footOnFace(const Vector3d& point, const TrianglePoints& corners, double error, double angle) {
  const PreparedTriangle triangle(corners);
  const FaceFrame face(triangle);
  Vector3d foot;
  if (!face.flat() && face.isOver(point, foot)) return {foot, false};
  const PointTriangleDistance closest = pointTriangleDistance(point, corners);
  if (face.flat()) return {closest.point, false};
  const double gap = std::sqrt(closest.squared_distance);
  return {closest.point, face.distanceBeside(point, triangle) > error + angle * gap};
}

/// Radians that the normal of a face may be off by.
double normalErrorOf(const Item& face) {
  return face.cap.isFull() ? 0.5 : face.cap.sine;
}

NodeIndex nodeOf(const BodyMesh& body, const Item& item, std::size_t k) {
  return body.surface().triangle(item.triangle)[k % 3];
}

}  // namespace

/// A cap's axis in the frame's frame.
struct FeaturePairs::FacingCap {
  Vector3d axis;
  double cosine;
  double sine;

  /// Returns whether `direction` (of length `length`) lies in it, or may within a turn.
  bool holds(const Vector3d& direction, double length, double turn_cosine, double turn_sine) const {
    const double sine_of_sum = turn_sine * cosine + turn_cosine * sine;
    return sine_of_sum <= 0.0 ||
           direction.dot(axis) >= (turn_cosine * cosine - turn_sine * sine - 1e-14) * length;
  }
};

FeaturePairs::FeaturePairs(const PairFrame& frame, double cutoff)
    : frame_(frame),
      // Spheres and distances carry the rounding of the frame.
      slack_(4.0 * frame.rounding),
      level_(kLevelTolerance * (frame.a.diameter() + frame.b.diameter()) + 2.0 * slack_),
      cutoff_(cutoff + slack_) {}

FeaturePairs::Between FeaturePairs::between(const Vector3d& from, const Vector3d& to, bool is_beyond,
                                            double direction_error) {
  const Vector3d displacement = to - from;
  return {from, to, displacement, displacement.squaredNorm(), is_beyond, direction_error};
}

/// Two segments, as in the triangle kernel: parallel ones may give any of their closest pairs.
FeaturePairs::Between FeaturePairs::betweenSegments(const Vector3d& a0, const Vector3d& a1,
                                                    const Vector3d& b0, const Vector3d& b1) const {
  const Vector3d u = a1 - a0;
  const Vector3d v = b1 - b0;
  const Vector3d n = u.cross(v);
  const double nn = n.squaredNorm();
  const double s = nn > 0.0 ? std::clamp((b0 - a0).cross(v).dot(n) / nn, 0.0, 1.0) : 0.0;
  const Foot on_b = footOnSegment(a0 + s * u, b0, b1, slack_);
  const Foot on_a = footOnSegment(on_b.point, a0, a1, slack_);
  return between(on_a.point, on_b.point, on_a.is_beyond || on_b.is_beyond);
}

std::optional<MinimumCandidate> FeaturePairs::findMinimum(const Item& a, const Item& b) const {
  const FacingCap cap_a{a.cap.axis, a.cap.cosine, a.cap.sine};
  const FacingCap cap_b{-(frame_.rotation * b.cap.axis), b.cap.cosine, b.cap.sine};
  if (a.kind == Kind::Edge && b.kind == Kind::Edge && !edgesMayFace(a, b, cap_a, cap_b)) return std::nullopt;
  const Between found = closest(a, b);
  if (found.is_beyond || found.squared_distance > cutoff_ * cutoff_) return std::nullopt;
  const double distance = std::sqrt(found.squared_distance);
  if (distance <= slack_) return std::nullopt;  // meeting triangles are collected apart
  const double turn = found.direction_error + 2.0 * slack_ / distance;
  const double cap_turn = std::min(0.5, kDirectionSlack + turn);
  const double cap_turn_cosine = 1.0 - 0.5 * cap_turn * cap_turn;
  if (!cap_a.holds(found.displacement, distance, cap_turn_cosine, cap_turn) ||
      !cap_b.holds(found.displacement, distance, cap_turn_cosine, cap_turn)) {
    return std::nullopt;
  }
  const Vector3d direction = found.displacement / distance;
  const Peak peak_a = peakAt(Side::A, a, found.from, direction, turn);
  if (!peak_a.is_peak) return std::nullopt;
  const Peak peak_b =
      peakAt(Side::B, b, frame_.pointInB(found.to), frame_.rotation.transpose() * -direction, turn);
  if (!peak_b.is_peak) return std::nullopt;
  const auto edges_cross = [&] {
    const Vector3d along_a = FeatureBody(frame_, Side::A).edgeInFrame(a);
    const Vector3d along_b = FeatureBody(frame_, Side::B).edgeInFrame(b);
    return along_a.cross(along_b).squaredNorm() >
           kMayBeParallel * kMayBeParallel * along_a.squaredNorm() * along_b.squaredNorm();
  };
  const bool is_point = peak_a.level_dimensions == 0 || peak_b.level_dimensions == 0 ||
                        (peak_a.level_dimensions == 1 && peak_b.level_dimensions == 1 && edges_cross());
  return MinimumCandidate{a.triangle,     b.triangle,     distance,   true,    is_point,
                          peak_a.feature, peak_b.feature, found.from, found.to};
}

MinimumCandidate FeaturePairs::moved(const Item& a, const Item& b, const MinimumCandidate& minimum) const {
  const Between found = closest(a, b);
  MinimumCandidate candidate = minimum;
  candidate.distance = std::sqrt(found.squared_distance);
  candidate.point_a = found.from;
  candidate.point_b = found.to;
  return candidate;
}

/// Two edges at an angle are closest along the direction across both: whether that lies in the caps of
/// both needs no closest points.
bool FeaturePairs::edgesMayFace(const Item& a, const Item& b, const FacingCap& cap_a,
                                const FacingCap& cap_b) const {
  const Vector3d along_a = FeatureBody(frame_, Side::A).edgeInFrame(a);
  const Vector3d along_b = FeatureBody(frame_, Side::B).edgeInFrame(b);
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

/// A peak has no vertex next to it that rises towards the other body by more than rounding: the normal
/// cone itself, which the cap is around. Points are off by less than the slack.
FeaturePairs::Peak FeaturePairs::peakAt(Side side, const Item& item, const Vector3d& point,
                                        const Vector3d& direction, double turn) const {
  const FeatureBody body(frame_, side);
  bool any_level = false;
  const auto rises = [&](NodeIndex node) {
    const Vector3d displacement = body.vertex(node) - point;
    const double height = direction.dot(displacement);
    any_level = any_level || height > -level_;
    const double over = height - slack_;
    return over > 0.0 && over * over > turn * turn * displacement.squaredNorm();
  };
  const TriangleNodes& nodes = body.mesh.surface().triangle(item.triangle);
  // The end of an edge counts with all that is around it.
  for (std::uint8_t k = 0; k < 3; ++k) {
    if ((body.vertex(nodes[k]) - point).squaredNorm() > slack_ * slack_) continue;
    bool is_peak = true;
    body.forEachNeighbour(nodes[k], [&](NodeIndex neighbour) { is_peak = is_peak && !rises(neighbour); });
    return {is_peak, any_level ? 2 : 0, static_cast<Feature>(k)};
  }
  if (item.kind == Kind::Face) return {std::none_of(nodes.begin(), nodes.end(), rises), 2, Feature::Face};
  const NodeIndex from = nodes[item.element];
  const NodeIndex to = nodes[(item.element + 1U) % 3];
  const auto feature = static_cast<Feature>(3 + item.element);
  if (rises(from) || rises(to)) return {false, 2, feature};
  any_level = false;
  bool is_peak = true;
  body.forEachApex(from, to, [&](NodeIndex apex) { is_peak = is_peak && !rises(apex); });
  return {is_peak, !is_peak || any_level ? 2 : 1, feature};
}

FeaturePairs::Between FeaturePairs::closest(const Item& a, const Item& b) const {
  const auto corner_a = [&](std::size_t k) { return frame_.vertexOfA(nodeOf(frame_.a, a, k)); };
  const auto corner_b = [&](std::size_t k) { return frame_.vertexOfB(nodeOf(frame_.b, b, k)); };
  // A foot beside the face by its error tilts the displacement by as much again.
  const auto foot_on_face = [&](const Vector3d& point, const Item& face, const auto& corner) {
    return footOnFace(point, {corner(0), corner(1), corner(2)}, slack_, normalErrorOf(face));
  };
  if (a.kind == Kind::Vertex) {
    const Vector3d point = corner_a(a.element);
    if (b.kind == Kind::Vertex) return between(point, corner_b(b.element));
    if (b.kind == Kind::Face) {
      const Foot foot = foot_on_face(point, b, corner_b);
      return between(point, foot.point, foot.is_beyond, 2.0 * normalErrorOf(b));
    }
    const Foot foot = footOnSegment(point, corner_b(b.element), corner_b(b.element + 1U), slack_);
    return between(point, foot.point, foot.is_beyond);
  }
  if (b.kind == Kind::Vertex) {
    const Vector3d point = corner_b(b.element);
    if (a.kind == Kind::Face) {
      const Foot foot = foot_on_face(point, a, corner_a);
      return between(foot.point, point, foot.is_beyond, 2.0 * normalErrorOf(a));
    }
    const Foot foot = footOnSegment(point, corner_a(a.element), corner_a(a.element + 1U), slack_);
    return between(foot.point, point, foot.is_beyond);
  }
  return betweenSegments(corner_a(a.element), corner_a(a.element + 1U), corner_b(b.element),
                         corner_b(b.element + 1U));
}

}  // namespace concave_distance::detail
