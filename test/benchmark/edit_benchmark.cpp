// Measures how many of a pair's niches are known soon after an edit has replaced the mesh of one body, when
// what was proven of the old mesh is void: recall after 2, 5 and 20 ms of one thread, by what looks for them.
//
//   edit_benchmark [--pairs name,name,...] [--times 2,5,20] [--instants 3] [--runs 3] [--output FILE]
//
// A row is a pair, an edit of its body B, whether what niches need of the new mesh had been made before the
// time began, and a time. Edits: `remeshed`, the same surface with four triangles for each; `deformed`, moved
// smoothly by up to a hundredth of its size; `scaled`, a twentieth larger. Recall is the mean share, over
// instants of the motion and runs, of the niches of the new pair (listed without a limit, within a quarter of
// the smaller body or five times the distance) that is found: `proof`, by a tracker at `certified` that
// starts from nothing and does not search; `random`, by descents from random node pairs, as many as there is
// time for; `inherited`, by refining the niches of the old mesh on the new one; `evolved`, the same and
// generations of the search, inherited from them, as at level `refined`. Also the niches, the milliseconds of
// making normal cones (for the proof) and grids (for both searches).
#include <algorithm>
#include <cmath>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/closest_point.h"
#include "distance/kernels/witness_refinement.h"
#include "scene/niche_preparation.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"
#include "search/local_descent.h"
#include "search/mutation.h"
#include "tracking/niche_placement.h"
#include "tracking/niche_search.h"

namespace concave_distance::benchmark {
namespace {

using Eigen::Isometry3d;
using Mesh = std::shared_ptr<const BodyMesh>;
using Clock = std::chrono::steady_clock;
using Witnesses = std::vector<WitnessPair>;

constexpr std::array<const char*, 3> kEdits{"remeshed", "deformed", "scaled"};
constexpr std::array<const char*, 4> kMethods{"proof", "random", "inherited", "evolved"};

SurfaceMesh subdivided(const SurfaceMesh& surface) {
  TriangleSoup soup;
  for (std::uint32_t t = 0; t < surface.triangleCount(); ++t) {
    std::array<Eigen::Vector3d, 3> corner;
    for (int i = 0; i < 3; ++i) corner[static_cast<std::size_t>(i)] = surface.corner(TriangleIndex{t}, i);
    std::array<Eigen::Vector3d, 3> middle;  // of the edge that follows the corner
    for (std::size_t i = 0; i < 3; ++i) middle[i] = 0.5 * (corner[i] + corner[(i + 1) % 3]);
    const auto add = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
      const auto first = static_cast<std::uint32_t>(soup.vertices.size());
      soup.vertices.insert(soup.vertices.end(), {p, q, r});
      soup.triangles.push_back({first, first + 1, first + 2});
    };
    for (std::size_t i = 0; i < 3; ++i) add(corner[i], middle[i], middle[(i + 2) % 3]);
    add(middle[0], middle[1], middle[2]);
  }
  return weldEqualVertices(soup, "subdivided");
}

SurfaceMesh edited(const SurfaceMesh& surface, const std::string& edit) {
  if (edit == "remeshed") return subdivided(surface);
  const double size = surface.diameter();
  const Eigen::Vector3d centre = surface.boundingBox().center();
  std::vector<Eigen::Vector3d> vertices = surface.vertices();
  for (Eigen::Vector3d& vertex : vertices) {
    const Eigen::Vector3d place = vertex - centre;
    if (edit == "scaled") {
      vertex = centre + 1.05 * place;
    } else {
      const Eigen::Vector3d wave = 5.0 / size * Eigen::Vector3d(place.y(), place.z(), place.x());
      vertex += 0.01 * size / std::sqrt(3.0) * (wave + Eigen::Vector3d(0.3, 1.1, 2.3)).array().sin().matrix();
    }
  }
  return SurfaceMesh(std::move(vertices), surface.triangles(), edit);
}

/// An instant after an edit.
struct Instant {
  Mesh a;
  const SurfaceMesh* surface_b;
  Mesh known_b;  ///< the new one, with all that niches need
  Isometry3d pose;
  std::vector<TrackedNiche> before;  ///< of the old mesh
  std::vector<TrackedNiche> wanted;
};

double shareOf(const Instant& at, const Witnesses& found) {
  const double size = std::min(at.a->diameter(), at.known_b->diameter());
  std::size_t met = 0;
  for (const TrackedNiche& niche : at.wanted) {
    met += std::any_of(found.begin(), found.end(), [&](const WitnessPair& witness) {
      return std::abs(std::sqrt(witness.squared_distance) - niche.distance) <= 1e-6 * size &&
             (niche.extent > 0.0 || (witness.point_a_in_a - niche.point_a_in_a).norm() < 1e-3 * size);
    });
  }
  return static_cast<double>(met) / static_cast<double>(at.wanted.size());
}

Witnesses refined(const Instant& at, const Mesh& b, const std::vector<TrialPoint>& minima) {
  RefinementWorkspace workspace;
  Witnesses found;
  for (const TrialPoint& minimum : minima) {
    found.push_back(refineWitness(*at.a, *b, at.pose, gridOf(*at.a).nodes().originalTriangle(minimum.node_a),
                                  gridOf(*b).nodes().originalTriangle(minimum.node_b), workspace)
                        .witness);
  }
  return found;
}

TrackerParameters listing() {
  TrackerParameters parameters;
  parameters.hidden = true;
  parameters.largest_niche_count = 10000;
  return parameters;
}

/// The list without a limit of time, below 5 times the distance or a quarter of the smaller body.
std::vector<TrackedNiche> provenNiches(const Mesh& a, const Mesh& b, const Isometry3d& pose) {
  const PairSolution solution = solveOnce("edit", a, b, listing(), pose);
  const double cutoff = std::max(5.0 * solution.distance, 0.25 * std::min(a->diameter(), b->diameter()));
  std::vector<TrackedNiche> niches;
  for (const TrackedNiche& niche : solution.niches) {
    if (niche.distance > 0.0 && niche.distance <= cutoff) niches.push_back(niche);
  }
  return niches;
}

Witnesses byProof(const Instant& at, const Mesh& b, Clock::time_point end) {
  PreparationTask(at.a, b, listing()).makeNiches();
  TrackerParameters parameters = listing();
  parameters.search_share = 0.0;
  parameters.time_budget = std::chrono::duration<double>(end - Clock::now()).count();
  Witnesses found;
  if (parameters.time_budget <= 0.0) return found;
  PairTracker tracker("edit", at.a, b, parameters);
  PairSolution solution;
  tracker.update(at.pose, 0.0, solution);
  for (const TrackedNiche& niche : solution.niches) {
    WitnessPair witness;
    witness.point_a_in_a = niche.point_a_in_a;
    witness.squared_distance = niche.distance * niche.distance;
    found.push_back(witness);
  }
  return found;
}

Witnesses byRandomStarts(const Instant& at, const Mesh& b, std::uint64_t seed, Clock::time_point end) {
  constexpr std::uint32_t kDescents = 4;  // between two looks at the clock
  const PairObjective objective(*at.a, *b, at.pose);
  SearchWorkspace workspace(*at.a, *b);
  RandomEngine engine(seed);
  SearchCost cost;
  gridOf(*b).graph();
  while (Clock::now() < end) {
    for (std::uint32_t i = 0; i < kDescents; ++i) {
      descend(objective, randomTrialPoint(objective, engine), &workspace.basins, workspace.trail, cost);
    }
  }
  return refined(at, b, workspace.basins.minima());
}

// Takes the niches of the old mesh to the new one: each end to the closest point, then the minimum there.
Witnesses byInheritance(const Instant& at, const Mesh& b, Clock::time_point end) {
  RefinementWorkspace workspace;
  Witnesses found;
  const Isometry3d b_from_a = at.pose.inverse();
  for (const TrackedNiche& niche : at.before) {
    if (Clock::now() >= end) break;
    const SurfacePoint on_a = closestPoint(*at.a, niche.point_a_in_a, TriangleIndex{0});
    const SurfacePoint on_b = closestPoint(*b, b_from_a * niche.point_b_in_a, TriangleIndex{0});
    found.push_back(refineWitness(*at.a, *b, at.pose, on_a.triangle, on_b.triangle, workspace).witness);
  }
  return found;
}

Witnesses byEvolution(const Instant& at, const Mesh& b, std::uint64_t seed, Clock::time_point end) {
  Witnesses found = byInheritance(at, b, end);
  TrackerParameters parameters = listing();
  parameters.seed = seed;
  const detail::PairFrame frame(*at.a, *b, at.pose);
  NicheSearch search(*at.a, *b);
  search.prepare(*at.a, *b, parameters);
  std::vector<TrialPoint> all;
  for (const WitnessPair& witness : found) all.push_back(nodePairNear(frame, witness));
  const std::size_t inherited = all.size();
  SearchCost cost;
  std::vector<TrialPoint> known;
  const std::string name = "edit";
  for (std::uint64_t cycle = 0; Clock::now() < end; ++cycle) {
    search.begin(*at.a, *b, parameters);
    known.clear();
    const std::size_t heirs = std::min<std::size_t>(all.size(), parameters.inherited_limit);
    for (std::size_t i = 0; i < heirs; ++i) {
      known.push_back(search.descendKnown(frame, all[(cycle * heirs + i) % all.size()], cost));
    }
    WorkLimit limit(Clock::now(), std::chrono::duration<double>(end - Clock::now()).count(),
                    parameters.facet_pair_limit, nullptr);
    const NicheSearch::Run run{name, cycle, true, false, true};
    const auto& proposed = search.propose(frame, parameters, known, run, cost, limit);
    all.insert(all.end(), proposed.begin(), proposed.end());
  }
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(inherited));
  const Witnesses evolved = refined(at, b, all);
  found.insert(found.end(), evolved.begin(), evolved.end());
  return found;
}

double recallOf(const Instant& at, std::size_t method, bool is_prepared, double milliseconds,
                std::uint64_t seed) {
  const Mesh b = is_prepared
                     ? at.known_b
                     : std::make_shared<const BodyMesh>("b", SurfaceMesh(*at.surface_b), BodyMeshOptions());
  const Clock::time_point end = instantIn(1e-3 * milliseconds);
  switch (method) {
    case 0:
      return shareOf(at, byProof(at, b, end));
    case 1:
      return shareOf(at, byRandomStarts(at, b, seed, end));
    case 2:
      return shareOf(at, byInheritance(at, b, end));
    default:
      return shareOf(at, byEvolution(at, b, seed, end));
  }
}

struct Preparation {
  std::vector<double> cones_ms;
  std::vector<double> grid_ms;
};

std::vector<Instant> instantsOf(const BenchmarkPair& pair, const SurfaceMesh& surface_b, int count,
                                Preparation& preparation) {
  const auto known = std::make_shared<const BodyMesh>("b", SurfaceMesh(surface_b), BodyMeshOptions());
  PreparationTask(pair.a, pair.b, listing()).run();
  preparation.grid_ms.push_back(millisecondsOf([&] { gridOf(*known).graph(); }));
  preparation.cones_ms.push_back(
      millisecondsOf([&] { PreparationTask(pair.a, known, listing()).makeNiches(); }));
  gridOf(*known).metric();
  std::vector<Instant> instants;
  for (int k = 0; k < count; ++k) {
    const Isometry3d pose = pair.motion((k + 0.5) / count);
    Instant at{pair.a,
               &surface_b,
               known,
               pose,
               provenNiches(pair.a, pair.b, pose),
               provenNiches(pair.a, known, pose)};
    if (!at.wanted.empty()) instants.push_back(std::move(at));
  }
  return instants;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  ProgramOptions options("Niches soon after an edit has replaced a mesh");
  std::vector<std::string> names = allPairs();
  std::vector<double> times{2.0, 5.0, 20.0};
  int instants = 3;
  std::uint64_t runs = 3;
  options.add("--pairs", names, "Pairs to run; all when left out");
  options.add("--times", times, "Milliseconds after the edit");
  options.add("--instants", instants, "Of the motion", 1);
  options.add("--runs", runs, "Of each method at each instant", std::uint64_t{1});
  if (!options.read(argc, argv)) return options.status();
  ResultTable table(options.output(),
                    "pair,edit,prepared,time_ms,niches,proof,random,inherited,evolved,cones_ms,grid_ms");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    for (const char* edit : kEdits) {
      const SurfaceMesh surface_b = edited(pair.b->surface(), edit);
      Preparation preparation;
      const std::vector<Instant> all = instantsOf(pair, surface_b, instants, preparation);
      std::vector<double> niches;
      for (const Instant& at : all) niches.push_back(static_cast<double>(at.wanted.size()));
      for (const bool is_prepared : {false, true}) {
        for (const double time : times) {
          std::array<std::vector<double>, kMethods.size()> recall;
          for (const Instant& at : all) {
            for (std::uint64_t run = 0; run < runs; ++run) {
              for (std::size_t method = 0; method < kMethods.size(); ++method) {
                recall[method].push_back(
                    recallOf(at, method, is_prepared, time, streamSeed(run, "edit_benchmark", method)));
              }
            }
          }
          table.add(name, edit, is_prepared ? 1 : 0, time, mean(niches), mean(recall[0]), mean(recall[1]),
                    mean(recall[2]), mean(recall[3]), mean(preparation.cones_ms), mean(preparation.grid_ms));
        }
      }
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
