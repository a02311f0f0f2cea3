#pragma once

#include <concave_distance/PairNiches.h>
#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bag_moments.h"
#include "bag_rows.h"
#include "concave_distance/scene/scene.h"
#include "ros/node/distance_cycle.h"

namespace concave_distance {

struct ReplayOptions {
  CycleOptions cycle;  ///< the number of times is not limited, whatever it says
  TransformLimits limits;
  bool niches = false;                ///< they are wanted too
  std::vector<std::string> patterns;  ///< of the pairs that are followed; empty: all
};

/// A pair's answer at one time, or why it has none from there on.
struct BagAnswer {
  ros::Time recorded;         ///< when the first transform of that stamp was
  const PairNiches& message;  ///< what the node would publish
};

struct ReplayCounts {
  std::uint64_t stamps = 0;  ///< that a cycle was run for
  std::uint64_t rows = 0;
  std::uint64_t answers = 0;  ///< rows with a distance
};

/// Plays transforms and gives each pair's answer at every stamp of a transform that its place depends on, in
/// the order of stamps: what the node answers at a stamp is what is answered here. It has no clock and no
/// budget: the same messages give the same bytes.
class BagReplay {
 public:
  using Sink = std::function<void(const BagAnswer&)>;

  /// Time budgets in the scene's settings are not applied. @param sink gets the answers, in their order
  BagReplay(Scene scene, ReplayOptions options, Sink sink);
  BagReplay(const BagReplay&) = delete;
  BagReplay& operator=(const BagReplay&) = delete;

  /// Takes messages in the order of their times.
  void take(const BagMessage& message);
  /// Answers what still waits. Call it once, at the end.
  void finish();

  const ReplayCounts& counts() const { return counts_; }
  /// Returns whether a pair had a distance, or was proven beyond its cutoff, also one without rows.
  bool hasAnswer() const { return was_beyond_ || rows_.hasAnswer(); }
  const BagRows& rows() const { return rows_; }
  const BagMoments& moments() const { return moments_; }

 private:
  void answerWhatIsReady(bool is_end);
  void answer(const BagMoment& moment);
  PairDemand demandOf(const TrackedPair& pair, const BagMoment& moment);
  bool isStopped() const { return options_.cycle.stop != nullptr && *options_.cycle.stop; }

  const ReplayOptions options_;
  const Sink sink_;
  BagMoments moments_;
  BagRows rows_;
  DistanceCycle cycle_;
  std::vector<char> depends_;  ///< of each body on the moment's frames; 2: not looked up yet
  bool was_beyond_ = false;    ///< a pair by rule that is not near
  ReplayCounts counts_;
};

}  // namespace concave_distance
