#include "tf_player.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace concave_distance {

TfPlayer::TfPlayer() : thread_([this] { play(); }) {}

TfPlayer::~TfPlayer() {
  running_ = false;
  thread_.join();
}

void TfPlayer::place(const std::string& frame, double x, double y, double z, double angle) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "world";
  transform.child_frame_id = frame;
  transform.transform.translation.x = x;
  transform.transform.translation.y = y;
  transform.transform.translation.z = z;
  transform.transform.rotation.z = std::sin(angle / 2.0);
  transform.transform.rotation.w = std::cos(angle / 2.0);
  const std::lock_guard<std::mutex> lock(mutex_);
  transforms_[frame] = transform;
  glides_.erase(frame);
}

void TfPlayer::glide(const std::string& frame, double from, double to, double seconds) {
  place(frame, from);
  const std::lock_guard<std::mutex> lock(mutex_);
  glides_[frame] = {from, to, seconds, ros::Time::now()};
}

void TfPlayer::drop(const std::string& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  transforms_.erase(frame);
}

void TfPlayer::play() {
  ros::Time last;
  while (running_) {
    ros::WallDuration(0.01).sleep();
    const ros::Time now = ros::Time::now();
    std::vector<geometry_msgs::TransformStamped> transforms;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto& [frame, transform] : transforms_) {
        transform.header.stamp = now;
        if (const auto glide = glides_.find(frame); glide != glides_.end()) {
          const Glide& path = glide->second;
          const double share = std::clamp((now - path.start).toSec() / path.seconds, 0.0, 1.0);
          transform.transform.translation.x = path.from + share * (path.to - path.from);
        }
        transforms.push_back(transform);
      }
    }
    if (!transforms.empty() && now != last && !now.isZero()) {
      broadcaster_.sendTransform(transforms);
    }
    last = now;
  }
}

}  // namespace concave_distance
