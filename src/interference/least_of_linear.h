#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace concave_distance::detail {

/// The least of a few linear functions over a triangle, each given by its values at the corners.
class LeastOfLinear {
 public:
  static constexpr std::size_t kMost = 12;
  struct Peak {
    double value;
    Eigen::Vector3d weights;  ///< of the corners
  };

  void clear() { count_ = 0; }
  std::size_t count() const { return count_; }
  void add(const Eigen::Vector3d& at_corners) { functions_[count_++] = at_corners; }
  /// Returns function i in the middle of the triangle.
  double inMiddle(std::size_t i) const { return functions_[i].sum() / 3.0; }
  /// Finds where the least of them is greatest: it is linear on the part where one function is the least, so
  /// that it is greatest at one of that part's corners.
  Peak peak();

 private:
  struct Polygon {
    std::array<Eigen::Vector3d, 2 * kMost> corners;  ///< each function adds one, but for roundings
    std::size_t count = 0;
  };
  void cutOff(const Eigen::Vector3d& function, const Eigen::Vector3d& other);

  std::array<Eigen::Vector3d, kMost> functions_;
  std::size_t count_ = 0;
  Polygon polygon_;
  Polygon cut_;
};

}  // namespace concave_distance::detail
