#include <concave_distance/loading/load_body_mesh.h>
#include <concave_distance/mesh/import/export_mesh.h>
#include <concave_distance/mesh/surface/primitives.h>
#include <concave_distance/tracking/pair_tracker.h>

#include <cmath>
#include <cstdio>
#include <string>

// Two unit cubes, their faces 0.5 m apart; exits with 0 when the library says so. They come from a file: the
// program that reads mesh files is found where the library is.
int main(int /*argc*/, char** argv) {
  using namespace concave_distance;
  const std::string path = std::string(argv[0]) + "_cube.obj";
  exportMesh(makeBox({1, 1, 1}), path);
  const auto cube = loadBodyMesh(path).mesh;
  const Eigen::Isometry3d a_from_b(Eigen::Translation3d(1.5, 0, 0));
  const PairSolution solution = solveOnce("cubes", cube, cube, TrackerParameters{}, a_from_b);
  std::printf("distance %.17g m, %zu niche(s)\n", solution.distance, solution.niches.size());
  return std::abs(solution.distance - 0.5) < 1e-12 ? 0 : 1;
}
