// Scenes of many bodies on smooth random paths at constant density: a cycle of SceneTracker by stage, and
// FCL's managers with FCL's distance on the same bodies and poses.
//
//   scene_benchmark [--bodies 50,100,200,500,1000] [--cycles 300] [--threads 0] [--fcl-cycles 100]
//                   [--output doc/results/scene.csv]
//
// A third of the bodies are spheres, a third boxes, a third meshes of 1,000 to 5,000 triangles, of 20
// different shapes in all, 0.2 to 0.5 m across; each has 1 cubic metre, the cutoff is 0.2 m, a cycle 20 ms.
// A row is a number of bodies: possible pairs; mean near pairs, of which within the cutoff, of which overlap;
// seconds until the first distances are there; milliseconds of the first cycle; seconds until all pairs can
// list their niches; mean milliseconds of the broad phase alone, of a cycle with distances (median, 99th
// percentile, share beyond 20 ms), of a cycle with niches at the pace of real ones that ends after 16 ms (the
// same), with the share of lists that are complete and the age of the oldest list, milliseconds (median over
// the cycles); largest resident memory, MB; of FCL in one thread, milliseconds: sweep and prune and the
// dynamic tree of boxes, each alone and with the distances of the pairs that it finds (the sweep is made anew
// in each cycle, because FCL 0.7's update() of it does not end on these motions); the largest difference of a
// distance from FCL's, metres.
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <thread>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/many_bodies.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/resident_memory.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPeriod = 0.02;
constexpr double kBudget = 0.8 * kPeriod;

struct Row {
  double start_s = 0.0;
  double first_ms = 0.0;
  double prepare_s = 0.0;
  std::vector<double> broad_ms;
  std::vector<double> distance_ms;
  std::vector<double> niche_ms;
  std::vector<double> near;
  std::vector<double> within;
  std::vector<double> overlapping;
  std::vector<double> oldest_ms;
  std::uint64_t lists = 0;
  std::uint64_t complete_lists = 0;
  std::vector<double> sweep_ms;
  std::vector<double> sweep_with_ms;
  std::vector<double> tree_ms;
  std::vector<double> tree_with_ms;
  double largest_error = 0.0;
  double memory_mb = 0.0;
};

void count(const SceneTracker& tracker, Row& row) {
  double within = 0.0;
  double overlapping = 0.0;
  for (const auto& pair : tracker.pairs()) {
    if (!pair->solved()) continue;
    within += pair->solution.distance <= kCutoff ? 1.0 : 0.0;
    overlapping += pair->solution.distance == 0.0 ? 1.0 : 0.0;
  }
  row.near.push_back(static_cast<double>(tracker.pairs().size()));
  row.within.push_back(within);
  row.overlapping.push_back(overlapping);
}

void runOwn(const ManyBodies& cell, std::uint32_t threads, int cycles, Row& row) {
  constexpr PairDemand kNothing{};
  constexpr PairDemand kDistance{true, true, false, false};
  constexpr PairDemand kNiches{true, true, true, false};
  double time = 0.0;
  std::vector<Poses> poses;
  for (int step = 0; step < cycles; ++step) poses.push_back(cell.posesAt(kPeriod * step));
  {
    SceneTracker broad({threads, nullptr});
    broad.setScene(cell.scene);
    for (int step = 0; step < cycles; ++step) {
      const double taken = millisecondsOf(
          [&] { broad.update(poses[static_cast<std::size_t>(step)], kPeriod * step, kNothing); });
      if (step > 0) row.broad_ms.push_back(taken);
    }
  }
  {
    SceneTracker distances({threads, nullptr});
    distances.setScene(cell.scene);
    for (int step = 0; step < cycles; ++step) {
      const double taken = millisecondsOf(
          [&] { distances.update(poses[static_cast<std::size_t>(step)], kPeriod * step, kDistance); });
      if (step == 0) {
        row.first_ms = taken;
        continue;
      }
      row.distance_ms.push_back(taken);
      count(distances, row);
    }
  }
  SceneTrackerOptions options{threads, nullptr};
  options.prepares_in_background = true;
  SceneTracker niches(options);
  niches.setScene(cell.scene);
  // The background makes what niches need, at the pace of real cycles.
  const Poses& first = poses.front();
  const auto begin = Clock::now();
  while (niches.update(first, 0.0, kNiches, instantIn(kBudget)).unprepared > 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  row.prepare_s = 1e-6 * microsecondsSince(begin);
  std::map<const TrackedPair*, double> complete_at;
  const auto paced = Clock::now();
  for (int step = 0; step < cycles; ++step) {
    time = kPeriod * (step + 1);
    std::this_thread::sleep_until(paced + std::chrono::microseconds(static_cast<int>(1e6 * time)));
    const auto end = instantIn(kBudget);
    row.niche_ms.push_back(
        millisecondsOf([&] { niches.update(poses[static_cast<std::size_t>(step)], time, kNiches, end); }));
    double oldest = 0.0;
    for (const auto& pair : niches.pairs()) {
      if (!pair->solved()) continue;
      auto [place, is_new] = complete_at.emplace(pair.get(), time);
      if (pair->solution.niches_complete) place->second = time;
      ++row.lists;
      row.complete_lists += pair->solution.niches_complete ? 1 : 0;
      oldest = std::max(oldest, time - place->second);
    }
    row.oldest_ms.push_back(1e3 * oldest);
  }
  row.memory_mb = residentMegabytes("VmHWM");
}

/// A body as FCL's managers hold it: a box about its mesh, widened by half the cutoff.
struct FclBody {
  std::shared_ptr<FclModel> model;
  std::shared_ptr<fcl::CollisionObject<double>> object;
};

struct FclCycle {
  const std::vector<FclBody>* bodies;
  const Poses* poses;
  bool with_distances = false;
  std::map<std::pair<std::size_t, std::size_t>, double>* distances = nullptr;
  std::size_t pairs = 0;
};

bool meet(fcl::CollisionObject<double>* l, fcl::CollisionObject<double>* r, void* data) {
  auto& cycle = *static_cast<FclCycle*>(data);
  ++cycle.pairs;
  if (!cycle.with_distances) return false;
  const auto a = reinterpret_cast<std::size_t>(l->getUserData());
  const auto b = reinterpret_cast<std::size_t>(r->getUserData());
  const Eigen::Isometry3d a_from_b = (*cycle.poses)[a]->inverse() * *(*cycle.poses)[b];
  const double distance =
      fclDistance(*(*cycle.bodies)[a].model, *(*cycle.bodies)[b].model, a_from_b).distance;
  if (cycle.distances != nullptr) (*cycle.distances)[std::minmax(a, b)] = std::max(0.0, distance);
  return false;
}

template <typename Manager>
void runManager(const ManyBodies& cell, const std::vector<FclBody>& bodies, int cycles, bool is_made_anew,
                std::vector<double>& alone_ms, std::vector<double>& with_ms) {
  const auto place = [&](const Poses& poses) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].object->setTransform(*poses[i]);
      bodies[i].object->computeAABB();
    }
  };
  place(cell.posesAt(0.0));
  std::vector<fcl::CollisionObject<double>*> objects;
  for (const FclBody& body : bodies) objects.push_back(body.object.get());
  auto manager = std::make_unique<Manager>();
  manager->registerObjects(objects);
  manager->setup();
  for (int step = 1; step < cycles; ++step) {
    const Poses poses = cell.posesAt(kPeriod * step);
    FclCycle cycle{&bodies, &poses};
    const double alone = millisecondsOf([&] {
      place(poses);
      if (is_made_anew) {
        manager = std::make_unique<Manager>();
        manager->registerObjects(objects);
        manager->setup();
      } else {
        manager->update();
      }
      manager->collide(&cycle, meet);
    });
    cycle.with_distances = true;
    const double with = millisecondsOf([&] { manager->collide(&cycle, meet); });
    alone_ms.push_back(alone);
    with_ms.push_back(alone + with);
  }
}

void runFcl(const ManyBodies& cell, std::uint32_t threads, int cycles, Row& row) {
  std::map<const BodyMesh*, std::shared_ptr<FclModel>> models;
  std::map<const BodyMesh*, std::shared_ptr<fcl::CollisionGeometry<double>>> boxes;
  std::vector<FclBody> bodies;
  for (std::size_t i = 0; i < cell.scene.bodies.size(); ++i) {
    const BodyMesh& mesh = *cell.scene.bodies[i].mesh;
    std::shared_ptr<FclModel>& model = models[&mesh];
    if (!model) model = makeFclModel(mesh.surface());
    const BodyBounds& bounds = cell.scene.bodies[i].bounds;
    const Eigen::Vector3d sides = 2.0 * bounds.half_extents + Eigen::Vector3d::Constant(kCutoff);
    const auto box = std::make_shared<fcl::Box<double>>(sides);
    FclBody body{model, std::make_shared<fcl::CollisionObject<double>>(box)};
    body.object->setUserData(reinterpret_cast<void*>(i));
    bodies.push_back(std::move(body));
  }
  runManager<fcl::SaPCollisionManager<double>>(cell, bodies, cycles, true, row.sweep_ms, row.sweep_with_ms);
  runManager<fcl::DynamicAABBTreeCollisionManager<double>>(cell, bodies, cycles, false, row.tree_ms,
                                                           row.tree_with_ms);

  // Every pair that the tracker solves, against FCL; spheres are exact here and meshes there.
  SceneTracker tracker({threads, nullptr});
  tracker.setScene(cell.scene);
  const Poses poses = cell.posesAt(kPeriod);
  tracker.update(poses, kPeriod, {true, true, false, false});
  for (const auto& pair : tracker.pairs()) {
    if (!pair->solved() || pair->body_a->mesh->shape() != nullptr || pair->body_b->mesh->shape() != nullptr)
      continue;
    const double expected = fclDistance(*bodies[pair->origin->body_a].model,
                                        *bodies[pair->origin->body_b].model, pair->input.a_from_b)
                                .distance;
    row.largest_error =
        std::max(row.largest_error, std::abs(std::max(0.0, expected) - pair->solution.distance));
  }
}

double shareBeyond(const std::vector<double>& sample, double limit) {
  double count = 0.0;
  for (const double value : sample) count += value > limit ? 1.0 : 0.0;
  return count / static_cast<double>(sample.size());
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  ProgramOptions options("Scenes of many bodies, beside FCL's managers");
  std::vector<std::size_t> counts{50, 100, 200, 500, 1000};
  int cycles = 300;
  int fcl_cycles = 100;
  std::uint32_t threads = 0;
  options.add("--bodies", counts, "Numbers of bodies");
  options.add("--cycles", cycles, "Cycles of each kind", 2);
  options.add("--fcl-cycles", fcl_cycles, "Cycles with FCL", 2);
  options.add("--threads", threads, "Threads that solve pairs; 0: one per core");
  if (!options.read(argc, argv)) return options.status();

  ResultTable table(options.output(),
                    "bodies,possible_pairs,near_pairs,pairs_within,pairs_overlapping,start_s,first_cycle_ms,"
                    "prepare_s,broad_ms,"
                    "distances_ms,distances_p99_ms,distances_late,niches_ms,niches_p99_ms,niches_late,"
                    "lists_complete,oldest_list_ms,memory_mb,fcl_sap_ms,fcl_sap_with_ms,fcl_tree_ms,"
                    "fcl_tree_with_ms,largest_error_m");
  for (const std::size_t number : counts) {
    Row row;
    const auto start = Clock::now();
    const ManyBodies cell = manyBodies(number);
    {
      SceneTracker tracker({threads, nullptr});
      tracker.setScene(cell.scene);
      tracker.update(cell.posesAt(0.0), 0.0, {true, true, false, false});
      row.start_s = 1e-6 * microsecondsSince(start);
    }
    runOwn(cell, threads, cycles, row);
    runFcl(cell, threads, fcl_cycles, row);
    table.add(number, number * (number - 1) / 2, mean(row.near), mean(row.within), mean(row.overlapping),
              row.start_s, row.first_ms, row.prepare_s, mean(row.broad_ms), median(row.distance_ms),
              percentile(row.distance_ms, 0.99), shareBeyond(row.distance_ms, 1e3 * kPeriod),
              median(row.niche_ms), percentile(row.niche_ms, 0.99), shareBeyond(row.niche_ms, 1e3 * kPeriod),
              static_cast<double>(row.complete_lists) / static_cast<double>(row.lists), median(row.oldest_ms),
              row.memory_mb, mean(row.sweep_ms), mean(row.sweep_with_ms), mean(row.tree_ms),
              mean(row.tree_with_ms), row.largest_error);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
