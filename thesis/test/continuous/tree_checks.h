#pragma once

#include <Eigen/Core>

#include "base/random_engine.h"
#include "thesis/src/continuous/constraint_tree.h"
#include "thesis/src/continuous/feasibility.h"

namespace concave_distance::test {

struct InsideComparison {
  int compared = 0;
  int inside = 0;
  int wrong = 0;
  Eigen::Vector3d first_wrong = Eigen::Vector3d::Zero();
};

/// Compares a tree with another answer to "is this point inside?" at random points of the body's box and a
/// little around it. `isNear` tells points so close to the surface that rounding may decide: left out.
template <typename IsInside, typename IsNear>
InsideComparison compareInside(const ConstraintTree& tree, int points, std::uint64_t seed,
                               const IsInside& isInside, const IsNear& isNear) {
  InsideComparison result;
  RandomEngine engine(seed);
  const Eigen::AlignedBox3d& box = tree.boundingBox();
  for (int i = 0; i < points; ++i) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = box.min()[axis] + (1.1 * uniformUnit(engine) - 0.05) * box.sizes()[axis];
    }
    if (isNear(p)) continue;
    const bool is_inside = isInside(p);
    ++result.compared;
    result.inside += is_inside ? 1 : 0;
    if (evaluatePoint(tree, p).is_feasible != is_inside) {
      if (result.wrong++ == 0) result.first_wrong = p;
    }
  }
  return result;
}

}  // namespace concave_distance::test
