#include "triangle_meeting.h"

#include <Eigen/Geometry>

namespace concave_distance::detail {

TriangleMeeting::TriangleMeeting(const TriangleCorners& a, const TriangleCorners& b, double tolerance)
    : tolerance_(tolerance) {
  const bool a_is_level = addEdges(a, b);
  const bool b_is_level = addEdges(b, a);
  if (a_is_level && b_is_level) addCrossings(a, b);
}

bool TriangleMeeting::addEdges(const TriangleCorners& edges, const TriangleCorners& face) {
  const Eigen::Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]).stableNormalized();
  if (normal.isZero(0.0)) {
    for (const Eigen::Vector3d& corner : edges) addIfOnBorder(corner, face);
    return false;
  }
  std::array<double, 3> heights{};
  bool flat = true;
  for (std::size_t k = 0; k < 3; ++k) {
    heights[k] = normal.dot(edges[k] - face[0]);
    flat = flat && std::abs(heights[k]) <= tolerance_;
    if (std::abs(heights[k]) <= tolerance_) addIfInside(edges[k], face, normal);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = k == 2 ? 0 : k + 1;
    if (std::abs(heights[k]) <= tolerance_ || std::abs(heights[next]) <= tolerance_) continue;
    if ((heights[k] > 0.0) == (heights[next] > 0.0)) continue;
    const double share = heights[k] / (heights[k] - heights[next]);
    addIfInside(edges[k] + share * (edges[next] - edges[k]), face, normal);
  }
  return flat;
}

void TriangleMeeting::addIfOnBorder(const Eigen::Vector3d& point, const TriangleCorners& face) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d edge = face[k == 2 ? 0 : k + 1] - face[k];
    const double squared_length = edge.squaredNorm();
    const double share =
        squared_length > 0.0 ? std::clamp(edge.dot(point - face[k]) / squared_length, 0.0, 1.0) : 0.0;
    if ((face[k] + share * edge - point).norm() <= tolerance_) return add(point);
  }
}

void TriangleMeeting::addIfInside(const Eigen::Vector3d& point, const TriangleCorners& face,
                                  const Eigen::Vector3d& normal) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d edge = face[k == 2 ? 0 : k + 1] - face[k];
    const double length = edge.norm();
    if (length > 0.0 && normal.dot(edge.cross(point - face[k])) < -tolerance_ * length) return;
  }
  add(point);
}

void TriangleMeeting::addCrossings(const TriangleCorners& a, const TriangleCorners& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d u = a[i == 2 ? 0 : i + 1] - a[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d v = b[k == 2 ? 0 : k + 1] - b[k];
      const Eigen::Vector3d n = u.cross(v);
      const double nn = n.squaredNorm();
      if (!(nn > 1e-20 * u.squaredNorm() * v.squaredNorm())) continue;
      const double s = (b[k] - a[i]).cross(v).dot(n) / nn;
      const double t = (b[k] - a[i]).cross(u).dot(n) / nn;
      if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) add(a[i] + s * u);
    }
  }
}

void TriangleMeeting::add(const Eigen::Vector3d& point) {
  const bool known = std::any_of(points_.begin(), points_.end(), [&](const Eigen::Vector3d& other) {
    return (other - point).squaredNorm() <= tolerance_ * tolerance_;
  });
  if (!known) points_.push_back(point);
}

bool mayMeetBeside(const Eigen::Vector3d& v, const std::array<Eigen::Vector3d, 2>& a,
                   const std::array<Eigen::Vector3d, 2>& b, double tolerance) {
  const auto are_beyond = [&](const std::array<Eigen::Vector3d, 2>& points, const Eigen::Vector3d& normal) {
    const double least = tolerance * normal.norm();
    return normal.dot(points[0] - v) > least && normal.dot(points[1] - v) > least;
  };
  const auto parts = [&](const std::array<Eigen::Vector3d, 2>& of,
                         const std::array<Eigen::Vector3d, 2>& other) {
    const Eigen::Vector3d first = of[0] - v;
    const Eigen::Vector3d last = of[1] - v;
    const Eigen::Vector3d normal = first.cross(last);
    return are_beyond(other, normal) || are_beyond(other, -normal) ||
           are_beyond(other, first.cross(normal)) || are_beyond(other, normal.cross(last));
  };
  return !parts(a, b) && !parts(b, a);
}

}  // namespace concave_distance::detail
