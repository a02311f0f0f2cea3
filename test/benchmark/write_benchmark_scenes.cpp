// Writes pairs of the benchmarks as files that thesis/experiments/*.yaml can name: meshes/evaluation.
//
//   write_benchmark_scenes [--pairs obstacle_field,comb_in_comb,peg_in_hole,kr5_bicep_palm] [--steps 200]
//                          [--output meshes/evaluation] [--all-meshes]
//
// <pair>_a.stl and <pair>_b.stl of the pairs whose bodies have no files of their own (--all-meshes: of all
// pairs, by default of every pair there is), and <pair>.csv, `steps` instants of the motion in its 5 seconds
// (40 Hz by default), pose of B in A's frame.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kSeconds = 5.0;

void writeMotion(const BenchmarkPair& pair, int steps, const std::string& path) {
  std::ofstream file(path);
  file << "t,x,y,z,qx,qy,qz,qw\n";
  file.precision(17);
  for (int k = 0; k < steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const Eigen::Isometry3d pose = pair.motion(share);
    const Eigen::Quaterniond q(pose.linear());
    file << kSeconds * share << ',' << pose.translation().x() << ',' << pose.translation().y() << ','
         << pose.translation().z() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ',' << q.w() << '\n';
  }
  if (!file) throw Error(path, "cannot be written", "name a folder that can be written with --output");
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Writes pairs of the benchmarks as files");
  std::vector<std::string> names = {"obstacle_field", "comb_in_comb", "peg_in_hole", "kr5_bicep_palm"};
  int steps = 200;
  std::string output = std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/evaluation";
  app.add_option("--pairs", names, "Pairs to write")->delimiter(',');
  app.add_option("--steps", steps, "Instants of the motion")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "Folder to write to")->capture_default_str();
  bool all_meshes = false;
  app.add_flag("--all-meshes", all_meshes, "Meshes of every pair; all pairs, unless --pairs names some");
  CLI11_PARSE(app, argc, argv);
  if (all_meshes && app.count("--pairs") == 0) names = allPairs();

  std::filesystem::create_directories(output);
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const std::filesystem::path file = std::filesystem::path(output) / name;
    // Links of robots have mesh files already.
    if (all_meshes || (name.rfind("kr5_", 0) != 0 && name.rfind("wam", 0) != 0)) {
      exportMesh(pair.a->surface(), file.string() + "_a.stl");
      exportMesh(pair.b->surface(), file.string() + "_b.stl");
    }
    writeMotion(pair, steps, file.string() + ".csv");
    std::printf("%s\n", name.c_str());
  }
  return 0;
}

}  // namespace concave_distance::benchmark
