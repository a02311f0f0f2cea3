#include "meeting_pairs.h"

#include <cmath>

#include "mesh/trees/triangle_tree.h"
#include "shell_material.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

Eigen::AlignedBox3d movedBox(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& a_from_b) {
  const Vector3d centre = a_from_b * box.center();
  const Vector3d half = 0.5 * (a_from_b.linear().cwiseAbs() * box.sizes());
  return {centre - half, centre + half};
}

}  // namespace

void collectMeetingPairs(const PairFrame& frame, std::vector<TreeNodePair>& open,
                         std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost, WorkLimit& limit) {
  const TriangleTree& tree_a = frame.a.tree();
  const TriangleTree& tree_b = frame.b.tree();
  const double slack = frame.touchingDistance();
  // Boxes are compared in A's own frame, far from whose origin coordinates round coarser.
  const double origin = frame.a.surface().boundingBox().center().cwiseAbs().maxCoeff() +
                        frame.b.surface().boundingBox().center().cwiseAbs().maxCoeff();
  const double margin = slack + 1e-14 * (origin + frame.size);
  open.clear();
  if (!limit.makeRoom(open)) return;
  open.emplace_back(0U, 0U);
  while (!open.empty()) {
    if (limit.isOverNow() || !limit.makeRoom(open, 2)) return;
    const auto [i, j] = open.back();
    open.pop_back();
    const TriangleTree::Node& a = tree_a.nodes()[i];
    const TriangleTree::Node& b = tree_b.nodes()[j];
    ++cost.node_pairs;
    if (a.box.squaredExteriorDistance(movedBox(b.box, frame.a_from_b)) > margin * margin) continue;
    if (a.count > 0 && b.count > 0) {
      for (std::uint32_t k = a.first; k < a.first + a.count; ++k) {
        for (std::uint32_t l = b.first; l < b.first + b.count; ++l) {
          const TriangleIndex ta = tree_a.order()[k];
          const TriangleIndex tb = tree_b.order()[l];
          if (frame.a.shellContacts().isHidden(ta) || frame.b.shellContacts().isHidden(tb)) continue;
          ++cost.candidates;
          const TrianglePairDistance closest = triangleDistance(frame.cornersOfA(ta), frame.cornersOfB(tb));
          if (closest.squared_distance > slack * slack) continue;
          const Eigen::Vector3d point = closest.point_a + frame.centre_a;
          if (isInsideMaterial(frame, {0.0, point, point, ta, tb})) continue;
          if (!limit.makeRoom(candidates)) return;
          const double distance = std::sqrt(closest.squared_distance);
          candidates.push_back(candidateOn(ta, tb, distance > 4.0 * frame.rounding ? distance : 0.0));
        }
      }
    } else if (b.count > 0 || (a.count == 0 && a.box.sizes().sum() >= b.box.sizes().sum())) {
      open.emplace_back(i + 1, j);
      open.emplace_back(a.first, j);
    } else {
      open.emplace_back(i, j + 1);
      open.emplace_back(i, b.first);
    }
  }
}

}  // namespace concave_distance::detail
