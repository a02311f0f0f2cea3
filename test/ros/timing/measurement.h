#pragma once

#include <concave_distance/Distances.h>
#include <concave_distance/Niches.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bare_timer.h"
#include "processor_time.h"

namespace concave_distance {

/// What a measurement has found. Seconds, and counts.
struct Figures {
  double cycles = 0.0;
  double late = 0.0;
  double solved = 0.0;
  double cold = 0.0;
  double repeated = 0.0;
  double misses = 0.0;
  double cpu_seconds = 0.0;
  double cpu_largest = 0.0;
  double duration_seconds = 0.0;
  double duration_largest = 0.0;
  double watched = 0.0;
  std::uint64_t messages = 0;
  double largest_gap = 0.0;
  std::uint64_t unsolved = 0;  ///< pairs in messages, for want of transforms or because no niche was found
  std::string reason;          ///< of the last of them
  std::vector<double> warm_times;
  std::vector<double> cold_times;
  std::uint64_t lists = 0;           ///< of pairs with a distance, in newly solved messages
  std::uint64_t complete_lists = 0;  ///< of these
  std::uint64_t longest_wait = 0;    ///< messages in a row without a complete list of a pair
  PairNiches longest;                ///< the message of the longest solve
  std::vector<double> from_stamp;
  std::vector<double> from_receipt;
};

/// Listens to a node's messages, its diagnostics and tf.
class Measurement {
 public:
  /// @param topic of the node: `niches` or `distances`
  Measurement(ros::NodeHandle& node, const std::string& measured, const std::string& topic);

  bool hasSeenADistance() const { return seen_; }
  const Figures& figures() const { return figures_; }
  void restart();

 private:
  void onTransforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event);
  void onNiches(const ros::MessageEvent<Niches const>& event);
  void onDistances(const ros::MessageEvent<Distances const>& event);
  void onDiagnostics(const diagnostic_msgs::DiagnosticArray& array);
  /// Takes the times of a message whose pairs are `nearest_`; false when it repeats the one before.
  bool isNewAnswer(ros::Time stamp, ros::Time receipt);

  std::string name_;
  Figures figures_;
  std::vector<const PairDistance*> nearest_;    ///< of the message at hand
  std::map<std::string, std::uint64_t> waits_;  ///< of each pair, messages since its last complete list
  bool seen_ = false;
  ros::Time last_receipt_;
  ros::Time last_stamp_;
  std::map<ros::Time, ros::Time> received_;  ///< stamp of transforms to when they came here
  ros::Subscriber transforms_;
  ros::Subscriber messages_;
  ros::Subscriber diagnostics_;
};

/// Prints the figures, one a line; how to read them stands in node_timing.cpp.
/// @param seconds of wall time measured
/// @param process_seconds processor time of the node's process meanwhile
void print(const Figures& figures, double rate, double seconds, double process_seconds, const BareTimer& bare,
           const MachineSeconds& machine);

}  // namespace concave_distance
