#include "containment.h"

#include <cmath>

#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

/// Slanted against the axes and their diagonals. Both bodies measure less than 2 in the working frame: 16
/// leads out.
const Eigen::Vector3d kExit = 16.0 * Eigen::Vector3d(0.8431, 0.2749, 0.4620);

/// Decides whether a segment may meet a box, by separating axes with a margin.
class SegmentMeetsBox {
 public:
  SegmentMeetsBox(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin)
      : middle_(0.5 * (from + to)), half_(0.5 * (to - from)), margin_(margin) {}

  bool operator()(const Eigen::AlignedBox3d& box) const {
    const Eigen::Vector3d reach = 0.5 * box.sizes() + Eigen::Vector3d::Constant(margin_);
    const Eigen::Vector3d displacement = middle_ - box.center();
    for (int i = 0; i < 3; ++i) {
      if (std::abs(displacement[i]) > reach[i] + std::abs(half_[i])) return false;
    }
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      const double slack = 1e-12 * (std::abs(half_[j]) + std::abs(half_[k])) * (reach[j] + reach[k]);
      if (std::abs(displacement[j] * half_[k] - displacement[k] * half_[j]) >
          reach[j] * std::abs(half_[k]) + reach[k] * std::abs(half_[j]) + slack)
        return false;
    }
    return true;
  }

 private:
  Eigen::Vector3d middle_;
  Eigen::Vector3d half_;
  double margin_;
};

/// 1 where the segment leaves through the triangle's front, -1 where it enters, 0 where it misses.
int crossing(PerturbedPredicates& predicates, const Corners& triangle, Side body, const Eigen::Vector3d& from,
             const Eigen::Vector3d& to) {
  const int side = predicates.side(triangle, body, from);
  if (side == 0 || predicates.side(triangle, body, to) == side) return 0;
  int passing[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& p = *triangle[k];
    const Eigen::Vector3d& q = *triangle[(k + 1) % 3];
    passing[k] = body == Side::A ? predicates.passing(from, to, p, q) : predicates.passing(p, q, from, to);
  }
  return passing[0] == passing[1] && passing[1] == passing[2] ? -side : 0;
}

}  // namespace

int Containment::winding(WorkingFrame& frame, PerturbedPredicates& predicates, Side body,
                         const Eigen::Vector3d& point) {
  const Side holder = other(body);
  const BodyMesh& holding = frame.body(holder);
  const MeshTopology& topology = holding.topology();
  const Eigen::Vector3d end = point + kExit;
  const Eigen::Vector3d from = frame.pointInBody(holder, point);
  const Eigen::Vector3d to = frame.pointInBody(holder, end);
  const double margin = frame.roundingBound();
  const SegmentMeetsBox meets(from, to, margin);
  const Eigen::AlignedBox3d& box = holding.surface().boundingBox();
  if (box.squaredExteriorDistance(from) > margin * margin) return 0;
  int winding = 0;
  stack_.assign(1, 0U);
  while (!stack_.empty()) {
    const std::uint32_t index = stack_.back();
    stack_.pop_back();
    const TriangleTree::Node& node = holding.tree().nodes()[index];
    if (!meets(node.box)) continue;
    if (node.count == 0) {
      stack_.push_back(node.first);
      stack_.push_back(index + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const TriangleIndex triangle = holding.tree().order()[i];
      if (!topology.isOnClosedShell(triangle)) continue;
      winding += crossing(predicates, frame.corners(holder, triangle), body, point, end);
    }
  }
  return winding;
}

}  // namespace concave_distance::detail
