#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "concave_distance/base/not_computed.h"
#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance {

/// Holds the pose that the tracker of a pair got in a cycle, to the last bit, and what it answered.
struct RecordedCycle {
  Eigen::Matrix<double, 3, 4, Eigen::DontAlign> a_from_b;
  double time = 0.0;  ///< seconds, as PairInput::time
  double distance = kNotComputed;
  double lower_bound = kNotComputed;  ///< with BeyondCutoff that of the boxes
  std::uint32_t niche_count = 0;
  std::uint32_t missed_before = 0;  ///< cycles without a pose since the one before
  PairState state = PairState::NotWatched;
  SolveStatus status = SolveStatus::Ok;
  bool with_niches = false;
  bool put_off = false;

  Eigen::Isometry3d pose() const;
};

/// Holds the last cycles of one pair, the oldest first.
struct PairRecording {
  std::shared_ptr<const ScenePair> pair;
  std::shared_ptr<const SceneBody> body_a;
  std::shared_ptr<const SceneBody> body_b;
  std::vector<RecordedCycle> cycles;
  std::uint32_t missed_after = 0;  ///< cycles without a pose since the last one
  std::int64_t epoch = 0;          ///< nanoseconds since 1970 that times count from
  bool has_room = true;            ///< false: the memory for recordings was used up before this pair came
  /// The whole answer of the last cycle; nothing where no cycle came while it was waited for, or that had
  /// none.
  std::optional<PairSolution> last_answer;
};

/// Keeps the last cycles of every pair that has a tracker, so that what has just happened can be written
/// down. A cycle that repeats an answer, or goes on with one at the same pose, is none of its own. A pair
/// begins anew when the clock jumps back or a body gets another mesh; one that has no tracker any more is
/// forgotten. Thread-safe; record() never waits for more than a copy of one pair's cycles.
class PairRecorder {
 public:
  /// @param length cycles of each pair; 0: nothing is kept
  /// @param most_bytes for the cycles of all pairs together
  explicit PairRecorder(std::uint32_t length, std::size_t most_bytes = std::size_t{256} << 20U)
      : length_(length), most_bytes_(most_bytes) {}
  std::uint32_t length() const { return length_; }

  /// Adds the cycle that these pairs have just had. Allocates nothing while no pair comes, leaves or gets its
  /// first answer. @param epoch as PairRecording::epoch
  void record(const SceneTracker::Pairs& pairs, std::int64_t epoch);
  /// Returns the last cycles of the pair of these bodies (SceneBody::serial, in either order); nothing when
  /// it has no tracker. @param most cycles @param wait for a cycle, which brings the whole answer
  std::optional<PairRecording> take(std::uint64_t body_a, std::uint64_t body_b, std::size_t most,
                                    std::chrono::milliseconds wait);

 private:
  /// The cycles of one pair, in a ring that is allocated once.
  struct Slot {
    std::shared_ptr<const TrackedPair> tracked;
    std::shared_ptr<const ScenePair> pair;
    std::shared_ptr<const SceneBody> body_a;
    std::shared_ptr<const SceneBody> body_b;
    std::vector<RecordedCycle> ring;  ///< empty: no answer yet
    std::size_t next = 0;             ///< place in it of the next cycle
    std::size_t count = 0;
    std::uint32_t missed = 0;  ///< since the last one
    bool has_room = true;

    RecordedCycle& last() { return ring[(next + ring.size() - 1) % ring.size()]; }
  };
  struct Request {
    std::uint64_t body_a;
    std::uint64_t body_b;
    std::size_t most;
    bool is_answered = false;
    PairRecording recording;
  };
  void follow(const SceneTracker::Pairs& pairs);
  void add(Slot& slot);
  void answer(const Slot& slot, Request& request) const;
  static bool isOf(const Slot& slot, std::uint64_t body_a, std::uint64_t body_b);

  const std::uint32_t length_;
  const std::size_t most_bytes_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable answered_;
  std::vector<Slot> slots_;  ///< in the order of SceneTracker::pairs()
  std::size_t rings_ = 0;    ///< slots that have one
  std::int64_t epoch_ = 0;
  Request* request_ = nullptr;  ///< of the call that waits
};

}  // namespace concave_distance
