#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "clearance_gap.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/kinematics/clearance.h"

namespace concave_distance::detail {

/// Looks for the least distance of several pairs over one motion: the gaps between samples, the least proven
/// first, get another sample where they prove least (Piyavskii 1972; Shubert 1972), until none can hold a
/// distance more than the tolerance below the least one found. A fixed number of gaps is worked on together,
/// whatever the number of threads, so that there is one answer.
class ClearanceSearch {
 public:
  ClearanceSearch(const MotionPaths& paths, const std::vector<ClearancePair>& pairs,
                  const ClearanceParameters& parameters, WorkLimit limit);

  void findLeast();
  /// After findLeast(): narrows down when a distance is first below `threshold`, metres.
  void findFirstBelow(double threshold);

  struct Least {
    std::size_t pair = 0;
    ClearanceSample sample;
  };
  /// The nearest that was found, of all pairs or of one; empty where no distance was computed.
  const std::optional<Least>& least() const { return least_; }
  struct PairLeast {
    double lower = std::numeric_limits<double>::infinity();  ///< metres, proven for the whole motion
    double distance = std::numeric_limits<double>::infinity();
    double moment = 0.0;
  };
  std::vector<PairLeast> pairs() const;
  double lower() const;  ///< metres, proven for all

  struct First {
    double proven_until = 0.0;     ///< moment
    std::optional<double> moment;  ///< at which a pair is below
    std::size_t pair = 0;
  };
  const First& first() const { return first_; }

  std::uint64_t queries() const { return queries_; }
  std::uint64_t boxQueries() const { return box_queries_; }
  /// Time or samples ran out.
  bool isCut() const { return is_cut_; }

 private:
  struct Key {
    double order;  ///< least first
    std::size_t pair;
    double moment;
    std::size_t gap;                         ///< place in gaps_
    bool operator<(const Key& other) const;  ///< for std::push_heap: the first has the least order
  };
  struct Job {
    std::size_t gap = 0;
    ClearanceSample sample;
    std::vector<ClearanceGap> parts;
  };

  void begin();
  void addStarts();
  void sharpenLeast();
  void sampleExactly(std::size_t pair, double moment);
  template <typename Work>
  void runJobs(const Work& work);
  void refine(Job& job, ClearanceWorkspace& workspace) const;
  void narrow(Job& job, double threshold, ClearanceWorkspace& workspace) const;
  void sampleAndSplit(Job& job, double moment, const SampleRequest& request,
                      ClearanceWorkspace& workspace) const;
  void take(const ClearanceSample& sample, std::size_t pair);
  void push(const ClearanceGap& gap, double order);
  std::size_t pop();
  void close(const ClearanceGap& gap);
  double aimOf(std::size_t pair) const;
  bool isDone(const ClearanceGap& gap) const;
  bool isUndivided(const ClearanceGap& gap) const;
  bool mayGoOn(bool is_first);
  void report();

  const MotionPaths& paths_;
  const std::vector<ClearancePair>& pairs_;
  const ClearanceParameters& parameters_;
  WorkLimit limit_;
  std::vector<ClearanceGap> gaps_;
  std::vector<std::size_t> free_;   ///< places in gaps_
  std::vector<Key> open_;           ///< a heap
  std::vector<ClearanceGap> kept_;  ///< closed, but a threshold may be reached in them
  std::vector<PairLeast> records_;
  std::vector<Job> jobs_;
  tbb::task_arena arena_;
  std::vector<ClearanceWorkspace> workspaces_;  ///< of the arena's threads
  std::optional<Least> least_;
  First first_;
  double closed_ = 0.0;  ///< length of motion, of all pairs together
  std::uint64_t queries_ = 0;
  std::uint64_t box_queries_ = 0;
  bool is_cut_ = false;
  WorkLimit::Clock::time_point next_report_;
};

}  // namespace concave_distance::detail
