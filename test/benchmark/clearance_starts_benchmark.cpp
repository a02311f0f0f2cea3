// Whether a first look at a motion saves time: findClearance() with starts that a search proposes, against
// none. A trial: time as a further gene of the niched genetic algorithm.
//
//   clearance_starts_benchmark [--motions 200] [--half 0|1] [--seed 2] [--tolerance 0.001]
//
// Proposers: `none`; `perfect`, where the least really is, at no cost (what no proposer can beat); `sampled`,
// certified distances of the near pairs at so many even times, warm; `random`, descents over nodes and time
// from random individuals; `genetic`, the niched algorithm with as many descents. A row: stage, proposer, its
// size, ms of the proposal, of findClearance() and of both (mean, and the median of ratios to none), queries,
// how far the proposed distance is above the least, mm (median). Times are the less of two runs; the grids of
// the bodies are made before.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/random_motions.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/kinematics/clearance.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "search/local_descent.h"
#include "search/mating.h"
#include "search/mutation.h"
#include "search/pair_metric.h"

namespace concave_distance::benchmark {
namespace {

struct Individual {
  std::size_t pair = 0;
  TrialPoint point{};
  double time = 0.0;

  friend bool operator<(const Individual& l, const Individual& r) {
    return l.point.squared_distance < r.point.squared_distance;
  }
};

struct Proposal {
  std::size_t pair = 0;
  double time = 0.0;
  double distance = std::numeric_limits<double>::infinity();
};

struct Sizes {
  std::size_t population = 16;
  std::size_t generations = 3;
  std::size_t immigrants = 4;
  std::size_t proposals = 3;
};

/// The niched algorithm on trial points of a pair, two nodes and a time.
class TimeSearch {
 public:
  TimeSearch(const MotionStage& stage, std::uint64_t seed) : stage_(stage), engine_(seed) {
    for (const MotionStage::Pair& pair : stage.pairs()) {
      metrics_.emplace_back(*stage.scene()->bodies[pair.a].mesh, *stage.scene()->bodies[pair.b].mesh);
    }
  }

  /// Makes the bodies' grids, once for all motions.
  void prepare() {
    for (std::size_t pair = 0; pair < stage_.pairs().size(); ++pair) {
      gridOf(bodyA(pair)).metric();
      gridOf(bodyB(pair)).metric();
    }
  }

  std::vector<Proposal> run(const Motion& motion, const Sizes& sizes) {
    motion_ = &motion;
    span_ = motion.times.back() - motion.times.front();
    std::vector<Individual> population;
    for (std::size_t i = 0; i < sizes.population; ++i) population.push_back(newcomer());
    for (std::size_t generation = 0; generation < sizes.generations; ++generation) {
      breed(population);
      for (std::size_t i = 0; i < sizes.immigrants; ++i) {
        const auto worst = std::max_element(population.begin(), population.end());
        const Individual candidate = newcomer();
        if (candidate < *worst) *worst = candidate;
      }
    }
    std::sort(population.begin(), population.end());
    std::vector<Proposal> proposals;
    for (const Individual& one : population) {
      if (proposals.size() == sizes.proposals) break;
      const bool is_known = std::any_of(proposals.begin(), proposals.end(), [&](const Proposal& other) {
        return other.pair == one.pair && std::abs(other.time - one.time) < 0.02 * span_;
      });
      if (!is_known) proposals.push_back({one.pair, one.time, std::sqrt(one.point.squared_distance)});
    }
    return proposals;
  }

 private:
  const BodyMesh& bodyA(std::size_t pair) const {
    return *stage_.scene()->bodies[stage_.pairs()[pair].a].mesh;
  }
  const BodyMesh& bodyB(std::size_t pair) const {
    return *stage_.scene()->bodies[stage_.pairs()[pair].b].mesh;
  }
  Eigen::Isometry3d aFromB(std::size_t pair, double time) {
    stage_.chain().place(motion_->at(time), links_);
    const auto poseOf = [&](std::size_t body) {
      const MotionStage::Body& b = stage_.bodies()[body];
      return b.link < 0 ? b.link_from_body
                        : Eigen::Isometry3d(links_[static_cast<std::size_t>(b.link)] * b.link_from_body);
    };
    return poseOf(stage_.pairs()[pair].a).inverse() * poseOf(stage_.pairs()[pair].b);
  }

  double randomTime() { return motion_->times.front() + span_ * uniformUnit(engine_); }

  /// Of so many pairs, most are far: of three drawn at the time, the one whose balls are nearest.
  Individual newcomer() {
    Individual one;
    one.time = randomTime();
    stage_.place(motion_->at(one.time), poses_);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t pair = 0; pair < stage_.pairs().size(); ++pair) {
      const double bound = stage_.boundAt(pair, poses_, nearest) * (0.5 + uniformUnit(engine_));
      if (bound < nearest) {
        nearest = bound;
        one.pair = pair;
      }
    }
    const PairObjective objective(bodyA(one.pair), bodyB(one.pair), aFromB(one.pair, one.time));
    one.point = randomTrialPoint(objective, engine_);
    settle(one);
    return one;
  }

  /// Descends over the nodes at the time, then over the time with the nodes, until neither moves.
  void settle(Individual& one) {
    for (int round = 0; round < 3; ++round) {
      const PairObjective objective(bodyA(one.pair), bodyB(one.pair), aFromB(one.pair, one.time));
      one.point = descend(objective, one.point, nullptr, trail_, cost_);
      if (!moveTime(one)) break;
    }
  }

  bool moveTime(Individual& one) {
    const Eigen::Vector3d& a = gridOf(bodyA(one.pair)).graph().positions[one.point.node_a.value];
    const Eigen::Vector3d& b = gridOf(bodyB(one.pair)).graph().positions[one.point.node_b.value];
    bool has_moved = false;
    for (double step = 0.04 * span_; step > 1e-3 * span_; step *= 0.4) {
      for (const double side : {1.0, -1.0}) {
        while (true) {
          const double time =
              std::clamp(one.time + side * step, motion_->times.front(), motion_->times.back());
          const double squared = (a - aFromB(one.pair, time) * b).squaredNorm();
          if (squared >= one.point.squared_distance) break;
          one.time = time;
          one.point.squared_distance = squared;
          has_moved = true;
        }
      }
    }
    return has_moved;
  }

  /// Deterministic crowding; couples of one pair mate on their meshes, others exchange their times.
  void breed(std::vector<Individual>& population) {
    std::vector<std::size_t> order(population.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[uniformIndex(engine_, static_cast<std::uint32_t>(i))]);
    }
    for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
      Individual& first = population[order[i]];
      Individual& second = population[order[i + 1]];
      Individual child_1 = first;
      Individual child_2 = second;
      if (first.pair == second.pair) {
        const Children nodes = mate(first.point, second.point, metrics_[first.pair], 1e9, engine_);
        child_1.point = nodes.first;
        child_2.point = nodes.second;
        const double share = uniformUnit(engine_);
        child_1.time = first.time + share * (second.time - first.time);
        child_2.time = second.time + share * (first.time - second.time);
      } else {
        std::swap(child_1.time, child_2.time);
      }
      for (Individual* child : {&child_1, &child_2}) {
        if (uniformUnit(engine_) < 0.1) child->time = randomTime();
        settle(*child);
      }
      const auto apart = [&](const Individual& l, const Individual& r) {
        return l.pair != r.pair ? 2.0 : std::abs(l.time - r.time) / span_;
      };
      if (apart(first, child_1) + apart(second, child_2) > apart(first, child_2) + apart(second, child_1)) {
        std::swap(child_1, child_2);
      }
      if (child_1 < first) first = child_1;
      if (child_2 < second) second = child_2;
    }
  }

  const MotionStage& stage_;
  RandomEngine engine_;
  std::vector<PairMetric> metrics_;
  const Motion* motion_ = nullptr;
  double span_ = 0.0;
  std::vector<Eigen::Isometry3d> links_;
  MotionStage::Poses poses_;
  std::vector<std::uint64_t> trail_;
  SearchCost cost_;
};

/// Certified distances at even times, warm from one to the next, of pairs that balls and boxes leave.
class WarmSampling {
 public:
  explicit WarmSampling(const MotionStage& stage) : stage_(stage) {
    TrackerParameters parameters;
    parameters.niches_wanted = false;
    for (const MotionStage::Pair& pair : stage.pairs()) {
      trackers_.emplace_back(pair.name, stage.scene()->bodies[pair.a].mesh,
                             stage.scene()->bodies[pair.b].mesh, parameters);
    }
  }

  std::vector<Proposal> run(const Motion& motion, std::size_t count, std::size_t proposals) {
    std::vector<Proposal> best(1);
    for (std::size_t i = 0; i < count; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
      const double time = motion.times.front() + share * (motion.times.back() - motion.times.front());
      stage_.place(motion.at(time), poses_);
      Proposal here;
      for (std::size_t pair = 0; pair < stage_.pairs().size(); ++pair) {
        const double enough = std::min(best[0].distance + 0.05, here.distance);
        if (stage_.boundAt(pair, poses_, enough) >= enough) continue;
        trackers_[pair].update(poses_.world_from_body[stage_.pairs()[pair].a].inverse() *
                                   poses_.world_from_body[stage_.pairs()[pair].b],
                               time, solution_);
        if (solution_.distance < here.distance) here = {pair, time, solution_.distance};
      }
      best.push_back(here);
      if (here.distance < best[0].distance) best[0] = here;
    }
    best.erase(best.begin());
    std::sort(best.begin(), best.end(),
              [](const Proposal& l, const Proposal& r) { return l.distance < r.distance; });
    best.resize(std::min(best.size(), proposals));
    return best;
  }

 private:
  const MotionStage& stage_;
  std::vector<PairTracker> trackers_;
  PairSolution solution_;
  MotionStage::Poses poses_;
};

struct Tally {
  std::vector<double> proposal_ms, search_ms, ratio, queries, above_mm;
};

JointMotion asJointMotion(const MotionStage& stage, const Motion& motion) {
  JointMotion given;
  given.joints = stage.chain().jointNames();
  given.times = motion.times;
  given.positions.resize(static_cast<Eigen::Index>(motion.positions.size()), stage.chain().jointCount());
  for (std::size_t i = 0; i < motion.positions.size(); ++i) {
    given.positions.row(static_cast<Eigen::Index>(i)) = motion.positions[i];
  }
  return given;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::uint32_t count = 200;
  std::uint32_t half = 0;
  std::uint32_t seed = 2;
  double tolerance = 1e-3;
  std::string only;
  std::string output;
  ProgramOptions program("Starts for the clearance of motions");
  program.add("--motions", count, "motions on each stage", 2U);
  program.add("--half", half, "0: to tune on, 1: held out");
  program.add("--seed", seed, "of motions and searches");
  program.add("--tolerance", tolerance, "metres");
  if (!program.read(argc, argv)) return program.status();
  ResultTable table(
      program.output(),
      "stage,proposer,motions,proposal_ms,clearance_ms,sum_ms,median_sum_ms,over_none,queries,above_mm");
  for (const MotionStage& stage : {cellStage(), shelfStage()}) {
    RandomMotions motions = motionsOf(stage, seed + 100 * half);
    const SceneKinematics joints(*stage.scene());
    const SceneState state = joints.startState();
    TimeSearch search(stage, seed);
    search.prepare();
    WarmSampling sampling(stage);
    using Proposer = std::function<std::vector<Proposal>(const Motion&)>;
    std::vector<std::pair<std::string, Proposer>> proposers;
    proposers.emplace_back("none", [](const Motion&) { return std::vector<Proposal>(); });
    for (const std::size_t samples : {4UL, 8UL, 16UL, 32UL, 64UL, 128UL}) {
      proposers.emplace_back("sampled " + std::to_string(samples),
                             [&sampling, samples](const Motion& m) { return sampling.run(m, samples, 1); });
    }
    for (const std::size_t samples : {16UL, 64UL}) {
      proposers.emplace_back("sampled " + std::to_string(samples) + " x3",
                             [&sampling, samples](const Motion& m) { return sampling.run(m, samples, 3); });
    }
    for (const Sizes& sizes :
         {Sizes{8, 0, 0, 1}, Sizes{32, 0, 0, 1}, Sizes{64, 0, 0, 1}, Sizes{64, 0, 0, 3}}) {
      proposers.emplace_back(
          "random " + std::to_string(sizes.population) + " x" + std::to_string(sizes.proposals),
          [&search, sizes](const Motion& m) { return search.run(m, sizes); });
    }
    for (const Sizes& sizes : {Sizes{4, 1, 0, 1}, Sizes{8, 1, 0, 1}, Sizes{8, 3, 1, 1}, Sizes{16, 1, 0, 1},
                               Sizes{16, 3, 2, 1}, Sizes{16, 3, 2, 3}, Sizes{32, 6, 4, 1}}) {
      proposers.emplace_back("genetic " + std::to_string(sizes.population) + "/" +
                                 std::to_string(sizes.generations) + " x" + std::to_string(sizes.proposals),
                             [&search, sizes](const Motion& m) { return search.run(m, sizes); });
    }
    std::map<std::string, Tally> tallies;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Motion motion = motions.draw(RandomMotions::kinds()[i % 5]);
      const JointMotion given = asJointMotion(stage, motion);
      ClearanceParameters parameters;
      parameters.tolerance = tolerance;
      parameters.threads = 1;
      const ClearanceResult truth = findClearance(*stage.scene(), joints, state, given, parameters);
      double none_ms = 0.0;
      const auto measure = [&](const std::string& name, const Proposer& proposer) {
        double proposal_ms = std::numeric_limits<double>::infinity();
        double search_ms = proposal_ms;
        double best = proposal_ms;
        ClearanceResult found;
        for (int repetition = 0; repetition < 2; ++repetition) {
          const QueryClock clock;
          const std::vector<Proposal> proposals = proposer(motion);
          proposal_ms = std::min(proposal_ms, 1e-3 * clock.microseconds());
          parameters.starts.clear();
          for (const Proposal& p : proposals) {
            parameters.starts.push_back({stage.pairs()[p.pair].a, stage.pairs()[p.pair].b, p.time});
            best = std::min(best, p.distance);
          }
          const QueryClock second;
          found = findClearance(*stage.scene(), joints, state, given, parameters);
          search_ms = std::min(search_ms, 1e-3 * second.microseconds());
        }
        if (name == "none") none_ms = search_ms;
        Tally& tally = tallies[name];
        tally.proposal_ms.push_back(proposal_ms);
        tally.search_ms.push_back(search_ms);
        tally.ratio.push_back((proposal_ms + search_ms) / none_ms);
        tally.queries.push_back(static_cast<double>(found.queries));
        tally.above_mm.push_back(1e3 * (best - truth.distance));
      };
      for (const auto& [name, proposer] : proposers) measure(name, proposer);
      std::size_t pair =
          stage.findPair(stage.scene()->bodies[truth.body_a].name, stage.scene()->bodies[truth.body_b].name);
      measure("perfect", [&](const Motion&) {
        return std::vector<Proposal>{{pair, truth.time, truth.distance}};
      });
    }
    proposers.emplace_back("perfect", Proposer());
    for (const auto& [name, proposer] : proposers) {
      const Tally& t = tallies[name];
      std::vector<double> sums;
      for (std::size_t i = 0; i < t.ratio.size(); ++i) sums.push_back(t.proposal_ms[i] + t.search_ms[i]);
      table.add(stage.name(), name, t.ratio.size(), mean(t.proposal_ms), mean(t.search_ms), mean(sums),
                median(sums), median(t.ratio), mean(t.queries), median(t.above_mm));
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
