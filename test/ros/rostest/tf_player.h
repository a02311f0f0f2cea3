#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <atomic>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace concave_distance {

/// Broadcasts transforms from `world`, all of one stamp, until it is destroyed: 100 times a second of wall
/// time, stamped with ROS time. Thread-safe.
class TfPlayer {
 public:
  TfPlayer();
  ~TfPlayer();
  TfPlayer(const TfPlayer&) = delete;
  TfPlayer& operator=(const TfPlayer&) = delete;

  /// Puts `frame` at (x, y, z), turned by `angle` about z.
  void place(const std::string& frame, double x, double y = 0.0, double z = 0.0, double angle = 0.0);
  /// From now on `frame` glides from (from, 0, 0) to (to, 0, 0) and stays there. Where it is follows from the
  /// stamp alone: however seldom it is broadcast, its speed is (to - from) / seconds.
  void glide(const std::string& frame, double from, double to, double seconds);
  /// From now on `frame` is not broadcast any more.
  void drop(const std::string& frame);

 private:
  struct Glide {
    double from;
    double to;
    double seconds;
    ros::Time start;
  };
  void play();

  tf2_ros::TransformBroadcaster broadcaster_;
  std::mutex mutex_;
  std::map<std::string, geometry_msgs::TransformStamped> transforms_;
  std::map<std::string, Glide> glides_;
  std::atomic<bool> running_{true};
  std::thread thread_;
};

}  // namespace concave_distance
