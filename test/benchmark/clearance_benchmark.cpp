// The least distance over a motion (findClearance), judged and timed beside FCL: random motions of the demo
// arm in its cell and before a shelf; short, long, near, colliding, grazing and on cubics in turn.
//
//   clearance_benchmark [--motions 1000] [--seed 1] [--tolerances 0.01,0.001,0.0001] [--sample-step 0.001]
//                       [--threshold 0.02] [--fixed-every 1] [--output doc/results/clearance.csv]
//                       [--times-output doc/results/clearance_times.csv]
//
// The oracle samples a motion densely by FCL: no point moves by more than `sample-step` metres from one
// sample to the next, and the nearest samples are refined by golden section. It shares with the library the
// loading of the scene alone; kinematics and motion bounds are its own.
//
// A row of the first table is a stage, a kind and a tolerance: motions; those with a contact; `above`, whose
// lower bound is above the sampled least by more than 1e-9 m; `apart`, whose distance FCL does not find at
// its time (1e-9 m); `wide`, whose bracket is wider than the tolerance; `unseen`, whose contact the samples
// have and the lower bound excludes; the largest bracket, mm; `sampled_more`, contacts that even dense
// sampling takes for none; contacts that the waypoints and steps of 0.05 and 0.01 rad miss; motions whose
// first time below the threshold was compared, those of which it is wrong (proven beyond a sample that is
// below, or not below where it says so) or open (a sample is below, and the answer says only how long none
// is), and by how much it is later than the sampled one at most, ms.
//
// A row of the second is a stage, a tolerance and a method, on the motions that are not cubic: `ours`;
// `steps`, fixed steps with the same guarantee; `bisection`, that of Schwarzer, Saha and Latombe
// (fcl_clearance.h). Times are of one thread, ms: median, 99th percentile, mean; the median of ratios to
// ours, motion by motion; distances asked for, mean. Of the steps every `fixed-every`-th motion is run at the
// smallest tolerance.
#include <algorithm>
#include <cmath>
#include <map>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/fcl_clearance.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/random_motions.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/sampled_clearance.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/kinematics/clearance.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kExact = 1e-9;  // m, of FCL's distance and ours
constexpr std::size_t kMostDistances = 20'000'000;

struct Options {
  std::uint32_t motions = 1000;
  std::uint32_t seed = 1;
  std::vector<double> tolerances{1e-2, 1e-3, 1e-4};
  double sample_step = 1e-3;
  double threshold = 0.02;
  std::uint32_t fixed_every = 1;
  std::string times_output;
};

JointMotion jointMotion(const MotionStage& stage, const Motion& motion) {
  JointMotion given;
  given.joints = stage.chain().jointNames();
  given.times = motion.times;
  const auto rows = static_cast<Eigen::Index>(motion.positions.size());
  given.positions.resize(rows, stage.chain().jointCount());
  if (!motion.velocities.empty()) given.velocities.resize(rows, stage.chain().jointCount());
  for (Eigen::Index i = 0; i < rows; ++i) {
    given.positions.row(i) = motion.positions[static_cast<std::size_t>(i)];
    if (!motion.velocities.empty()) given.velocities.row(i) = motion.velocities[static_cast<std::size_t>(i)];
  }
  return given;
}

/// Counts what a kind of motions shows at a tolerance.
struct Judged {
  std::size_t motions = 0;
  std::size_t contacts = 0;
  std::size_t above = 0;
  std::size_t apart = 0;
  std::size_t wide = 0;
  std::size_t unseen = 0;
  double largest_gap = 0.0;
  std::size_t sampled_more = 0;
  std::size_t missed_at_waypoints = 0;
  std::size_t missed_at_coarse = 0;
  std::size_t missed_at_fine = 0;
  std::size_t first_compared = 0;
  std::size_t first_wrong = 0;
  std::size_t first_open = 0;
  double first_later = 0.0;
};

struct Timed {
  std::vector<double> ms;
  std::vector<double> ratios;
  std::vector<double> distances;
};

/// One motion with what sampling says of it.
struct Case {
  Motion motion;
  Sampled sampled;
  bool waypoints_touch = false;
  bool coarse_touches = false;
  bool fine_touches = false;
};

class Judge {
 public:
  Judge(const MotionStage& stage, const Options& options)
      : stage_(stage), options_(options), joints_(*stage.scene()), state_(joints_.startState()) {}

  Case prepare(const Motion& motion) const {
    Case made{motion, sampleMotion(stage_, motion, {options_.sample_step, options_.threshold, true})};
    made.waypoints_touch = touchesAtSteps(stage_, motion, std::numeric_limits<double>::infinity());
    made.coarse_touches = touchesAtSteps(stage_, motion, 0.05);
    made.fine_touches = touchesAtSteps(stage_, motion, 0.01);
    return made;
  }

  void run(const Case& given, double tolerance, bool has_steps) {
    ClearanceParameters parameters;
    parameters.tolerance = tolerance;
    parameters.threads = 1;
    const JointMotion motion = jointMotion(stage_, given.motion);
    const QueryClock clock;
    const ClearanceResult found = findClearance(*stage_.scene(), joints_, state_, motion, parameters);
    const double ms = 1e-3 * clock.microseconds();
    parameters.threshold = options_.threshold;
    const ClearanceResult first = findClearance(*stage_.scene(), joints_, state_, motion, parameters);
    Judged& judged = judged_[{given.motion.kind, -tolerance}];
    judge(given, tolerance, found, judged);
    judgeFirst(given, first, judged);
    ++judged.motions;
    countContact(given, found, judged);
    if (!given.motion.velocities.empty()) return;
    add("ours", tolerance, ms, ms, static_cast<double>(found.queries));
    if (has_steps) time("steps", clearanceByFixedSteps, given, tolerance, ms);
    time("bisection", clearanceByBisection, given, tolerance, ms);
  }

  void write(ResultTable& judged_table, ResultTable& times_table) const {
    for (const std::string& kind : RandomMotions::kinds()) {
      for (const double tolerance : options_.tolerances) {
        const auto at = judged_.find({kind, -tolerance});
        if (at == judged_.end()) continue;
        const Judged& j = at->second;
        judged_table.add(stage_.name(), kind, 1e3 * tolerance, j.motions, j.contacts, j.above, j.apart,
                         j.wide, j.unseen, 1e3 * j.largest_gap, j.sampled_more, j.missed_at_waypoints,
                         j.missed_at_coarse, j.missed_at_fine, j.first_compared, j.first_wrong, j.first_open,
                         1e3 * j.first_later);
      }
    }
    for (const auto& [key, timed] : timed_) {
      times_table.add(stage_.name(), -1e3 * key.first, key.second, timed.ms.size(), median(timed.ms),
                      percentile(timed.ms, 0.99), mean(timed.ms), median(timed.ratios),
                      mean(timed.distances));
    }
  }

 private:
  double fclDistanceAt(const std::string& a, const std::string& b, double time, const Motion& motion) {
    stage_.place(motion.at(time), poses_);
    return stage_.distanceAt(stage_.findPair(a, b), poses_);
  }
  const std::string& nameOf(std::size_t body) const { return stage_.scene()->bodies[body].name; }

  void judge(const Case& given, double tolerance, const ClearanceResult& found, Judged& judged) {
    const double there = fclDistanceAt(nameOf(found.body_a), nameOf(found.body_b), found.time, given.motion);
    const bool is_above = found.lower_bound > given.sampled.least + kExact;
    const bool is_apart = std::abs(there - found.distance) > kExact;
    const double gap = found.distance - found.lower_bound;
    judged.above += is_above ? 1 : 0;
    judged.apart += is_apart ? 1 : 0;
    judged.wide += gap > tolerance * (1.0 + 1e-12) ? 1 : 0;
    judged.unseen += given.sampled.least <= 0.0 && found.lower_bound > 0.0 ? 1 : 0;
    judged.largest_gap = std::max(judged.largest_gap, gap);
    if (is_above || is_apart || gap > tolerance * (1.0 + 1e-12)) {
      std::fprintf(
          stderr,
          "%s %s tol %g: [%.12g, %.12g] at %.9g s of %s/%s, FCL there %.12g; sampled %.12g at %.9g s of %s\n",
          stage_.name().c_str(), given.motion.kind.c_str(), tolerance, found.lower_bound, found.distance,
          found.time, nameOf(found.body_a).c_str(), nameOf(found.body_b).c_str(), there, given.sampled.least,
          given.sampled.least_time, stage_.pairs()[given.sampled.pair].name.c_str());
    }
  }

  void judgeFirst(const Case& given, const ClearanceResult& found, Judged& judged) {
    const FirstBelow& first = *found.first_below;
    const double sampled = given.sampled.first_below;
    ++judged.first_compared;
    bool is_wrong = first.proven_until > sampled + 1e-9;
    judged.first_open += std::isfinite(sampled) && std::isnan(first.time) ? 1 : 0;
    if (!std::isnan(first.time)) {
      const double there =
          fclDistanceAt(nameOf(first.body_a), nameOf(first.body_b), first.time, given.motion);
      is_wrong = is_wrong || there > options_.threshold + kExact;
      if (std::isfinite(sampled)) judged.first_later = std::max(judged.first_later, first.time - sampled);
    }
    judged.first_wrong += is_wrong ? 1 : 0;
    if (is_wrong) {
      std::fprintf(stderr, "%s %s: below %g first at %.9g s (proven until %.9g s), sampled %.9g s\n",
                   stage_.name().c_str(), given.motion.kind.c_str(), options_.threshold, first.time,
                   first.proven_until, sampled);
    }
  }

  static void countContact(const Case& given, const ClearanceResult& found, Judged& judged) {
    if (found.distance > 0.0) return;
    ++judged.contacts;
    judged.sampled_more += given.sampled.least > 0.0 ? 1 : 0;
    judged.missed_at_waypoints += given.waypoints_touch ? 0 : 1;
    judged.missed_at_coarse += given.coarse_touches ? 0 : 1;
    judged.missed_at_fine += given.fine_touches ? 0 : 1;
  }

  template <typename Method>
  void time(const char* name, const Method& method, const Case& given, double tolerance, double ours_ms) {
    const QueryClock clock;
    const ClearanceBracket bracket = method(stage_, given.motion, tolerance, kMostDistances);
    const double ms = 1e-3 * clock.microseconds();
    if (bracket.lower > given.sampled.least + kExact || !bracket.is_whole) {
      std::fprintf(stderr, "%s, %s: [%.12g, %.12g], sampled %.12g\n", name, given.motion.kind.c_str(),
                   bracket.lower, bracket.upper, given.sampled.least);
    }
    add(name, tolerance, ms, ours_ms, static_cast<double>(bracket.distances));
  }

  void add(const std::string& name, double tolerance, double ms, double ours_ms, double distances) {
    Timed& timed = timed_[{-tolerance, name}];
    timed.ms.push_back(ms);
    timed.ratios.push_back(ms / ours_ms);
    timed.distances.push_back(distances);
  }

  const MotionStage& stage_;
  const Options& options_;
  SceneKinematics joints_;
  SceneState state_;
  MotionStage::Poses poses_;
  std::map<std::pair<std::string, double>, Judged> judged_;
  std::map<std::pair<double, std::string>, Timed> timed_;
};

}  // namespace

int benchmarkMain(int argc, char** argv) {
  Options options;
  ProgramOptions program("The least distance over motions, beside FCL");
  program.add("--motions", options.motions, "motions, half of them on each stage", 2U);
  program.add("--seed", options.seed, "of the motions");
  program.add("--tolerances", options.tolerances, "metres");
  program.add("--sample-step", options.sample_step, "metres from one sample to the next");
  program.add("--threshold", options.threshold, "metres, for the first time below it");
  program.add("--fixed-every", options.fixed_every,
              "at the smallest tolerance, fixed steps for one motion in so many", 1U);
  program.add("--times-output", options.times_output, "CSV file to write the times to");
  if (!program.read(argc, argv)) return program.status();
  ResultTable judged(
      program.output(),
      "stage,kind,tolerance_mm,motions,contacts,above,apart,wide,unseen,largest_gap_mm,sampled_more,"
      "missed_waypoints,missed_coarse,missed_fine,first_compared,first_wrong,first_open,first_later_"
      "ms");
  ResultTable times(options.times_output,
                    "stage,tolerance_mm,method,motions,median_ms,p99_ms,mean_ms,over_ours,mean_distances");
  const double smallest = *std::min_element(options.tolerances.begin(), options.tolerances.end());
  for (const MotionStage& stage : {cellStage(), shelfStage()}) {
    RandomMotions motions = motionsOf(stage, options.seed);
    Judge judge(stage, options);
    for (std::uint32_t i = 0; i < options.motions / 2; ++i) {
      const Case made =
          judge.prepare(motions.draw(RandomMotions::kinds()[i % RandomMotions::kinds().size()]));
      for (const double tolerance : options.tolerances) {
        judge.run(made, tolerance, tolerance > smallest || i % options.fixed_every == 0);
      }
    }
    judge.write(judged, times);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
