#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "region_depth.h"
#include "triangle_pairs.h"

namespace concave_distance::detail {

/// A region, and the flaps that were taken off it, m^2 (CommonFace).
struct FoundRegion {
  InterferenceRegion region;
  double flap_area = 0.0;
};

/// Finds the regions for one infinitesimal motion of B: a pass.
class RegionBuilder {
 public:
  /// Once the limit is reached, passes find nothing. @param known for the passes, too
  void findCandidates(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                      const std::vector<KnownNormal>& known, WorkLimit& limit);
  /// Finds the regions for one motion. Returns whether anything coincided exactly, so that another motion may
  /// give another answer.
  bool pass(const Motion& motion_of_b, std::vector<FoundRegion>& found, WorkLimit& limit);
  bool wasCut() const { return cut_; }

  const WorkingFrame& frame() const { return frame_; }
  /// These belong to the last pass, whose regions' first_facet and first_loop refer to them.
  const std::vector<OverlapFacet>& facets() const { return facets_; }
  const std::vector<Eigen::Vector3d>& loopAreas() const { return loop_areas_; }

 private:
  void addSwallowedShells(PerturbedPredicates& predicates, Side side);
  void buildRegion(const BoundaryComponent& component, FoundRegion& found);
  /// Returns the nearest of the known normals; zero: none.
  Eigen::Vector3d knownNormal(const Eigen::Vector3d& centroid_in_a) const;
  void measureReach(std::vector<FoundRegion>& found);
  void listSurfaces(std::vector<FoundRegion>& found);
  void listLoops(std::vector<FoundRegion>& found);
  void measureDepth(const BoundaryComponent& component, bool solid, const Eigen::Vector3d& vector_area,
                    InterferenceRegion& region);
  /// A segment or node of a curve on which a sheet is crossed.
  struct OfCurve {
    std::uint32_t curve;
    std::uint32_t index;
    bool operator<(const OfCurve& other) const {
      return curve != other.curve ? curve < other.curve : index < other.index;
    }
    bool operator==(const OfCurve& other) const { return curve == other.curve && index == other.index; }
  };
  void addOpenRegions(std::vector<FoundRegion>& found, WorkLimit& limit);
  InterferenceRegion openRegion(std::uint32_t curve, const OfCurve* first_segment,
                                const OfCurve* last_segment, const OfCurve* first_node,
                                const OfCurve* last_node);

  WorkingFrame frame_;
  const std::vector<KnownNormal>* known_ = nullptr;
  bool cut_ = false;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> stack_;
  std::vector<CandidatePair> candidates_;
  CrossingCurves curves_;
  Containment containment_;
  UnionFind sets_;
  SurfacePieces pieces_[2];
  BoundaryComponents components_;
  OverlayDepth overlay_;
  std::vector<std::uint8_t> shell_seen_;
  std::vector<OfCurve> open_segments_;
  std::vector<OfCurve> open_nodes_;
  std::vector<std::uint32_t> component_of_region_;
  std::vector<std::uint32_t> region_of_component_;
  std::vector<OverlapFacet> facets_;
  std::vector<Eigen::Vector3d> loop_areas_;
  std::vector<std::uint32_t> next_loop_;  ///< by region
};

}  // namespace concave_distance::detail
