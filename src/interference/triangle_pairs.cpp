#include "triangle_pairs.h"

#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {
namespace {

/// Boxes along A's axes against boxes along B's: the separating axes of Gottschalk et al. (1996), with a
/// margin for rounding.
class BoxesMeet {
 public:
  BoxesMeet(const Eigen::Isometry3d& a_from_b, double margin)
      : rotation_(a_from_b.linear()), translation_(a_from_b.translation()), margin_(margin) {
    // The cross product of nearly parallel axes says nothing: such a test must not part anything.
    magnitude_ = rotation_.cwiseAbs().array() + 1e-12;
  }

  bool operator()(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) const {
    const Eigen::Vector3d half_a = 0.5 * a.sizes() + Eigen::Vector3d::Constant(margin_);
    const Eigen::Vector3d half_b = 0.5 * b.sizes() + Eigen::Vector3d::Constant(margin_);
    const Eigen::Vector3d displacement = rotation_ * b.center() + translation_ - a.center();
    for (int i = 0; i < 3; ++i) {
      if (std::abs(displacement[i]) > half_a[i] + magnitude_.row(i).dot(half_b)) return false;
    }
    for (int j = 0; j < 3; ++j) {
      if (std::abs(rotation_.col(j).dot(displacement)) > half_b[j] + magnitude_.col(j).dot(half_a))
        return false;
    }
    for (int i = 0; i < 3; ++i) {
      const int i1 = (i + 1) % 3;
      const int i2 = (i + 2) % 3;
      for (int j = 0; j < 3; ++j) {
        const int j1 = (j + 1) % 3;
        const int j2 = (j + 2) % 3;
        const double reach = half_a[i1] * magnitude_(i2, j) + half_a[i2] * magnitude_(i1, j) +
                             half_b[j1] * magnitude_(i, j2) + half_b[j2] * magnitude_(i, j1);
        if (std::abs(displacement[i2] * rotation_(i1, j) - displacement[i1] * rotation_(i2, j)) > reach)
          return false;
      }
    }
    return true;
  }

 private:
  Eigen::Matrix3d rotation_;
  Eigen::Matrix3d magnitude_;
  Eigen::Vector3d translation_;
  double margin_;
};

}  // namespace

bool collectCandidates(const WorkingFrame& frame, std::vector<std::pair<std::uint32_t, std::uint32_t>>& stack,
                       std::vector<CandidatePair>& candidates, WorkLimit& limit) {
  const TriangleTree& tree_a = frame.body(Side::A).tree();
  const TriangleTree& tree_b = frame.body(Side::B).tree();
  const BoxesMeet meet(frame.aFromB(), frame.roundingBound());
  candidates.clear();
  stack.assign(1, {0U, 0U});
  while (!stack.empty()) {
    if (limit.isOverNow()) return false;
    const auto [index_a, index_b] = stack.back();
    stack.pop_back();
    const TriangleTree::Node& a = tree_a.nodes()[index_a];
    const TriangleTree::Node& b = tree_b.nodes()[index_b];
    if (!meet(a.box, b.box)) continue;
    if (a.count > 0 && b.count > 0) {
      for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
        for (std::uint32_t j = b.first; j < b.first + b.count; ++j) {
          if (!limit.admits(candidates.size() + 1)) return false;
          candidates.push_back({tree_a.order()[i], tree_b.order()[j]});
        }
      }
    } else if (b.count > 0 || (a.count == 0 && a.box.sizes().sum() >= b.box.sizes().sum())) {
      stack.emplace_back(a.first, index_b);
      stack.emplace_back(index_a + 1, index_b);
    } else {
      stack.emplace_back(index_a, b.first);
      stack.emplace_back(index_a, index_b + 1);
    }
  }
  return true;
}

}  // namespace concave_distance::detail
