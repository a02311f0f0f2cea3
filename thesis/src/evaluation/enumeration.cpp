#include "enumeration.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <vector>

#include "base/constants.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"

namespace concave_distance {

TrialPoint enumerateNodePairs(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const std::vector<Eigen::Vector3d>& nodes_a = gridOf(a).graph().positions;
  std::vector<Eigen::Vector3d> nodes_b = gridOf(b).graph().positions;
  for (Eigen::Vector3d& node : nodes_b) node = a_from_b * node;
  const TrialPoint worst{NodeIndex{0}, NodeIndex{0}, kInfinity};
  // Ties go to the smaller indices, so that the answer does not depend on how the range was split.
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, nodes_a.size()), worst,
      [&](const tbb::blocked_range<std::size_t>& range, TrialPoint best) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          for (std::size_t j = 0; j < nodes_b.size(); ++j) {
            best = std::min(best,
                            TrialPoint{NodeIndex{i}, NodeIndex{j}, (nodes_a[i] - nodes_b[j]).squaredNorm()});
          }
        }
        return best;
      },
      [](const TrialPoint& l, const TrialPoint& r) { return std::min(l, r); });
}

}  // namespace concave_distance
