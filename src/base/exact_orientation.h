#pragma once

#include <Eigen/Core>
#include <array>

namespace concave_distance::detail {

/// Sign of the determinant |q - p, r - p, s - p|: positive where s lies above the triangle (p, q, r), that is
/// on the side from which it runs counter-clockwise. Exact for finite coordinates between 1e-60 and 1e60 in
/// magnitude (and 0): a filter in doubles, then in sums of two, then expansions (Shewchuk 1997).
int orientationSign(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                    const Eigen::Vector3d& s);

/// The determinant itself to a relative error of a few machine epsilons, whatever cancels.
double orientationValue(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                        const Eigen::Vector3d& s);

/// An infinitesimal motion: (x e, y e^2, z e^3), e > 0 infinitesimal, x, y and z 1 or -1.
using Motion = std::array<int, 3>;
inline Motion reversed(const Motion& motion) {
  return {-motion[0], -motion[1], -motion[2]};
}

/// Sign of the vector (q - p) x (s - r) along the motion, exact; 0 only for parallel vectors.
int signAlong(const Motion& motion, const Eigen::Vector3d& p, const Eigen::Vector3d& q,
              const Eigen::Vector3d& r, const Eigen::Vector3d& s);

/// Holds what is compared of two planes that a segment (p, q) runs through.
struct PlaneOnSegment {
  const Eigen::Vector3d* corner[3];
  int side_of_p;  ///< 1 or -1; q is on the other side
};

/// Which of two planes the segment meets first, exact: -1 the first, 1 the second, 0 for both at one point
/// and parallel. Planes that it meets in one point are parted by moving p and q.
int planeOrder(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const PlaneOnSegment& first,
               const PlaneOnSegment& second, const Motion& motion);

}  // namespace concave_distance::detail
