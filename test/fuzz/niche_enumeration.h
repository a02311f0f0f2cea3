#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "fuzz/wide_body.h"

/// Every niche of a pair of surfaces by enumeration, for niche_hunt: the distance of all pairs of triangles
/// and of all that neighbours have in common, in long double, and 0-dimensional persistence over them; places
/// where the bodies meet are joined by the parts of their overlap (wide_overlap.h). No normal cones, no
/// floods, no code of the package.
namespace concave_distance::test {

/// What the segment between two points is like. Unclear: rounding decides.
enum class Clarity : std::uint8_t { Yes, No, Unclear };

struct WitnessPoints {
  WidePoint a;
  WidePoint b;
};

struct EnumeratedNiche {
  long double distance;  ///< metres
  long double pass;      ///< metres, lowest to a deeper niche; infinite for the deepest
  /// Whether it has the least prominence by more than rounding; else it may be listed.
  bool is_certain;
  bool is_tied;  ///< another minimum is as deep, up to rounding
  /// Pairs of triangles (a * count_b + b), ascending, with a point pair of the niche; where several minima
  /// that are equal up to rounding would be one niche, those of all.
  std::vector<std::size_t> cells;
};

class NicheEnumeration {
 public:
  /// The pose is taken as it is: a point of B is at linear * p + translation.
  NicheEnumeration(const WideBody& a, const WideBody& b, const Eigen::Isometry3d& a_from_b);

  /// Two distances that differ by less count as equal, metres: twice what the package may tell from each
  /// other.
  long double tolerance() const { return tolerance_; }
  long double least() const { return least_; }
  std::size_t cellOf(std::size_t triangle_a, std::size_t triangle_b) const {
    return triangle_a * count_b_ + triangle_b;
  }
  long double distanceOf(std::size_t cell) const { return distance_[cell]; }
  /// Between the two triangles of a cell that is no surface.
  long double distanceWithinMaterial(std::size_t cell) const;
  /// How far a point is from the cell's triangle of A or B.
  long double offTriangles(std::size_t cell, const WitnessPoints& points) const;

  /// Ascending by distance.
  /// @param margin metres, of both bodies together: the prominence is that of distances less this, and places
  /// within it are one niche where they are connected
  std::vector<EnumeratedNiche> niches(double least_prominence, double margin = 0.0) const;

  /// Closest points of the two triangles of a cell: the corners of that set, and their mean.
  std::vector<WitnessPoints> minimisers(std::size_t cell) const;
  /// Whether some place of a niche at distance 0, where triangles cross, lies in no material of other shells
  /// of the same body; No also where no triangles cross.
  Clarity isMeetingInSight(const EnumeratedNiche& niche) const;
  /// Whether no triangle meets the open segment.
  Clarity isVisible(const WitnessPoints& points) const;
  /// Whether the segment leaves both bodies outwards, or rather does not run into material of closed shells.
  Clarity isOutward(const WitnessPoints& points) const;

 private:
  struct Pass {
    long double level;
    std::size_t l;
    std::size_t r;
  };
  void measurePasses();
  void joinOverlap();
  void spread(EnumeratedNiche& niche) const;
  /// Cells that are connected with one below a level.
  void appendPlateau(std::size_t cell, long double level, std::vector<std::size_t>& cells) const;
  /// A point of A's frame in B's. The pose is orthonormal up to rounding.
  WidePoint movedBack(const WidePoint& p) const;
  Clarity leaves(const WideBody& body, const WidePoint& from, const WidePoint& to, bool is_of_b) const;

  const WideBody& a_;
  const WideBody& b_;
  Eigen::Isometry3d pose_;
  std::size_t count_b_;
  std::vector<WideTriangle> triangles_a_;
  std::vector<WideTriangle> triangles_b_;  ///< in A's frame
  std::vector<long double> distance_;      ///< of cells; infinite for what is no surface
  std::vector<Pass> passes_;               ///< ascending
  std::vector<std::vector<std::size_t>> passes_of_;
  bool is_overlap_clear_ = true;  ///< false: whether the overlap is that of convex solids is for rounding
  long double tolerance_ = 0.0L;
  long double size_ = 0.0L;
  long double least_ = 0.0L;
};

}  // namespace concave_distance::test
