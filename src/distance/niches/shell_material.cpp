#include "shell_material.h"

#include <algorithm>
#include <optional>

#include "facet_line.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance::detail {
namespace {

/// Says how far before a surface it is asked what is there, relative to the body.
constexpr double kStepOff = 1e-7;

/// @param towards unit vector; zero: along the triangle's normal
bool isInside(const BodyMesh& body, TriangleIndex triangle, const Eigen::Vector3d& point,
              const Eigen::Vector3d& towards) {
  if (body.shellContacts().joints.empty()) return false;
  const Eigen::Vector3d& direction =
      towards.isZero(0.0) ? body.topology().triangle_normals[triangle.value] : towards;
  return isInsideOtherShell(body.surface(), body.topology(), body.tree(), triangle,
                            point + kStepOff * body.diameter() * direction);
}

FacetPoints facetOf(const PairFrame& frame, Side side, TriangleIndex facet) {
  return side == Side::A ? frame.facetOfA(facet) : frame.facetOfB(facet);
}

/// A straight line that holds the meeting of two facets, if it has a length.
struct Line {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
};

/// Widens a line by where edges of one facet meet the other one.
void widen(const FacetPoints& of, const FacetPoints& by, double tolerance, std::optional<Line>& line) {
  const FacetPlane plane(by);
  for (std::size_t k = 0; k < of.edgeCount(); ++k) {
    const Eigen::Vector3d& from = of.corners[k];
    const Eigen::Vector3d along = of.corners[k + 1 == of.edgeCount() ? 0 : k + 1] - from;
    LinePart part;
    if (!plane.isMet(from, from + along, tolerance, part)) continue;
    for (const double at : {part.first, part.last}) {
      const Eigen::Vector3d point = from + at * along;
      if (!line) line = Line{point, point};
      const double length = (line->to - line->from).norm();
      if ((point - line->from).norm() > length) {
        line->to = point;
      } else if ((point - line->to).norm() > length) {
        line->from = point;
      }
    }
  }
}

}  // namespace

bool isMeetingInSight(const PairFrame& frame, const TrianglePair& facets, const TrianglePair& triangles,
                      const TrianglePairDistance& closest, double tolerance) {
  const auto is_seen = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = point + frame.centre_a;
    return !isInsideMaterial(frame, {0.0, at, at, triangles.a, triangles.b});
  };
  if (is_seen(closest.point_a)) return true;
  std::optional<Line> line;
  const FacetPoints points_a = frame.facetOfA(facets.a);
  const FacetPoints points_b = frame.facetOfB(facets.b);
  widen(points_a, points_b, tolerance, line);
  widen(points_b, points_a, tolerance, line);
  if (!line) return false;
  // The line goes into material or out of it where other shells meet the facets. From each such place to the
  // next it is looked at in the middle.
  double begin = 0.0;
  while (begin < 1.0) {
    double end = 1.0;
    for (const Side side : {Side::A, Side::B}) {
      const TriangleIndex facet = side == Side::A ? facets.a : facets.b;
      const auto& adjacency = side == Side::A ? *frame.adjacency_a : *frame.adjacency_b;
      for (const AdjacentTriangle& next : adjacency.row(facet.value)) {
        if (!PairFrame::isJoint(side == Side::A ? frame.a : frame.b, next)) continue;
        const FacetPoints points = facetOf(frame, side, next.triangle);
        LinePart part;
        if (!FacetPlane(points).isMet(line->from, line->to, tolerance, part)) continue;
        for (const double at : {part.first, part.last}) {
          if (at > begin) end = std::min(end, at);
        }
      }
    }
    if (is_seen(line->from + 0.5 * (begin + end) * (line->to - line->from))) return true;
    begin = end;
  }
  return false;
}

bool isInsideMaterial(const PairFrame& frame, const WitnessPair& witness) {
  if (!frame.hasJoints()) return false;
  const Eigen::Vector3d towards_b = (witness.point_b_in_a - witness.point_a_in_a).stableNormalized();
  const Eigen::Isometry3d b_from_a = frame.a_from_b.inverse(Eigen::Isometry);
  return isInside(frame.a, witness.triangle_a, witness.point_a_in_a, towards_b) ||
         isInside(frame.b, witness.triangle_b, b_from_a * witness.point_b_in_a,
                  -(b_from_a.linear() * towards_b));
}

}  // namespace concave_distance::detail
