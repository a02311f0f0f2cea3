#include "concave_distance/distance/pass_level.h"

#include <algorithm>
#include <limits>

#include "concave_distance/distance/surface_walk.h"

namespace concave_distance {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct End {
  TriangleIndex triangle;
  Eigen::Vector3d point;  // body frame
};

enum class Leader { Both, A, B };

struct Way {
  const BodyMesh& a;
  const BodyMesh& b;
  const Eigen::Isometry3d& a_from_b;
  const Eigen::Isometry3d& b_from_a;
  End from_a, to_a, from_b, to_b;
};

// Arrived: what is left to the end is small against the way that was made.
bool arrived(const Eigen::Vector3d& at, const End& from, const End& to, double diameter) {
  const double reach = 1e-3 * (to.point - from.point).norm() + 1e-9 * diameter;
  return (at - to.point).squaredNorm() <= reach * reach;
}

double follow(const Way& way, Leader leader, int samples, double give_up) {
  double highest = 0.0;
  SurfacePoint at_a{way.from_a.triangle, Feature::Face, way.from_a.point, 0.0};
  SurfacePoint at_b{way.from_b.triangle, Feature::Face, way.from_b.point, 0.0};
  for (int k = 1; k <= samples; ++k) {
    const double share = static_cast<double>(k) / samples;
    if (leader != Leader::B) {
      at_a =
          walkTowards(way.a, at_a.triangle, way.from_a.point + share * (way.to_a.point - way.from_a.point));
    }
    if (leader != Leader::A) {
      at_b =
          walkTowards(way.b, at_b.triangle, way.from_b.point + share * (way.to_b.point - way.from_b.point));
    }
    if (leader == Leader::A) {
      at_b = walkTowards(way.b, at_b.triangle, way.b_from_a * at_a.point);
    } else if (leader == Leader::B) {
      at_a = walkTowards(way.a, at_a.triangle, way.a_from_b * at_b.point);
    }
    highest = std::max(highest, (way.a_from_b * at_b.point - at_a.point).squaredNorm());
    if (highest > give_up) {
      return kInfinity;
    }
  }
  const bool there = arrived(at_a.point, way.from_a, way.to_a, way.a.diameter()) &&
                     arrived(at_b.point, way.from_b, way.to_b, way.b.diameter());
  return there ? highest : kInfinity;
}

}  // namespace

double passLevel(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const WitnessPair& from, const WitnessPair& to, int samples, double good_enough) {
  const Eigen::Isometry3d b_from_a = a_from_b.inverse(Eigen::Isometry);
  const Way way{a,
                b,
                a_from_b,
                b_from_a,
                {from.triangle_a, from.point_a_in_a},
                {to.triangle_a, to.point_a_in_a},
                {from.triangle_b, b_from_a * from.point_b_in_a},
                {to.triangle_b, b_from_a * to.point_b_in_a}};
  double lowest = kInfinity;
  for (const Leader leader : {Leader::Both, Leader::A, Leader::B}) {
    lowest = std::min(lowest, follow(way, leader, samples, lowest));
    if (lowest <= good_enough) {
      break;
    }
  }
  // A way starts and ends at its minima, so no pass is lower than the higher of them.
  return std::max({lowest, from.squared_distance, to.squared_distance});
}

}  // namespace concave_distance
