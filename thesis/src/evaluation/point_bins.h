#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace concave_distance::detail {

/// Which points are near a place: points sorted into cubes.
class PointBins {
 public:
  /// @param points must outlive the bins @param cell edge of the cubes, metres; about the radius asked for
  PointBins(const std::vector<Eigen::Vector3d>& points, double cell) : points_(&points), cell_(cell) {
    for (std::uint32_t i = 0; i < points.size(); ++i) bins_[keyOf(placeOf(points[i]))].push_back(i);
  }

  /// Calls visit(index, distance) for every point within `radius` of `place`, metres.
  template <typename Visit>
  void visitNear(const Eigen::Vector3d& place, double radius, Visit&& visit) const {
    const Place low = placeOf(place.array() - radius);
    const Place high = placeOf(place.array() + radius);
    for (std::int64_t x = low.x(); x <= high.x(); ++x) {
      for (std::int64_t y = low.y(); y <= high.y(); ++y) {
        for (std::int64_t z = low.z(); z <= high.z(); ++z) {
          const auto bin = bins_.find(keyOf({x, y, z}));
          if (bin == bins_.end()) continue;
          for (const std::uint32_t i : bin->second) {
            const double distance = ((*points_)[i] - place).norm();
            if (distance <= radius) visit(i, distance);
          }
        }
      }
    }
  }

 private:
  using Place = Eigen::Matrix<std::int64_t, 3, 1>;

  Place placeOf(const Eigen::Vector3d& point) const {
    return (point / cell_).array().floor().matrix().cast<std::int64_t>();
  }
  /// Cubes that share a key are only searched more than need be: distances decide.
  static std::uint64_t keyOf(const Place& place) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1;
    return (static_cast<std::uint64_t>(place.x()) & kMask) << 42U |
           (static_cast<std::uint64_t>(place.y()) & kMask) << 21U |
           (static_cast<std::uint64_t>(place.z()) & kMask);
  }

  const std::vector<Eigen::Vector3d>* points_;
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> bins_;
};

}  // namespace concave_distance::detail
