#include "convex_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/kernels/triangle_distance.h"

namespace concave_distance {
namespace {

/// Facets this near to a proposed point are asked first; relative to the piece's radius.
constexpr double kNearFacets = 1e-3;

bool isProven(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
              const PieceDistance& answer) {
  return answer.distance - answer.lower_bound <= kPieceDistanceTolerance * pieceScale(a, b, a_from_b);
}

void measure(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
             PieceDistance& answer) {
  const Eigen::Vector3d between = a_from_b * answer.points.on_b - answer.points.on_a;
  answer.distance = between.norm();
  answer.lower_bound =
      answer.distance > 0.0
          ? std::clamp(shadowGap(a, b, a_from_b, between / answer.distance), 0.0, answer.distance)
          : 0.0;
  answer.proven = isProven(a, b, a_from_b, answer);
}

TrianglePoints triangleOf(const ConvexPiece& piece, std::size_t facet, std::size_t k,
                          const Eigen::Isometry3d& frame, const Eigen::Vector3d& origin) {
  const std::vector<std::uint32_t>& corners = piece.facets[facet];
  return {frame * piece.vertices[corners[0]] - origin, frame * piece.vertices[corners[k]] - origin,
          frame * piece.vertices[corners[k + 1]] - origin};
}

bool isNear(const ConvexPiece& piece, std::size_t facet, const Eigen::Vector3d& point, double reach) {
  const auto row = static_cast<Eigen::Index>(facet);
  return piece.normals.row(row).dot(point) + piece.offsets[row] <= reach;
}

/// Near contact the direction between two points has few digits left; that of a facet has all of them.
void boundByFacets(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
                   PieceDistance& answer) {
  const auto bound = [&](const Eigen::Vector3d& direction_in_a) {
    answer.lower_bound = std::max(answer.lower_bound, shadowGap(a, b, a_from_b, direction_in_a));
  };
  for (std::size_t f = 0; f < a.facets.size(); ++f) {
    if (!isNear(a, f, answer.points.on_a, kNearFacets * a.radius)) continue;
    bound(-a.normals.row(static_cast<Eigen::Index>(f)).transpose());
  }
  for (std::size_t f = 0; f < b.facets.size(); ++f) {
    if (!isNear(b, f, answer.points.on_b, kNearFacets * b.radius)) continue;
    bound(a_from_b.linear() * b.normals.row(static_cast<Eigen::Index>(f)).transpose());
  }
  answer.lower_bound = std::min(answer.lower_bound, answer.distance);
  answer.proven = isProven(a, b, a_from_b, answer);
}

/// The closest points of the facets within `reach` of the answer's points, where closer than these.
void finish(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b, double reach_a,
            double reach_b, PieceDistance& answer) {
  const PiecePoints near = answer.points;
  const Eigen::Vector3d origin = a.centre;
  PiecePoints found = near;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t fa = 0; fa < a.facets.size(); ++fa) {
    if (!isNear(a, fa, near.on_a, reach_a)) continue;
    for (std::size_t ka = 1; ka + 1 < a.facets[fa].size(); ++ka) {
      const TrianglePoints ta = triangleOf(a, fa, ka, Eigen::Isometry3d::Identity(), origin);
      for (std::size_t fb = 0; fb < b.facets.size(); ++fb) {
        if (!isNear(b, fb, near.on_b, reach_b)) continue;
        for (std::size_t kb = 1; kb + 1 < b.facets[fb].size(); ++kb) {
          const TrianglePairDistance pair = triangleDistance(ta, triangleOf(b, fb, kb, a_from_b, origin));
          if (pair.squared_distance >= best) continue;
          best = pair.squared_distance;
          found = {pair.point_a + origin, a_from_b.inverse() * (pair.point_b + origin)};
        }
      }
    }
  }
  answer.finished = true;
  // At equal distances, too: these points are exact, and the bound wants the exact direction.
  const double rounding = kTriangleDistanceError * pieceScale(a, b, a_from_b);
  if (std::sqrt(best) <= answer.distance + rounding) answer.points = found;
  measure(a, b, a_from_b, answer);
  if (!answer.proven) boundByFacets(a, b, a_from_b, answer);
}

/// One common point is enough for distance 0: B's, or a centre, where one body holds the other.
bool meet(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
          PieceDistance& answer) {
  const Eigen::Isometry3d b_from_a = a_from_b.inverse();
  const Eigen::Vector3d candidates_in_a[] = {a_from_b * answer.points.on_b, answer.points.on_a,
                                             a_from_b * b.centre, a.centre};
  for (const Eigen::Vector3d& point : candidates_in_a) {
    const Eigen::Vector3d point_in_b = b_from_a * point;
    if (depth(a, point) < 0.0 || depth(b, point_in_b) < 0.0) continue;
    answer.points = {point, point_in_b};
    answer.distance = 0.0;
    answer.lower_bound = 0.0;
    answer.proven = true;
    return true;
  }
  return false;
}

}  // namespace

double shadowGap(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
                 const Eigen::Vector3d& direction_in_a) {
  const Eigen::Vector3d direction_in_b = a_from_b.linear().transpose() * direction_in_a;
  const Eigen::Vector3d towards_a = -direction_in_b;
  // Relative to A's centre: no digit is lost where the bodies are far from their origins.
  const double reach_a = support(a, direction_in_a) - direction_in_a.dot(a.centre);
  const double reach_b = support(b, towards_a) - towards_a.dot(b.centre);
  return direction_in_a.dot(a_from_b * b.centre - a.centre) - reach_a - reach_b;
}

double pieceScale(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b) {
  return a.radius + b.radius + (a_from_b * b.centre - a.centre).norm();
}

PieceDistance judgeProposal(const ConvexPiece& a, const ConvexPiece& b, const Eigen::Isometry3d& a_from_b,
                            const PieceProposal& proposal) {
  PieceDistance answer;
  answer.points = proposal.points;
  answer.iterations = proposal.iterations;
  measure(a, b, a_from_b, answer);
  if (answer.proven || meet(a, b, a_from_b, answer)) return answer;
  if (!proposal.failed) finish(a, b, a_from_b, kNearFacets * a.radius, kNearFacets * b.radius, answer);
  if (!answer.proven) {
    constexpr double kAll = std::numeric_limits<double>::infinity();
    finish(a, b, a_from_b, kAll, kAll, answer);
  }
  return answer;
}

}  // namespace concave_distance
