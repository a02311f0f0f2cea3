#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace concave_distance {

/// Says what of which bags is played.
struct BagSelection {
  std::vector<std::string> paths;  ///< played as one, as `rosbag play` does
  std::vector<std::string> moving_topics = {"/tf"};
  std::vector<std::string> fixed_topics = {"/tf_static"};
  bool are_topics_given = false;   ///< each of them has to be in a bag then
  double start = 0.0;              ///< s after the begin of the bags
  std::optional<double> duration;  ///< s from there; empty: to the end
};

/// One message of tf.
struct BagMessage {
  ros::Time time;  ///< of its recording; the begin, when it is static and was recorded before
  bool fixed = false;
  std::string sender;
  std::vector<geometry_msgs::TransformStamped> transforms;
  std::string problem;  ///< why it cannot be read; empty: it was
};

/// Reads the messages of tf from bags, in the order of their recording. What is static and was recorded
/// before the start comes first, as `rosbag play` publishes it. The bags are read by a process of their own,
/// which a damaged one may end. The constructor forks: no other thread may run.
class BagTransforms {
 public:
  /// @throws Error for a bag that cannot be read, has no index or none of the topics, for a topic of another
  ///         type, and for a start behind the end
  explicit BagTransforms(const BagSelection& selection);
  ~BagTransforms();
  BagTransforms(const BagTransforms&) = delete;
  BagTransforms& operator=(const BagTransforms&) = delete;

  /// Returns false at the end. @throws Error when the bag is damaged there
  bool next(BagMessage& message);

  ros::Time begin() const;  ///< of what is played
  ros::Time end() const;

 private:
  struct Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace concave_distance
