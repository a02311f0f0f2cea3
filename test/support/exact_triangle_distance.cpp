#include "support/exact_triangle_distance.h"

namespace concave_distance::test {

template Wide exactSquaredDistance(const ExactTriangle<Wide>& a, const ExactTriangle<Wide>& b);

double exactDistance(const TrianglePoints& a, const TrianglePoints& b) {
  return static_cast<double>(boost::multiprecision::sqrt(exactSquaredDistance<Wide>(a, b)));
}

double exactDistance(const Eigen::Vector3d& point, const TrianglePoints& t) {
  return exactDistance(TrianglePoints{point, point, point}, t);
}

double exactDistanceError(double computed, const TrianglePoints& a, const TrianglePoints& b) {
  const Wide exact = boost::multiprecision::sqrt(exactSquaredDistance<Wide>(a, b));
  return static_cast<double>(boost::multiprecision::abs(exact - Wide(computed)));
}

}  // namespace concave_distance::test
