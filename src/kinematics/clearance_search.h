#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "gap_queue.h"
#include "gap_sampler.h"

namespace concave_distance::detail {

/// Looks for the least distance of several pairs over one motion: the gaps between samples, the least proven
/// first, get another sample where they prove least (Piyavskii 1972; Shubert 1972), until none can hold a
/// distance more than the tolerance below the least one found.
class ClearanceSearch {
 public:
  explicit ClearanceSearch(GapSampler& sampler);

  void findLeast();

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
  /// Returns the gaps in which there may be contact or a distance below the threshold of the parameters.
  std::vector<ClearanceGap> gapsBelow() const;
  ClearanceProgress progress() const;
  /// Time or samples ran out.
  bool isCut() const { return is_cut_; }

 private:
  void begin();
  void sharpenLeast();
  void refine(const ClearanceGap& gap, GapJob& job, ClearanceWorkspace& workspace) const;
  void take(const ClearanceSample& sample, std::size_t pair);
  void close(const ClearanceGap& gap);
  double aimOf(std::size_t pair) const;
  bool isDone(const ClearanceGap& gap) const;
  bool isUndivided(const ClearanceGap& gap) const;

  GapSampler& sampler_;
  const ClearanceParameters& parameters_;
  GapQueue open_;
  std::vector<ClearanceGap> kept_;  ///< closed, but a threshold may be reached in them
  std::vector<PairLeast> records_;
  std::vector<GapJob> jobs_;
  std::optional<Least> least_;
  double closed_ = 0.0;  ///< length of motion, of all pairs together
  bool is_cut_ = false;
};

}  // namespace concave_distance::detail
