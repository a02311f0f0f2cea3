#include <concave_distance/mesh/body_mesh.h>
#include <concave_distance/mesh/primitives.h>
#include <concave_distance/tracking/pair_tracker.h>

#include <cmath>
#include <cstdio>
#include <memory>

// Two unit cubes, their faces 0.5 m apart; exits with 0 when the library says so.
int main() {
  using namespace concave_distance;
  const auto cube = std::make_shared<BodyMesh>("cube", makeBox({1, 1, 1}), BodyMeshOptions{});
  const Eigen::Isometry3d a_from_b(Eigen::Translation3d(1.5, 0, 0));
  const PairSolution solution = solveOnce("cubes", cube, cube, TrackerParameters{}, a_from_b);
  std::printf("distance %.17g m, %zu niche(s)\n", solution.distance, solution.niches.size());
  return std::abs(solution.distance - 0.5) < 1e-12 ? 0 : 1;
}
