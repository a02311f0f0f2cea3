#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace concave_distance::detail {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// Holds the points that bound what two triangles have in common.
class TriangleMeeting {
 public:
  /// @param tolerance metres: points this near are one, and touch
  TriangleMeeting(const TriangleCorners& a, const TriangleCorners& b, double tolerance);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }

  /// Calls visit(from, to) for what bounds the points in common: one point, one segment, or the sides
  /// of an area.
  template <typename Visit>
  void forEachSide(const Eigen::Vector3d& normal, const Visit& visit) {
    const std::size_t count = points_.size();
    if (count <= 2) return visit(points_.front(), points_.back());
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : points_) middle += point / static_cast<double>(count);
    const Eigen::Vector3d x = (points_.front() - middle).stableNormalized();
    const Eigen::Vector3d y = normal.cross(x);
    const auto angle_of = [&](const Eigen::Vector3d& point) {
      return std::atan2(y.dot(point - middle), x.dot(point - middle));
    };
    std::sort(points_.begin(), points_.end(),
              [&](const Eigen::Vector3d& l, const Eigen::Vector3d& r) { return angle_of(l) < angle_of(r); });
    for (std::size_t k = 0; k < count; ++k) visit(points_[k], points_[k + 1 == count ? 0 : k + 1]);
  }

 private:
  /// Adds where edges of one triangle meet the other. True when all of it lies in the other's plane.
  bool addEdges(const TriangleCorners& edges, const TriangleCorners& face);
  void addIfOnBorder(const Eigen::Vector3d& point, const TriangleCorners& face);
  void addIfInside(const Eigen::Vector3d& point, const TriangleCorners& face, const Eigen::Vector3d& normal);
  /// Adds where edges of triangles in one plane cross.
  void addCrossings(const TriangleCorners& a, const TriangleCorners& b);
  void add(const Eigen::Vector3d& point);

  double tolerance_;
  std::vector<Eigen::Vector3d> points_;
};

/// Returns whether two triangles with the corner `v` in common may have more in common: false only where a
/// plane through v parts the rest of them.
bool mayMeetBeside(const Eigen::Vector3d& v, const std::array<Eigen::Vector3d, 2>& a,
                   const std::array<Eigen::Vector3d, 2>& b, double tolerance);

}  // namespace concave_distance::detail
