#include "distance_query_run.h"

#include <chrono>
#include <memory>
#include <ostream>
#include <sstream>

#include "base/output_file.h"
#include "base/run_together.h"
#include "concave_distance/loading/load_body_mesh.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/preparation_cache.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "loading/query_poses.h"
#include "query_report.h"

namespace concave_distance::tools {
namespace {

/// Keys the random streams: fixed, so that an answer depends on the meshes, the pose and the seed alone.
constexpr const char* kPairName = "distance_query";

std::shared_ptr<const BodyMesh> loadBody(const std::string& path, double scale,
                                         const LoadMeshOptions& options, std::ostream& log) {
  LoadedBodyMesh loaded = loadBodyMesh(path, scale, options);
  if (const std::string summary = loaded.repair.summary(); !summary.empty()) {
    log << path << ": " << summary << '\n';
  }
  return std::move(loaded.mesh);
}

struct LoadedBodies {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
};

LoadedBodies loadBodies(const DistanceQueryOptions& options, std::ostream& log) {
  LoadMeshOptions load_options;
  load_options.body.max_edge_length = options.max_edge_length;
  load_options.body.cache = openPreparationCache(options.cache);
  LoadedBodies bodies;
  std::ostringstream log_b;  // both at once, what they say one after the other
  runTogether({[&] { bodies.a = loadBody(options.mesh_a, options.scale_a, load_options, log); },
               [&] { bodies.b = loadBody(options.mesh_b, options.scale_b, load_options, log_b); }});
  log << log_b.str();
  if (load_options.body.cache) {
    if (const std::string problem = load_options.body.cache->takeProblem(); !problem.empty())
      log << problem << '\n';
  }
  return bodies;
}

/// Solves pose after pose; without tracking each as if it were the first.
class Solver {
 public:
  Solver(const DistanceQueryOptions& options, std::ostream& log)
      : tracker_(makeTracker(options, loadBodies(options, log))), tracking_(options.tracking) {}

  /// Microseconds of the query alone: everything between the loaded bodies and the answer.
  double solve(const Eigen::Isometry3d& pose, double time) {
    const auto start = std::chrono::steady_clock::now();
    if (tracking_) {
      tracker_.update(pose, time, solution_);
    } else {
      tracker_.solve(pose, solution_);
    }
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }

  const PairSolution& solution() const { return solution_; }

 private:
  static PairTracker makeTracker(const DistanceQueryOptions& options, const LoadedBodies& bodies) {
    TrackerParameters parameters = options.settings.tracker;
    parameters.niches_wanted = !options.niches_output.empty();
    return {kPairName, bodies.a, bodies.b, parameters};
  }

  PairTracker tracker_;
  bool tracking_;
  PairSolution solution_;
};

}  // namespace

void runDistanceQuery(const DistanceQueryOptions& options, std::ostream& log) {
  requireDistinctFiles(
      {{"--mesh-a", options.mesh_a}, {"--mesh-b", options.mesh_b}, {"--poses", options.poses}},
      {{"--output", options.output}, {"--niches-output", options.niches_output}});
  const std::vector<QueryPose> poses = readQueryPoses(options.poses);
  Solver solver(options, log);
  AnswerWriter answers(options.output);
  std::unique_ptr<NicheWriter> niches;
  if (!options.niches_output.empty()) niches = std::make_unique<NicheWriter>(options.niches_output);
  std::size_t cut_lists = 0;
  for (std::size_t index = 0; index < poses.size(); ++index) {
    QueryAnswer answer;
    const std::optional<Eigen::Isometry3d> pose = poseOf(poses[index]);
    if (!pose) {
      answer.status = toString(SolveStatus::InvalidPose);
      answers.write(index, answer);
      continue;
    }
    answer.time_us = solver.solve(*pose, poses[index].time);
    const PairSolution& solution = solver.solution();
    answer.distance = solution.distance;
    answer.lower_bound = solution.lower_bound;
    answer.point_a_in_a = solution.point_a_in_a;
    answer.point_b_in_a = solution.point_b_in_a;
    answer.status = toString(solution.status);
    answer.meeting_triangles = solution.meeting_triangles;
    if (niches && solution.status != SolveStatus::InvalidPose) {
      answer.niche_count = solution.niches.size();
      cut_lists += solution.niches_cut ? 1 : 0;
      std::uint64_t rank = 0;
      for (const TrackedNiche& niche : solution.niches) {
        niches->write(index, options.tracking ? niche.id : rank, niche,
                      options.settings.tracker.accuracy != AccuracyLevel::Nodes);
        ++rank;
      }
    }
    answers.write(index, answer);
  }
  answers.complete();
  if (niches) niches->complete();
  answers.finish();
  if (niches) niches->finish();
  if (cut_lists > 0) {
    log << cut_lists << " queries have more niches than the " << options.settings.tracker.largest_niche_count
        << " that are listed; give a --cutoff or --largest-niche-count\n";
  }
}

}  // namespace concave_distance::tools
