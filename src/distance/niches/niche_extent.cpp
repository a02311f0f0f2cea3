#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "distance/kernels/adjacent_triangles.h"
#include "distance/kernels/pair_frame.h"
#include "niche_properties.h"
#include "planar_set.h"

namespace concave_distance {
namespace {

using detail::PlanarFeature;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// One body as the search sees it: in coordinates relative to `centre`, turned into A's axes only through
/// `normal` and the plane's two axes, which are given in the body's own.
struct LevelSide {
  const BodyMesh& body;
  Vector3d centre;
  Vector3d witness;   ///< relative to the centre
  Vector3d outwards;  ///< unit, towards the other body
  Vector3d axis_x;    ///< of the plane across it
  Vector3d axis_y;

  TrianglePoints corners(TriangleIndex t) const { return detail::localCorners(body.surface(), t, centre); }
  Vector2d flat(const Vector3d& point) const {
    return {axis_x.dot(point - witness), axis_y.dot(point - witness)};
  }
  Vector3d raised(const Vector2d& point) const { return witness + point.x() * axis_x + point.y() * axis_y; }
  double height(const Vector3d& point) const { return outwards.dot(point - witness); }
};

struct Levels {
  double tolerance;  ///< heights within this are level
  double reach;      ///< sideways, lengthens the distance by no more than the tolerance
  double slack;      ///< rounding
};

/// Returns what of a triangle is level with the witness: all of it, an edge, a corner or nothing.
PlanarFeature levelPart(const LevelSide& side, TriangleIndex t, double tolerance) {
  PlanarFeature part;
  for (const Vector3d& corner : side.corners(t)) {
    if (std::abs(side.height(corner)) <= tolerance) part.corners[part.count++] = side.flat(corner);
  }
  return part;
}

/// Triangles in all rings around the corners of a set: about 12 for each corner of a pair, many more when the
/// sideways reach is longer than the triangles, as at large distances.
constexpr std::size_t kRingsPerPair = 1024;

bool isCornerOf(const TriangleNodes& nodes, NodeIndex node) {
  return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
}

class LevelSetSearch {
 public:
  LevelSetSearch(const LevelSide& a, const LevelSide& b, const Levels& levels, std::size_t pair_limit,
                 std::size_t ring_limit, WorkLimit& limit, ExtentWorkspace& workspace, NicheExtent& extent)
      : a_(a),
        b_(b),
        levels_(levels),
        pair_limit_(pair_limit),
        rings_left_(std::min(kRingsPerPair * std::min(pair_limit, kLargestRings), ring_limit)),
        limit_(limit),
        workspace_(workspace),
        extent_(extent) {}

  void run(TriangleIndex start_a, TriangleIndex start_b) {
    workspace_.open.clear();
    workspace_.seen.clear();
    workspace_.pieces.clear();
    workspace_.points.clear();
    open(start_a, start_b);
    for (std::size_t i = 0; i < workspace_.open.size(); ++i) {
      if (i == pair_limit_ || rings_left_ == 0 || limit_.isOver()) extent_.cut = true;
      if (extent_.cut) return;
      const TriangleIndex triangle_a = workspace_.open[i].first;
      const TriangleIndex triangle_b = workspace_.open[i].second;
      workspace_.corners.clear();
      const PlanarFeature part_a = levelPart(a_, triangle_a, levels_.tolerance);
      const PlanarFeature part_b = levelPart(b_, triangle_b, levels_.tolerance);
      appendOverlap(part_a, part_b, levels_.reach, workspace_.corners);
      if (workspace_.corners.empty()) continue;
      detail::convexHull(workspace_.corners, workspace_.polygon);
      const auto first = static_cast<std::uint32_t>(workspace_.points.size());
      const auto count = static_cast<std::uint32_t>(workspace_.polygon.size());
      workspace_.pieces.push_back({static_cast<std::uint32_t>(i), first, count});
      workspace_.points.insert(workspace_.points.end(), workspace_.polygon.begin(), workspace_.polygon.end());
      for (std::uint32_t k = first; k < first + count; ++k) {
        const Vector2d point = workspace_.points[k];
        if (!isInside(part_a, point)) {
          spread(a_, triangle_a, point, [&](TriangleIndex other) { return std::pair{other, triangle_b}; });
        }
        if (!isInside(part_b, point)) {
          spread(b_, triangle_b, point, [&](TriangleIndex other) { return std::pair{triangle_a, other}; });
        }
      }
    }
  }

 private:
  void open(TriangleIndex triangle_a, TriangleIndex triangle_b) {
    if (workspace_.open.size() > pair_limit_) return;  // the last one is never visited
    const std::pair pair{triangle_a, triangle_b};
    const auto place = std::lower_bound(workspace_.seen.begin(), workspace_.seen.end(), pair);
    if (place != workspace_.seen.end() && *place == pair) return;
    workspace_.seen.insert(place, pair);
    workspace_.open.push_back(pair);
  }

  /// Clearly within a level triangle: no other triangle holds the point.
  bool isInside(const PlanarFeature& part, const Vector2d& point) const {
    if (part.count < 3) return false;
    const double margin = 4.0 * (levels_.slack + levels_.reach);
    double turn = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector2d edge = part.corners[(k + 1) % 3] - part.corners[k];
      const Vector2d displacement = point - part.corners[k];
      const double area = edge.x() * displacement.y() - edge.y() * displacement.x();
      if (area * area <= margin * margin * edge.squaredNorm() || area * turn < 0.0) return false;
      turn = area;
    }
    return true;
  }

  /// To the triangles that share the set's corner `point`, one body at a time: a set that goes on across a
  /// border of both bodies at once has that point in the two pairs in between as well. A triangle whose level
  /// part belongs to the present one adds nothing.
  template <typename PairWith>
  void spread(const LevelSide& side, TriangleIndex triangle, const Vector2d& point, PairWith pair_with) {
    const detail::LocalTriangle own{side.body.surface(), side.body.topology(), side.centre, triangle};
    const TriangleNodes& own_nodes = own.mesh.triangle(triangle);
    const PointTriangleDistance on_triangle =
        pointTriangleDistance(side.raised(point), side.corners(triangle));
    detail::collectRing(own, {on_triangle.point, on_triangle.feature, side.outwards},
                        levels_.slack + levels_.reach, workspace_.ring, rings_left_);
    rings_left_ -= std::min(rings_left_, workspace_.ring.ring.size());
    for (std::size_t i = 1; i < workspace_.ring.ring.size(); ++i) {
      const TriangleIndex other = workspace_.ring.ring[i];
      const TriangleNodes& nodes = own.mesh.triangle(other);
      bool adds = false;
      for (const NodeIndex node : nodes) {
        if (isCornerOf(own_nodes, node)) continue;
        const double height = side.height(own.mesh.vertex(node) - side.centre);
        if (height > levels_.tolerance && !extent_.leads_down && isOn(side, other, on_triangle.point)) {
          extent_.leads_down = true;
          std::tie(extent_.down_a, extent_.down_b) = pair_with(other);
        }
        adds = adds || std::abs(height) <= levels_.tolerance;
      }
      if (adds) {
        const auto [triangle_a, triangle_b] = pair_with(other);
        open(triangle_a, triangle_b);
      }
    }
  }

  /// The ring reaches as far as corners may have been snapped; downhill counts only at the set itself.
  bool isOn(const LevelSide& side, TriangleIndex t, const Vector3d& point) const {
    return pointTriangleDistance(point, side.corners(t)).squared_distance <= levels_.slack * levels_.slack;
  }

  const LevelSide& a_;
  const LevelSide& b_;
  const Levels& levels_;
  std::size_t pair_limit_;
  std::size_t rings_left_;  ///< triangles that rings may still name
  WorkLimit& limit_;
  ExtentWorkspace& workspace_;
  NicheExtent& extent_;
};

/// Returns whether every corner around the witness, but for one that it is on, lies clearly behind it.
bool isPeak(const LevelSide& side, TriangleIndex triangle, Feature feature, const Levels& levels,
            RefinementWorkspace& ring) {
  const detail::LocalTriangle own{side.body.surface(), side.body.topology(), side.centre, triangle};
  detail::collectRing(own, {side.witness, feature, side.outwards}, levels.slack, ring);
  for (const TriangleIndex t : ring.ring) {
    for (const Vector3d& corner : side.corners(t)) {
      if (side.height(corner) >= -levels.tolerance &&
          (corner - side.witness).squaredNorm() > levels.slack * levels.slack) {
        return false;
      }
    }
  }
  return true;
}

/// Limits how far the representative's distance may be from the witness's, in errors of the kernel: where it
/// is farther, the set is level within the tolerance only, and the witness stands for it.
constexpr double kSameDistance = 4.0;
/// A set ends where a body does, and segments that graze its last face are not hidden by it: a corner is
/// taken so far inside, as a share of the part's size.
constexpr double kInwards = 1e-3;

/// The closest pair of points at a point of the plane on the piece's two triangles: sideways the set is only
/// as exact as the tolerance, so that each point is led to the one closest to the other.
TrianglePairDistance pairAt(const detail::PairFrame& frame, const Vector3d& point, TriangleIndex triangle_a,
                            TriangleIndex triangle_b) {
  const TrianglePoints corners_a = frame.cornersOfA(triangle_a);
  const PointTriangleDistance start = pointTriangleDistance(point, corners_a);
  const PointTriangleDistance on_b = pointTriangleDistance(start.point, frame.cornersOfB(triangle_b));
  const PointTriangleDistance on_a = pointTriangleDistance(on_b.point, corners_a);
  return {(on_b.point - on_a.point).squaredNorm(), on_a.point, on_b.point, on_a.feature, on_b.feature};
}

void placeRepresentative(const detail::PairFrame& frame, const LevelSide& a, double rounding,
                         ExtentWorkspace& workspace, NicheExtent& extent) {
  const Vector2d centre = detail::centreOfEnclosingCircle(workspace.hull);
  double least = std::numeric_limits<double>::infinity();
  Vector2d middle = Vector2d::Zero();
  std::pair<TriangleIndex, TriangleIndex> carrier;
  for (const ExtentWorkspace::Piece& piece : workspace.pieces) {
    const Vector2d nearest = detail::nearestIn(&workspace.points[piece.first], piece.count, centre);
    const double squared_distance = (nearest - centre).squaredNorm();
    const auto& pair = workspace.open[piece.pair];
    if (squared_distance < least || (squared_distance == least && pair < carrier)) {
      least = squared_distance;
      middle = nearest;
      carrier = pair;
    }
  }
  const TrianglePairDistance found = pairAt(frame, a.raised(middle), carrier.first, carrier.second);
  const double distance = std::sqrt(extent.representative.squared_distance);
  if (std::abs(std::sqrt(found.squared_distance) - distance) > kSameDistance * rounding) return;
  extent.representative = frame.toWitness(found, carrier.first, carrier.second);
}

}  // namespace

NicheExtent measureExtent(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                          const WitnessPair& witness, double tolerance, std::size_t pair_limit,
                          ExtentWorkspace& workspace, WorkLimit* limit, std::size_t ring_limit) {
  NicheExtent extent;
  extent.representative = witness;
  const detail::PairFrame frame(a, b, a_from_b, witness.triangle_a, witness.triangle_b);
  const double rounding =
      kTriangleDistanceError *
      detail::largestMagnitude(frame.cornersOfA(witness.triangle_a), frame.cornersOfB(witness.triangle_b));
  const Vector3d point_a = witness.point_a_in_a - frame.centre_a;
  const Vector3d point_b = witness.point_b_in_a - frame.centre_a;
  const double distance = (point_b - point_a).norm();
  workspace.pieces.clear();
  if (distance <= rounding) return extent;

  const Vector3d normal = (point_b - point_a) / distance;
  const Vector3d axis_x = normal.unitOrthogonal();
  const Vector3d axis_y = normal.cross(axis_x);
  const Eigen::Matrix3d b_from_a = frame.rotation.transpose();
  const LevelSide side_a{a, frame.centre_a, point_a, normal, axis_x, axis_y};
  const LevelSide side_b{
      b, frame.centre_b, frame.pointInB(point_b), b_from_a * -normal, b_from_a * axis_x, b_from_a * axis_y};
  const double height_tolerance = tolerance + 2.0 * rounding;
  const Levels levels{height_tolerance, std::sqrt(height_tolerance * (2.0 * distance + height_tolerance)),
                      2.0 * rounding};
  workspace.origin = witness.point_a_in_a;
  workspace.normal = normal;
  workspace.axis_x = axis_x;
  workspace.axis_y = axis_y;
  workspace.reach = levels.reach + levels.slack;
  // No set is longer than either body; one shorter than this cannot be distinguished from a point.
  if (std::min(a.diameter(), b.diameter()) <= 2.0 * levels.reach) return extent;
  if (isPeak(side_a, witness.triangle_a, witness.feature_a, levels, workspace.ring) ||
      isPeak(side_b, witness.triangle_b, witness.feature_b, levels, workspace.ring)) {
    return extent;
  }
  WorkLimit none;
  LevelSetSearch(side_a, side_b, levels, pair_limit, ring_limit, limit != nullptr ? *limit : none, workspace,
                 extent)
      .run(witness.triangle_a, witness.triangle_b);
  workspace.corners = workspace.points;  // the hull sorts its input
  detail::convexHull(workspace.corners, workspace.hull);
  const double length = detail::diameterOf(workspace.hull);
  if (length <= 2.0 * levels.reach) return extent;
  extent.length = length;
  extent.kind = detail::widthOf(workspace.hull) <= 2.0 * levels.reach ? NicheKind::Segment : NicheKind::Patch;
  placeRepresentative(frame, side_a, rounding, workspace, extent);
  return extent;
}

std::optional<WitnessPair> cornerOf(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                    const ExtentWorkspace& measured, const ExtentWorkspace::Piece& piece,
                                    std::uint32_t corner) {
  Vector2d middle = Vector2d::Zero();
  for (std::uint32_t k = 0; k < piece.count; ++k) middle += measured.points[piece.first + k] / piece.count;
  const Vector2d to_middle = middle - measured.points[piece.first + corner];
  if (to_middle.norm() <= 2.0 * measured.reach) return std::nullopt;
  const Vector2d at = measured.points[piece.first + corner] + kInwards * to_middle;
  const auto& [triangle_a, triangle_b] = measured.open[piece.pair];
  const detail::PairFrame frame(a, b, a_from_b, triangle_a, triangle_b);
  const Vector3d point = measured.origin + at.x() * measured.axis_x + at.y() * measured.axis_y;
  return frame.toWitness(pairAt(frame, point - frame.centre_a, triangle_a, triangle_b), triangle_a,
                         triangle_b);
}

}  // namespace concave_distance
