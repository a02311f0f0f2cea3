#include "support/exact_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace concave_distance::test {
namespace {

template <typename Real>
ExactTriangle<Real> cornersOf(const std::vector<ExactVector<Wide>>& points, const TriangleNodes& t) {
  const auto corner = [&](NodeIndex node) {
    const ExactVector<Wide>& p = points[node.value];
    return ExactVector<Real>(static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z));
  };
  return {corner(t[0]), corner(t[1]), corner(t[2])};
}

struct LongBox {
  std::array<long double, 3> low{};
  std::array<long double, 3> high{};
};

LongBox boxOf(const ExactTriangle<long double>& t) {
  const auto range = [&](auto coordinate) {
    return std::minmax({coordinate(t[0]), coordinate(t[1]), coordinate(t[2])});
  };
  const auto x = range([](const auto& p) { return p.x; });
  const auto y = range([](const auto& p) { return p.y; });
  const auto z = range([](const auto& p) { return p.z; });
  return {{x.first, y.first, z.first}, {x.second, y.second, z.second}};
}

long double squaredGap(const LongBox& a, const LongBox& b) {
  long double sum = 0.0L;
  for (std::size_t k = 0; k < 3; ++k) {
    const long double gap = std::max({0.0L, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    sum += gap * gap;
  }
  return sum;
}

}  // namespace

std::vector<ExactVector<Wide>> exactlyMoved(const std::vector<Eigen::Vector3d>& points, const GivenPose& pose,
                                            const Eigen::Vector3d& centre) {
  const ExactVector<Wide> axis(pose.quaternion.head<3>());
  const Wide w(pose.quaternion.w());
  const Wide squared_norm = axis.squaredNorm() + w * w;
  const ExactVector<Wide> shift = ExactVector<Wide>(pose.translation) - ExactVector<Wide>(centre);
  std::vector<ExactVector<Wide>> moved;
  moved.reserve(points.size());
  for (const Eigen::Vector3d& given : points) {
    const ExactVector<Wide> point(given);
    const ExactVector<Wide> turn = axis.cross(point) + point * w;  // q p q* / |q|^2 = p + 2 v x (v x p + w p)
    moved.push_back(point + axis.cross(turn) * Wide(Wide(2) / squared_norm) + shift);
  }
  return moved;
}

Wide exactSurfaceDistance(const SurfaceMesh& a, const SurfaceMesh& b, const GivenPose& b_in_a) {
  const Eigen::Vector3d centre = a.vertices().front();
  const std::vector<ExactVector<Wide>> points_a = exactlyMoved(a.vertices(), GivenPose(), centre);
  const std::vector<ExactVector<Wide>> points_b = exactlyMoved(b.vertices(), b_in_a, centre);
  std::vector<ExactTriangle<long double>> triangles_b;
  std::vector<LongBox> boxes_b;
  long double size = 0.0L;
  for (const auto* points : {&points_a, &points_b}) {
    for (const ExactVector<Wide>& p : *points) {
      const ExactVector<long double> q(static_cast<long double>(p.x), static_cast<long double>(p.y),
                                       static_cast<long double>(p.z));
      size = std::max({size, std::abs(q.x), std::abs(q.y), std::abs(q.z)});
    }
  }
  for (const TriangleNodes& t : b.triangles()) {
    triangles_b.push_back(cornersOf<long double>(points_b, t));
    boxes_b.push_back(boxOf(triangles_b.back()));
  }
  struct Contender {
    long double distance;
    std::size_t a;
    std::size_t b;
  };
  const long double margin = 1e-9L * size;
  std::vector<Contender> contenders;
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < a.triangleCount(); ++i) {
    const auto triangle_a = cornersOf<long double>(points_a, a.triangles()[i]);
    const LongBox box_a = boxOf(triangle_a);
    for (std::size_t j = 0; j < triangles_b.size(); ++j) {
      const long double limit = least + margin;
      if (squaredGap(box_a, boxes_b[j]) > limit * limit) continue;
      const long double distance = std::sqrt(exactSquaredDistance(triangle_a, triangles_b[j]));
      least = std::min(least, distance);
      if (distance <= least + margin) contenders.push_back({distance, i, j});
    }
  }
  std::sort(contenders.begin(), contenders.end(),
            [](const Contender& l, const Contender& r) { return l.distance < r.distance; });
  Wide squared = std::numeric_limits<double>::infinity();
  for (const Contender& contender : contenders) {
    if (contender.distance > least + margin || squared == 0) break;
    squared = std::min(squared, exactSquaredDistance(cornersOf<Wide>(points_a, a.triangles()[contender.a]),
                                                     cornersOf<Wide>(points_b, b.triangles()[contender.b])));
  }
  return boost::multiprecision::sqrt(squared);
}

double surfaceOffset(const Eigen::Vector3d& point, const SurfaceMesh& surface) {
  const ExactTriangle<Wide> at = {ExactVector<Wide>(point), ExactVector<Wide>(point),
                                  ExactVector<Wide>(point)};
  Wide squared = std::numeric_limits<double>::infinity();
  double nearest = std::numeric_limits<double>::infinity();
  for (const TriangleNodes& t : surface.triangles()) {
    const TrianglePoints corners = {surface.vertex(t[0]), surface.vertex(t[1]), surface.vertex(t[2])};
    Eigen::AlignedBox3d box(corners[0]);
    box.extend(corners[1]);
    box.extend(corners[2]);
    if (box.exteriorDistance(point) > nearest * (1.0 + 1e-9)) continue;
    squared = std::min(squared, exactSquaredDistance(at, exactTriangle<Wide>(corners)));
    nearest = static_cast<double>(boost::multiprecision::sqrt(squared));
  }
  return nearest;
}

}  // namespace concave_distance::test
