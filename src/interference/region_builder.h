#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "region_depth.h"
#include "triangle_pairs.h"

namespace concave_distance::detail {

/// A region with what only the comparison of two passes needs.
struct FoundRegion {
  InterferenceRegion region;
  Eigen::Vector3d vector_area = Eigen::Vector3d::Zero();  ///< m^2, of A's part
};

/// Finds the regions for one infinitesimal motion of B: a pass.
class RegionBuilder {
 public:
  void findCandidates(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b);
  /// Whether anything coincided exactly, so that another motion may give another answer.
  bool pass(int direction, std::vector<FoundRegion>& found);
  /// The depth along another normal than the pass's own; `index` counts the regions of the last pass.
  void measureDepth(std::uint32_t index, const Eigen::Vector3d& vector_area, InterferenceRegion& region);

  const WorkingFrame& frame() const { return frame_; }

 private:
  void addSwallowedShells(PerturbedPredicates& predicates, Side side);
  void buildRegion(const BoundaryComponent& component, FoundRegion& found);
  void measureReach(std::vector<FoundRegion>& found);
  void addOpenRegions(std::vector<FoundRegion>& found);
  InterferenceRegion openRegion(std::uint32_t curve);

  WorkingFrame frame_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_;
  std::vector<CandidatePair> candidates_;
  CrossingCurves curves_;
  Containment containment_;
  ElementSets sets_;
  SurfacePieces pieces_[2];
  BoundaryComponents components_;
  OverlayDepth overlay_;
  std::vector<std::uint8_t> shell_seen_;
  std::vector<std::uint8_t> curve_seen_;
  std::vector<std::uint32_t> component_of_region_;
  std::vector<std::uint32_t> region_of_component_;
};

}  // namespace concave_distance::detail
