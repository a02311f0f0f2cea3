#include "convex_hull.h"

#include <CGAL/convex_hull_3.h>

#include "concave_distance/base/error.h"
#include "exact_solid.h"

namespace concave_distance {

ConvexPiece convexHull(const std::vector<Eigen::Vector3d>& points, const std::string& where) {
  std::vector<detail::ExactPoint> exact;
  exact.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    if (!point.allFinite()) throw Error(where, "a point is not finite", "check the file's numbers");
    exact.emplace_back(point.x(), point.y(), point.z());
  }
  const Error flat(where, "all points lie in one plane", "a hull needs a body with volume");
  const bool spans_space = [&exact] {
    for (std::size_t a = 1; a < exact.size(); ++a) {
      if (exact[a] == exact[0]) continue;
      for (std::size_t b = a + 1; b < exact.size(); ++b) {
        if (CGAL::collinear(exact[0], exact[a], exact[b])) continue;
        for (std::size_t c = b + 1; c < exact.size(); ++c) {
          if (!CGAL::coplanar(exact[0], exact[a], exact[b], exact[c])) return true;
        }
        return false;
      }
      return false;
    }
    return false;
  }();
  if (!spans_space) throw flat;
  detail::ExactPolyhedron hull;
  CGAL::convex_hull_3(exact.begin(), exact.end(), hull);
  ConvexPiece piece;
  if (!detail::roundedPiece(hull, where, piece)) throw flat;
  return piece;
}

}  // namespace concave_distance
