#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearance_gap.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/kinematics/clearance.h"

namespace concave_distance::detail {

/// A gap that gets another sample, and the gaps that it becomes.
struct GapJob {
  std::size_t gap = 0;  ///< place in the queue of the search
  ClearanceSample sample;
  std::vector<ClearanceGap> parts;
};

/// Takes the samples of a search over one motion, on several threads, counts them and reports the progress.
class GapSampler {
 public:
  /// Searches have at most this many gaps sampled together, whatever the number of threads, so that there is
  /// one answer.
  static constexpr std::size_t kMostJobs = 32;

  GapSampler(const MotionPaths& paths, const std::vector<ClearancePair>& pairs,
             const ClearanceParameters& parameters, WorkLimit limit);

  const MotionPaths& paths() const { return paths_; }
  const std::vector<ClearancePair>& pairs() const { return pairs_; }
  const ClearanceParameters& parameters() const { return parameters_; }

  /// Calls work(job, workspace) for each job; it writes to nothing but these two.
  template <typename Work>
  void run(std::vector<GapJob>& jobs, const Work& work);
  /// Samples a gap inside or at one of its ends, and bounds the parts that it then has. Any thread may call
  /// it.
  void split(const ClearanceGap& gap, double moment, const SampleRequest& request, GapJob& job,
             ClearanceWorkspace& workspace) const;
  /// Computes the distance of a pair without tolerance. @param start triangles that may be the nearest
  ClearanceSample sampleExactly(std::size_t pair, double moment, const TrianglePair& start);

  /// Says that the time or the samples ran out.
  bool isSpent() { return limit_.isOver() || queries_ + box_queries_ >= parameters_.sample_limit; }
  std::uint64_t queries() const { return queries_; }
  std::uint64_t boxQueries() const { return box_queries_; }

  /// Calls the user's progress function when the next report is due. @param describe makes a
  /// ClearanceProgress without the number of queries
  template <typename Describe>
  void report(const Describe& describe);

 private:
  void count();
  bool isReportDue();

  const MotionPaths& paths_;
  const std::vector<ClearancePair>& pairs_;
  const ClearanceParameters& parameters_;
  WorkLimit limit_;
  tbb::task_arena arena_;
  std::vector<ClearanceWorkspace> workspaces_;  ///< of the arena's threads
  std::uint64_t queries_ = 0;
  std::uint64_t box_queries_ = 0;
  WorkLimit::Clock::time_point next_report_;
};

template <typename Work>
void GapSampler::run(std::vector<GapJob>& jobs, const Work& work) {
  if (workspaces_.size() == 1 || jobs.size() == 1) {
    for (GapJob& job : jobs) work(job, workspaces_.front());
  } else {
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, jobs.size(), 1),
                        [&](const tbb::blocked_range<std::size_t>& range) {
                          const int thread = tbb::this_task_arena::current_thread_index();
                          ClearanceWorkspace& workspace = workspaces_[static_cast<std::size_t>(thread)];
                          for (std::size_t i = range.begin(); i != range.end(); ++i) work(jobs[i], workspace);
                        });
    });
  }
  count();
}

template <typename Describe>
void GapSampler::report(const Describe& describe) {
  if (!isReportDue()) return;
  ClearanceProgress progress = describe();
  progress.queries = queries_;
  parameters_.progress(progress);
}

}  // namespace concave_distance::detail
