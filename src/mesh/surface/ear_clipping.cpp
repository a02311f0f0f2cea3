#include "ear_clipping.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "plane_geometry.h"

namespace concave_distance::detail {
namespace {

class EarClipping {
 public:
  EarClipping(const std::vector<Eigen::Vector2d>& polygon, double least_height,
              const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal)
      : polygon_(polygon), least_height_(least_height), allows_diagonal_(allows_diagonal) {
    const auto count = static_cast<std::uint32_t>(polygon.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      corners_.push_back(i);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      shapes_.push_back(shapeOf(i));
    }
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    while (corners_.size() > 3) {
      const std::optional<std::size_t> ear = bestEar();
      if (!ear) return {};
      triangles.push_back(triangleAt(*ear));
      clip(*ear);
    }
    if (corners_.size() < 3 || shapes_[1] <= 0.0) return {};
    triangles.push_back(triangleAt(1));
    return triangles;
  }

 private:
  std::array<std::uint32_t, 3> triangleAt(std::size_t i) const {
    const std::size_t n = corners_.size();
    return {corners_[(i + n - 1) % n], corners_[i], corners_[(i + 1) % n]};
  }

  PlaneTriangle placeOf(const std::array<std::uint32_t, 3>& t) const {
    return {polygon_[t[0]], polygon_[t[1]], polygon_[t[2]]};
  }

  /// Height over longest edge of the triangle at a corner; 0 where it is too flat or turned.
  double shapeOf(std::size_t i) const {
    const auto [a, b, c] = placeOf(triangleAt(i));
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double height = cross(b - a, c - a) / longest;
    return height > least_height_ ? height / longest : 0.0;
  }

  bool isEar(std::size_t i) const {
    const std::array<std::uint32_t, 3> ear = triangleAt(i);
    const PlaneTriangle place = placeOf(ear);
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      // Where any corner lies in the triangle, one that is not convex does.
      if (shapes_[k] > 0.0 || std::find(ear.begin(), ear.end(), corners_[k]) != ear.end()) continue;
      if (leastHeight(place, polygon_[corners_[k]]).value > -least_height_) return false;
    }
    return allows_diagonal_(ear[0], ear[2]);
  }

  std::optional<std::size_t> bestEar() const {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (shapes_[i] > (best ? shapes_[*best] : 0.0) && isEar(i)) best = i;
    }
    return best;
  }

  void clip(std::size_t i) {
    const auto place = static_cast<std::ptrdiff_t>(i);
    corners_.erase(corners_.begin() + place);
    shapes_.erase(shapes_.begin() + place);
    const std::size_t n = corners_.size();
    for (const std::size_t changed : {(i + n - 1) % n, i % n}) {
      shapes_[changed] = shapeOf(changed);
    }
  }

  const std::vector<Eigen::Vector2d>& polygon_;
  double least_height_;
  const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal_;
  std::vector<std::uint32_t> corners_;  ///< those not clipped yet
  std::vector<double> shapes_;          ///< of the triangles at them
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clipEars(
    const std::vector<Eigen::Vector2d>& polygon, double least_height,
    const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal) {
  return EarClipping(polygon, least_height, allows_diagonal).run();
}

}  // namespace concave_distance::detail
