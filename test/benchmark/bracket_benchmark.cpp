// Whether brackets and complete lists hold wherever a limit cuts a cycle.
//
//   bracket_benchmark [--cycles 1000000] [--seed 1] [--lists 100] [--output doc/results/brackets.csv]
//
// Pairs of random concave solids, some of them bumpy balls of a thousand triangles and more, move at random
// and are tracked, 200 cycles each, while limits of random length, from a microsecond to a hundredth of a
// second, end their cycles. Every answer is compared with FCL's distance, the status penetrating also with
// winding numbers; of the lists that are called complete each so many with the list of a cold solve without a
// limit. A row is a kind of cycle: `whole` without a limit, `budget` with one of its own, `put_off` and
// `halves` with the end of a cycle of many pairs before or in its second half; its cycles; those without a
// finished proof; those without a complete list; bounds above and distances below FCL's by more than 1e-9 of
// both diameters; wrong claims to penetrate; lists compared and those that differ.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <string>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/fcl_distance.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_motions.h"
#include "support/random_solids.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::uint64_t kCyclesOfRun = 200;
constexpr double kTolerance = 1e-9;  // of both diameters: FCL's rounding and the kernel's
constexpr std::array<const char*, 4> kKinds{"whole", "budget", "put_off", "halves"};

struct Figures {
  std::uint64_t cycles = 0;
  std::uint64_t cut_proofs = 0;
  std::uint64_t incomplete = 0;
  std::uint64_t bounds_above = 0;
  std::uint64_t distances_below = 0;
  std::uint64_t wrong_overlaps = 0;
  std::uint64_t lists = 0;
  std::uint64_t wrong_lists = 0;

  void add(const Figures& other) {
    cycles += other.cycles;
    cut_proofs += other.cut_proofs;
    incomplete += other.incomplete;
    bounds_above += other.bounds_above;
    distances_below += other.distances_below;
    wrong_overlaps += other.wrong_overlaps;
    lists += other.lists;
    wrong_lists += other.wrong_lists;
  }
};
using FiguresOfKinds = std::array<Figures, kKinds.size()>;

/// How often a closed surface winds around a point (van Oosterom and Strackee 1983).
double windingNumber(const SurfaceMesh& surface, const Eigen::Vector3d& point) {
  double solid_angle = 0.0;
  for (std::uint32_t i = 0; i < surface.triangleCount(); ++i) {
    const Eigen::Vector3d a = surface.corner(TriangleIndex{i}, 0) - point;
    const Eigen::Vector3d b = surface.corner(TriangleIndex{i}, 1) - point;
    const Eigen::Vector3d c = surface.corner(TriangleIndex{i}, 2) - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    solid_angle +=
        2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la);
  }
  return solid_angle / (4.0 * M_PI);
}

/// Two solids on a random path, and what FCL needs of them.
class Run {
 public:
  Run(std::uint64_t seed, std::uint64_t lists)
      : engine_(seed),
        a_(randomBody("a")),
        b_(randomBody("b")),
        fcl_a_(makeFclModel(a_->surface())),
        fcl_b_(makeFclModel(b_->surface())),
        motion_(test::randomMotion(engine_)),
        tolerance_(kTolerance * (a_->diameter() + b_->diameter())),
        lists_(lists) {
    parameters_.largest_niche_count = 1000;
  }

  FiguresOfKinds play() {
    FiguresOfKinds figures;
    PairTracker tracker("pair", a_, b_, parameters_);
    const double step = std::pow(10.0, -3.5 + 2.0 * uniformUnit(engine_));
    for (std::uint64_t cycle = 0; cycle < kCyclesOfRun; ++cycle) {
      const Eigen::Isometry3d pose = motion_.at(step * static_cast<double>(cycle));
      const std::uint32_t kind = uniformIndex(engine_, kKinds.size());
      solve(tracker, kind, pose, 0.01 * static_cast<double>(cycle));
      judge(pose, figures[kind]);
    }
    return figures;
  }

 private:
  std::shared_ptr<const BodyMesh> randomBody(const std::string& name) {
    const bool is_large = uniformIndex(engine_, 8) == 0;
    SurfaceMesh surface = is_large ? test::makeBumpyBall(0.4, 2e-3, 9.0) : test::randomSolid(engine_);
    BodyMeshOptions options;
    options.max_edge_length = 2.0 * surface.diameter();
    return std::make_shared<const BodyMesh>(name, std::move(surface), options);
  }

  double randomSeconds() { return std::pow(10.0, -6.0 + 4.0 * uniformUnit(engine_)); }

  void solve(PairTracker& tracker, std::uint32_t kind, const Eigen::Isometry3d& pose, double time) {
    TrackerParameters parameters = parameters_;
    if (kind == 1) parameters.time_budget = randomSeconds();
    tracker.setParameters(parameters);
    if (kind <= 1) return tracker.update(pose, time, solution_);
    const double first = randomSeconds();
    const double second = randomSeconds();
    if (!tracker.prove(pose, time, solution_, instantIn(first))) return;
    if (kind == 2) {
      tracker.putOffNiches(solution_);
    } else {
      tracker.addNiches(solution_, instantIn(second));
    }
  }

  void judge(const Eigen::Isometry3d& pose, Figures& figures) {
    ++figures.cycles;
    figures.cut_proofs += solution_.status == SolveStatus::BudgetExhausted ? 1 : 0;
    figures.incomplete += solution_.niches_complete ? 0 : 1;
    const double surfaces = std::max(0.0, fclDistance(*fcl_a_, *fcl_b_, pose).distance);
    const bool overlaps = surfaces == 0.0 || isSwallowed(pose);
    const double exact = overlaps ? 0.0 : surfaces;
    figures.bounds_above += solution_.lower_bound > exact + tolerance_ ? 1 : 0;
    figures.distances_below += !(solution_.distance >= exact - tolerance_) ? 1 : 0;
    const bool claims = solution_.status == SolveStatus::Penetrating;
    figures.wrong_overlaps += claims && !(overlaps || surfaces <= tolerance_) ? 1 : 0;
    if (!solution_.niches_complete || uniformIndex(engine_, static_cast<std::uint32_t>(lists_)) != 0) return;
    ++figures.lists;
    figures.wrong_lists += isRightList(pose) ? 0 : 1;
  }

  bool isSwallowed(const Eigen::Isometry3d& pose) const {
    const NodeIndex first{0};
    const Eigen::Vector3d of_b = pose * b_->surface().vertex(first);
    const Eigen::Vector3d of_a = pose.inverse() * a_->surface().vertex(first);
    return std::abs(windingNumber(a_->surface(), of_b)) > 0.5 ||
           std::abs(windingNumber(b_->surface(), of_a)) > 0.5;
  }

  bool isRightList(const Eigen::Isometry3d& pose) const {
    const PairSolution cold = solveOnce("pair", a_, b_, parameters_, pose);
    return std::equal(cold.niches.begin(), cold.niches.end(), solution_.niches.begin(),
                      solution_.niches.end(), [&](const TrackedNiche& l, const TrackedNiche& r) {
                        return std::abs(l.distance - r.distance) <= tolerance_;
                      });
  }

  RandomEngine engine_;
  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  std::shared_ptr<FclModel> fcl_a_;
  std::shared_ptr<FclModel> fcl_b_;
  test::Motion motion_;
  double tolerance_;  ///< metres
  std::uint64_t lists_;
  TrackerParameters parameters_;
  PairSolution solution_;
};

}  // namespace

int benchmarkMain(int argc, char** argv) {
  ProgramOptions options("Brackets and complete lists of cycles that limits end");
  std::uint64_t cycles = 1000000;
  std::uint64_t seed = 1;
  std::uint64_t lists = 100;
  options.add("--cycles", cycles, "Cycles of all pairs together");
  options.add("--seed", seed, "Of the pairs and limits");
  options.add("--lists", lists, "One complete list in so many is compared", std::uint64_t{1});
  if (!options.read(argc, argv)) return options.status();
  FiguresOfKinds figures;
  std::mutex mutex;
  tbb::parallel_for(std::uint64_t{0}, (cycles + kCyclesOfRun - 1) / kCyclesOfRun, [&](std::uint64_t run) {
    const FiguresOfKinds of_run = Run(streamSeed(seed, "bracket", run), lists).play();
    const std::lock_guard<std::mutex> lock(mutex);
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) figures[kind].add(of_run[kind]);
  });
  ResultTable table(options.output(),
                    "kind,cycles,cut_proofs,incomplete_lists,bounds_above,distances_below,wrong_overlaps,"
                    "lists_compared,lists_wrong");
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    const Figures& of = figures[kind];
    table.add(kKinds[kind], of.cycles, of.cut_proofs, of.incomplete, of.bounds_above, of.distances_below,
              of.wrong_overlaps, of.lists, of.wrong_lists);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
