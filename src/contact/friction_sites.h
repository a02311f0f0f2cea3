#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "patch_cells.h"

namespace concave_distance {

/// A small part of a patch, on which friction acts as one.
struct FrictionSite {
  std::uint64_t cell;          ///< of space, in A's frame, and the direction of the push
  Eigen::Vector3d point_in_a;  ///< centre of the pressure
  Eigen::Vector3d push_in_a;   ///< unit, on B
  double force;                ///< N, > 0
  /// Root of the mean square, by pressure, of the distance to the centre along one direction of the tangent
  /// plane, of two: the site spins with the angular velocity times this.
  double spread;
};

/// Gathers the sites of one patch. Samples that stand for triangles wider than a cell are spread over them:
/// a large face has few samples, on the edges of its triangles.
class FrictionSites {
 public:
  /// @param forces of the samples, N
  void gather(const OverlapSample* first_sample, const OverlapSample* last_sample,
              const std::vector<double>& forces, double cell_size);
  const std::vector<FrictionSite>& all() const { return sites_; }

 private:
  struct Share {
    std::uint64_t cell;
    double force;
    Eigen::Vector3d push;     ///< times the force
    Eigen::Vector3d place;    ///< from the first sample, times the force
    Eigen::Matrix3d squares;  ///< of the place, times the force

    void join(const Share& other) {
      force += other.force;
      push += other.push;
      place += other.place;
      squares += other.squares;
    }
  };
  /// The pressure is linear on such a triangle.
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    std::array<double, 3> forces;  ///< all of it, if the pressure were that of the corner
  };

  static bool isTriangle(const OverlapSample* sample);
  static Triangle triangleOf(const OverlapSample* sample, const double* forces);
  void spread(const Triangle& triangle, const Eigen::Vector3d& push, double longest_edge);
  void addPart(const Triangle& part, const Eigen::Vector3d& push);
  void addPoint(const Eigen::Vector3d& point, const Eigen::Vector3d& push, double force);
  void addSite(const Share& sum);

  Eigen::Vector3d origin_;
  double cell_size_ = 0.0;
  CellSums<Share> shares_;
  std::vector<Triangle> parts_;
  std::vector<FrictionSite> sites_;
};

}  // namespace concave_distance
