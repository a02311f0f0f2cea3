// The distance of two mesh files, and every place where they could touch next.
//   two_meshes a.stl b.stl x y z     (where B is, metres, in A's frame)
#include <concave_distance/loading/load_body_mesh.h>
#include <concave_distance/tracking/pair_tracker.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) try {
  using namespace concave_distance;
  if (argc != 6) return std::fputs("usage: two_meshes a.stl b.stl x y z\n", stderr), 2;
  const LoadedBodyMesh a = loadBodyMesh(argv[1]);
  const LoadedBodyMesh b = loadBodyMesh(argv[2]);
  const Eigen::Isometry3d a_from_b(
      Eigen::Translation3d(std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5])));
  const PairSolution solution = solveOnce("a/b", a.mesh, b.mesh, TrackerParameters(), a_from_b);
  std::printf("%s: %.6f m, at least %.6f m\n", toString(solution.status).data(), solution.distance,
              solution.lower_bound);
  for (const TrackedNiche& niche : solution.niches) {
    std::printf("niche %.6f m at %.4f %.4f %.4f\n", niche.distance, niche.point_a_in_a.x(),
                niche.point_a_in_a.y(), niche.point_a_in_a.z());
  }
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "two_meshes: %s\n", problem.what());
  return 1;
}
