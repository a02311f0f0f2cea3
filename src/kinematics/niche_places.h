#pragma once

#include <Eigen/Core>
#include <vector>

#include "concave_distance/scene/tracked_pair.h"
#include "distance/niches/niche_corners.h"

namespace concave_distance::detail {

/// One place of a niche that a row is for, in A's frame.
struct NichePlace {
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double value = 0.0;  ///< metres, signed
  bool is_overlapping = false;
};

/// Finds the places of a niche: its points, or the corners of what is level with them (findCorners()); its
/// points too where they are nearer than every corner. The one source of signed values of rows.
class NichePlaces {
 public:
  /// @param tilt ConstraintSettings::tilt
  explicit NichePlaces(double tilt) : tilt_(tilt) {}
  /// @param pair solved, with this niche
  const std::vector<NichePlace>& of(const TrackedPair& pair, const TrackedNiche& niche);

 private:
  double tilt_;
  CornerWorkspace workspace_;
  std::vector<NichePlace> places_;
};

}  // namespace concave_distance::detail
