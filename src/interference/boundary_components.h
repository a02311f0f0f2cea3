#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/union_find.h"
#include "crossings.h"
#include "surface_pieces.h"

namespace concave_distance::detail {

/// A connected piece of the boundary of the overlap: pieces of both surfaces joined along their loops. All
/// numbers in the working frame.
struct BoundaryComponent {
  Eigen::Vector3d reference;                         ///< a point of it
  double volume = 0.0;                               ///< negative for the wall of a cavity
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< volume times its centroid, from `reference`
  double area[2] = {0.0, 0.0};                       ///< of A's and of B's surface
  Eigen::Vector3d area_moment = Eigen::Vector3d::Zero();
  /// The squares of the normals, summed up by area: which way the pieces face, whatever cancels.
  Eigen::Matrix3d facing = Eigen::Matrix3d::Zero();
  Eigen::Vector3d vector_area = Eigen::Vector3d::Zero();  ///< of A's part, from the loops
  /// Flaps (CommonFace) have this area, which is in both bodies' areas.
  double flap_area = 0.0;
  Eigen::Vector3d flap_vector_area = Eigen::Vector3d::Zero();
  /// Half of the common faces that face the same way adds this to A's part and takes it from B's.
  double shared_area = 0.0;
  Eigen::Vector3d shared_vector_area = Eigen::Vector3d::Zero();
  double loop_area = 0.0;  ///< the lengths of each loop's vector area, added up
  std::uint32_t loop_count = 0;
  std::uint32_t first_node = kNone;  ///< of a loop
  std::uint32_t first_edge[2] = {0, 0};
  std::uint32_t last_edge[2] = {0, 0};
  std::uint32_t first_whole[2] = {0, 0};
  std::uint32_t last_whole[2] = {0, 0};
  std::uint32_t next_cavity = kNone;  ///< of the region that this one begins
  bool is_cavity = false;             ///< belongs to another's region
  bool closed = true;                 ///< false for an open shell inside the other body
  bool consistent = true;

  double surface() const { return area[0] + area[1]; }
};

/// Sorts the pieces by component and triangle and measures each component by sums over its boundary edges;
/// joins cavities to what is around them. Incomplete once the limit is reached.
class BoundaryComponents {
 public:
  void build(WorkingFrame& frame, const CrossingCurves& curves, SurfacePieces (&pieces)[2], UnionFind& sets,
             WorkLimit& limit);
  const std::vector<BoundaryComponent>& all() const { return components_; }
  std::vector<BoundaryComponent>& all() { return components_; }
  /// Returns for each of the curves' common faces the component that it belongs to; kNone: none.
  const std::vector<std::uint32_t>& componentOfCommonFace() const { return component_of_common_face_; }
  /// The loop of each node, named by one of its nodes.
  std::uint32_t loopOf(std::uint32_t node) { return loops_.find(node); }
  /// Vector area of A's side of a loop named so.
  const Eigen::Vector3d& vectorAreaOfLoop(std::uint32_t loop) const { return loop_vector_areas_[loop]; }
  std::uint32_t componentOfNode(std::uint32_t node, UnionFind& sets) const {
    return component_of_element_[sets.find(node)];
  }

 private:
  std::uint32_t componentOf(std::uint32_t element, UnionFind& sets);
  void sortPieces(SurfacePieces& pieces, Side side, UnionFind& sets);
  void measureLoops(const CrossingCurves& curves, UnionFind& sets);
  void measureSurface(WorkingFrame& frame, const SurfacePieces& pieces, Side side);
  void measureCommonFaces(const WorkingFrame& frame, const CrossingCurves& curves,
                          const SurfacePieces (&pieces)[2], WorkLimit& limit);
  void joinCavities(WorkingFrame& frame, const SurfacePieces (&pieces)[2], WorkLimit& limit);
  double windingOf(WorkingFrame& frame, const SurfacePieces (&pieces)[2], const BoundaryComponent& component,
                   const Eigen::Vector3d& point) const;

  std::vector<BoundaryComponent> components_;
  std::vector<std::uint32_t> component_of_element_;
  std::vector<std::uint32_t> component_of_common_face_;
  UnionFind loops_;
  std::vector<Eigen::Vector3d> loop_vector_areas_;
  std::vector<std::uint8_t> loop_seen_;
};

/// Calls visit(triangle) for each triangle of one side of a component that lies wholly inside.
template <typename Visit>
void forEachWholeTriangle(const SurfacePieces& pieces, const BoundaryComponent& component, Side side,
                          const Visit& visit) {
  for (std::uint32_t i = component.first_whole[at(side)]; i < component.last_whole[at(side)]; ++i) {
    visit(pieces.wholes()[i].triangle);
  }
}

/// Calls visit(triangle, first edge, last edge) for each crossed triangle's edges of one side of a component.
template <typename Visit>
void forEachCutTriangle(const SurfacePieces& pieces, const BoundaryComponent& component, Side side,
                        const Visit& visit) {
  const std::vector<PieceEdge>& edges = pieces.edges();
  for (std::uint32_t first = component.first_edge[at(side)]; first < component.last_edge[at(side)];) {
    std::uint32_t last = first + 1;
    while (last < component.last_edge[at(side)] && edges[last].triangle == edges[first].triangle) ++last;
    visit(edges[first].triangle, first, last);
    first = last;
  }
}

}  // namespace concave_distance::detail
