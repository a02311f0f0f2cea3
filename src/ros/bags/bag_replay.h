#pragma once

#include <concave_distance/PairNiches.h>
#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "bag_transforms.h"
#include "concave_distance/scene/scene.h"
#include "ros/node/distance_cycle.h"
#include "ros/tf/transform_buffer.h"

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
  std::uint64_t messages = 0;
  std::uint64_t transforms = 0;  ///< accepted, of a stamp of their own
  std::uint64_t stamps = 0;      ///< that a cycle was run for
  std::uint64_t rows = 0;
  std::uint64_t answers = 0;  ///< rows with a distance
  std::uint64_t refused = 0;  ///< transforms that the node refuses, and messages that are none
  /// The first reason for each frame and sender, up to kMostReasons.
  std::map<std::string, std::string> reasons;
};

/// Plays transforms and gives each pair's answer at every stamp of a transform that its place depends on, in
/// the order of stamps. A stamp waits for others until transforms are newer than it by the time after which
/// they are stale (or half of the cache), so that slower publishers are interpolated; what the node answers
/// at a stamp is what is answered here. It has no clock and no budget: the same messages give the same bytes.
class BagReplay {
 public:
  using Sink = std::function<void(const BagAnswer&)>;
  static constexpr std::size_t kMostReasons = 10;

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
  bool hasAnswer() const;
  /// Returns the pairs that have rows and not one answer, with the reason of the last.
  std::map<std::string, std::string> unanswered() const;
  const TransformBuffer& transforms() const { return buffer_; }

 private:
  struct Held {
    geometry_msgs::TransformStamped transform;
    std::string sender;
  };
  using Frames = std::unordered_set<std::string>;
  /// Holds what happens at one stamp.
  struct Moment {
    ros::Time recorded;
    Frames frames;              ///< that have a transform of it
    std::vector<Held> changes;  ///< of static transforms, to be made first
  };
  /// The moving transforms of one frame. The buffer gets one at its stamp; before that only where an earlier
  /// stamp needs it to be interpolated, because tf rounds where it has newer ones.
  struct Track {
    std::map<ros::Time, Held> waiting;
    ros::Time newest;         ///< that the buffer has; zero: none
    ros::Time newest_of_bag;  ///< that has come
    std::string sender;       ///< of that
  };
  /// The last row of a pair.
  struct Row {
    bool is_wanted = false;
    bool has_row = false;
    bool has_answer = false;
    std::uint8_t code = 0;
    ros::Time stamp;
    Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
    std::string problem;
  };
  void takeTransform(const geometry_msgs::TransformStamped& transform, const BagMessage& message);
  void takeFixed(const geometry_msgs::TransformStamped& transform, const BagMessage& message);
  bool insert(const geometry_msgs::TransformStamped& transform, const std::string& sender, bool fixed);
  Moment& momentAt(ros::Time stamp, ros::Time recorded);
  void note(const geometry_msgs::TransformStamped& transform, const std::string& sender,
            const TransformProblem& problem);
  void answerWhatIsReady(bool is_end);
  void answer(ros::Time stamp, Moment& moment);
  void fillBuffer(ros::Time stamp, Moment& moment);
  bool insertNext(Track& track);
  PairDemand demandOf(const TrackedPair& pair, const Moment& moment);
  void report(const PublishedPair& pair, const Moment& moment);
  Row& rowOf(const std::string& pair);
  bool isStopped() const { return options_.cycle.stop != nullptr && *options_.cycle.stop; }

  const ReplayOptions options_;
  const double lag_;  ///< s
  const Sink sink_;
  ros::Time now_;         ///< of the last message
  ros::Time buffer_now_;  ///< the buffer's clock: when what it is given was recorded
  TransformBuffer buffer_;
  DistanceCycle cycle_;
  std::map<std::string, Track> tracks_;  ///< by frame
  std::map<ros::Time, Moment> waiting_;
  std::map<ros::Time, Frames> answered_;  ///< as far back as the buffer takes transforms
  ros::Time newest_;                      ///< stamp of a moving transform
  std::unordered_map<std::string, geometry_msgs::TransformStamped> fixed_;
  std::unordered_map<std::string, Row> rows_;
  std::vector<char> depends_;  ///< of each body on the moment's frames; 2: not looked up yet
  bool was_beyond_ = false;    ///< a pair by rule that is not near
  ReplayCounts counts_;
};

}  // namespace concave_distance
