#pragma once

#include <Eigen/Core>

namespace concave_distance::detail {

/// Sign of the determinant |q - p, r - p, s - p|: positive where s lies above the triangle (p, q, r), that is
/// on the side from which it runs counter-clockwise. Exact for finite coordinates between 1e-60 and 1e60 in
/// magnitude (and 0): a filter in doubles, then in sums of two, then expansions (Shewchuk 1997).
int orientationSign(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                    const Eigen::Vector3d& s);

/// The determinant itself to a relative error of a few machine epsilons, whatever cancels.
double orientationValue(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                        const Eigen::Vector3d& s);

/// Sign of the first coordinate of (q - p) x (s - r) that is not zero, exact; 0 for parallel vectors.
int firstSignOfCross(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                     const Eigen::Vector3d& s);

/// What is compared of two planes that a segment (p, q) runs through.
struct PlaneOnSegment {
  const Eigen::Vector3d* corner[3];
  int side_of_p;  ///< 1 or -1; q is on the other side
};

/// Which of two planes the segment meets first, exact: -1 the first, 1 the second, 0 for both at one point
/// and parallel. Planes that it meets in one point are parted by moving p and q by
/// `motion` * (e, e^2, e^3), e infinitesimal.
int planeOrder(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const PlaneOnSegment& first,
               const PlaneOnSegment& second, int motion);

}  // namespace concave_distance::detail
