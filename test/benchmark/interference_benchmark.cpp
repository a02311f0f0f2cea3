// Interference regions beside CGAL's Booleans: are volumes, areas and numbers of regions right, what do they
// cost, and what becomes of the depth when the tessellation changes.
//
//   interference_benchmark [--pairs 10000] [--lattice-pairs 2000] [--first 0]
//                          [--output doc/results/interference.csv]
//
// First table: random concave pairs, `pairs` of which overlap, against CGAL's exact Booleans, and the same
// against the bodies swapped, both moved, and scaled by 1e-3 and 1e3; then pairs on a lattice, where nearly
// everything is flush. Errors are in units of what is allowed, 1e-9 of the value or 1e-12 L^k for bodies of
// size L; `other count` is the number of pairs with another number of regions than the reference (solids that
// hang together along an edge alone are one or two), `none known` of pairs that CGAL gives up. On the lattice
// only sums over a pair's regions are compared. Second table: microseconds of findInterference, of CGAL's
// corefinement (inexact constructions; exact), and of FCL's enumeration of contacts, the fastest of some
// runs, meshes ready. Third: the depth when every edge is halved 0 to 3 times, ours and that of the deepest
// vertex.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/cgal_times.h"
#include "benchmark/support/interference_scenes.h"
#include "benchmark/support/interference_trials.h"
#include "benchmark/support/stopwatch.h"
#include "support/body_pairs.h"
#include "support/mesh_variants.h"

namespace concave_distance::benchmark {
namespace {

constexpr int kHalvings = 4;

void printErrors(const char* name, const InterferenceErrors& e, std::ofstream& csv) {
  std::printf("%-18s %7zu %7zu %7zu %7zu %7zu %9.2g %9.2g %9.2g %8lu\n", name, e.pairs, e.regions, e.several,
              e.miscounted, e.unknown, e.volume, e.area, e.depth, static_cast<unsigned long>(e.worst_seed));
  std::fflush(stdout);
  csv << "truth," << name << ',' << e.pairs << ',' << e.regions << ',' << e.several << ',' << e.miscounted
      << ',' << e.unknown << ',' << e.volume << ',' << e.area << ',' << e.depth << ',' << e.worst_seed
      << '\n';
}

Interference askScaled(const InterferencePair& pair, double factor, InterferenceWorkspace& workspace) {
  Eigen::Isometry3d pose = pair.a_from_b;
  pose.translation() *= factor;
  Interference result;
  findInterference(*test::makeBody(test::scaledSurface(pair.a, factor)),
                   *test::makeBody(test::scaledSurface(pair.b, factor)), pose, workspace, result);
  return result;
}

void compareRandomPairs(std::size_t pairs, std::uint64_t first, std::ofstream& csv) {
  InterferenceErrors cgal;
  InterferenceErrors swapped;
  InterferenceErrors moved;
  InterferenceErrors small;
  InterferenceErrors large;
  InterferenceWorkspace workspace;
  Interference result;
  Interference other;
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(3, -2, 1) *
      Eigen::Isometry3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, -5, 8).normalized()));
  for (std::uint64_t seed = first; cgal.pairs < pairs; ++seed) {
    const InterferencePair pair = randomInterferencePair(seed);
    const auto a = test::makeBody(pair.a);
    const auto b = test::makeBody(pair.b);
    findInterference(*a, *b, pair.a_from_b, workspace, result);
    compareWithCgal(pair, result, false, seed, cgal);
    findInterference(*b, *a, pair.a_from_b.inverse(), workspace, other);
    compareAnswers(pair, result, other, true, false, 1.0, seed, swapped);
    findInterference(*test::makeBody(test::movedSurface(pair.a, motion)), *b, motion * pair.a_from_b,
                     workspace, other);
    compareAnswers(pair, result, other, false, false, 1.0, seed, moved);
    compareAnswers(pair, result, askScaled(pair, 1e-3, workspace), false, false, 1e3, seed, small);
    compareAnswers(pair, result, askScaled(pair, 1e3, workspace), false, false, 1e-3, seed, large);
  }
  printErrors("CGAL", cgal, csv);
  printErrors("swapped", swapped, csv);
  printErrors("moved", moved, csv);
  printErrors("scaled by 1e-3", small, csv);
  printErrors("scaled by 1e3", large, csv);
}

void compareLatticePairs(std::size_t pairs, std::uint64_t first, std::ofstream& csv) {
  InterferenceErrors cgal;
  InterferenceErrors swapped;
  InterferenceWorkspace workspace;
  Interference result;
  Interference other;
  for (std::uint64_t seed = first; cgal.pairs < pairs; ++seed) {
    const InterferencePair pair = latticeInterferencePair(seed);
    const auto a = test::makeBody(pair.a);
    const auto b = test::makeBody(pair.b);
    findInterference(*a, *b, pair.a_from_b, workspace, result);
    compareWithCgal(pair, result, true, seed, cgal);
    findInterference(*b, *a, pair.a_from_b.inverse(), workspace, other);
    compareAnswers(pair, result, other, true, true, 1.0, seed, swapped);
  }
  printErrors("lattice: CGAL", cgal, csv);
  printErrors("lattice: swapped", swapped, csv);
}

void timeScene(const InterferenceScene& scene, std::ofstream& csv) {
  const auto a = test::makeBody(scene.pair.a);
  const auto b = test::makeBody(scene.pair.b);
  InterferenceWorkspace workspace;
  Interference result;
  const double ours =
      1e-6 * fastest([&] { findInterference(*a, *b, scene.pair.a_from_b, workspace, result); });
  const SurfaceMesh b_in_a = test::movedSurface(scene.pair.b, scene.pair.a_from_b);
  const double fast = cgalFastOverlapTime(scene.pair.a, b_in_a);
  const double exact = cgalExactOverlapTime(scene.pair.a, b_in_a);
  const FclContacts fcl = fclContacts(scene.pair);
  std::printf("%-18s %9zu %8zu %9.1f %11.1f %8.0f %11.1f %8.0f %9.1f %7.2f %8zu\n", scene.name.c_str(),
              scene.pair.a.triangleCount() + scene.pair.b.triangleCount(), result.regions.size(), 1e6 * ours,
              1e6 * fast, fast / ours, 1e6 * exact, exact / ours, 1e6 * fcl.seconds, fcl.seconds / ours,
              fcl.count);
  std::fflush(stdout);
  csv << "time," << scene.name << ',' << scene.pair.a.triangleCount() + scene.pair.b.triangleCount() << ','
      << result.regions.size() << ',' << 1e6 * ours << ',' << 1e6 * fast << ',' << 1e6 * exact << ','
      << 1e6 * fcl.seconds << ',' << fcl.count << '\n';
}

void compareHalvings(const InterferenceScene& scene, std::ofstream& csv) {
  SurfaceMesh a = scene.pair.a;
  SurfaceMesh b = scene.pair.b;
  InterferenceWorkspace workspace;
  Interference result;
  double ours[kHalvings];
  double of_vertices[kHalvings];
  for (int halving = 0; halving < kHalvings; ++halving) {
    if (halving > 0) {
      a = test::halvedEdges(a);
      b = test::halvedEdges(b);
    }
    const auto body_a = test::makeBody(a);
    const auto body_b = test::makeBody(b);
    findInterference(*body_a, *body_b, scene.pair.a_from_b, workspace, result);
    ours[halving] = result.regions.empty() ? 0.0 : result.regions.front().depth_along_normal;
    of_vertices[halving] = vertexDepth(*body_a, *body_b, scene.pair.a_from_b);
  }
  std::printf("%-18s", scene.name.c_str());
  csv << "halving," << scene.name;
  for (const double depth : ours) {
    std::printf(" %19.16f", depth);
    csv << ',' << depth;
  }
  std::printf("  ");
  for (const double depth : of_vertices) {
    std::printf(" %8.5f", depth);
    csv << ',' << depth;
  }
  std::printf("\n");
  csv << '\n';
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Interference regions: right against CGAL's Booleans, what they cost, and the tessellation");
  std::size_t pairs = 10000;
  std::size_t lattice_pairs = 2000;
  std::uint64_t first = 0;
  std::string output;
  app.add_option("--pairs", pairs, "Random pairs that overlap");
  app.add_option("--lattice-pairs", lattice_pairs, "Pairs on a lattice that overlap");
  app.add_option("--first", first, "Seed of the first pair");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv.precision(17);
  }

  std::printf("%-18s %7s %7s %7s %7s %7s %9s %9s %9s %8s\n", "against", "pairs", "regions", "several",
              "other", "none", "volume", "area", "depth", "worst");
  std::printf("%-18s %7s %7s %7s %7s %7s %9s %9s %9s %8s\n", "", "overlap", "", "regions", "count", "known",
              "error", "error", "error", "seed");
  csv << "table,against,pairs,regions,several,other_count,none_known,volume_error,area_error,depth_error,"
         "worst_seed\n";
  if (pairs > 0) compareRandomPairs(pairs, first, csv);
  if (lattice_pairs > 0) compareLatticePairs(lattice_pairs, first, csv);

  const std::vector<InterferenceScene> scenes = interferenceScenes();
  std::printf("\n%-18s %9s %8s %9s %11s %8s %11s %8s %9s %7s %8s\n", "scene", "triangles", "regions",
              "ours us", "CGAL fast us", "/ ours", "CGAL exact us", "/ ours", "FCL us", "/ ours", "contacts");
  csv << "table,scene,triangles,regions,ours_us,cgal_fast_us,cgal_exact_us,fcl_us,fcl_contacts\n";
  for (const InterferenceScene& scene : scenes) timeScene(scene, csv);
  std::printf(
      "\ndepth (m) of the deepest region, every edge halved 0 to 3 times, and of the deepest vertex\n");
  csv << "table,scene,depth_0,depth_1,depth_2,depth_3,vertex_depth_0,vertex_depth_1,vertex_depth_2,vertex_"
         "depth_3\n";
  for (const InterferenceScene& scene : scenes) {
    if (scene.pair.a.triangleCount() < 5000 && scene.name != "combs") compareHalvings(scene, csv);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
