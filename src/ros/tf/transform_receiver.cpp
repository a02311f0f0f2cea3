#include "transform_receiver.h"

#include <ros/console.h>

#include <utility>

#include "ros/callback_guard.h"

namespace concave_distance {
namespace {

constexpr std::uint32_t kTransformQueueLength = 100;  // messages, as in tf2_ros

}  // namespace

TransformReceiver::TransformReceiver(const ros::NodeHandle& node, TransformBuffer& buffer)
    : buffer_(buffer), node_(node), spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  const auto subscribe = [this](const std::string& topic, bool fixed) {
    const boost::function<void(const Event&)> callback = [this, fixed](const Event& event) {
      guarded("receiving transforms", [&] { receive(event, fixed); });
    };
    return node_.subscribe<tf2_msgs::TFMessage>(topic, kTransformQueueLength, callback);
  };
  moving_ = subscribe("/tf", false);
  fixed_ = subscribe("/tf_static", true);
  spinner_.start();
}

TransformReceiver::~TransformReceiver() {
  moving_.shutdown();
  fixed_.shutdown();
  spinner_.stop();
}

void TransformReceiver::receive(const Event& event, bool fixed) {
  const std::string& sender = event.getPublisherName();
  for (const geometry_msgs::TransformStamped& transform : event.getConstMessage()->transforms) {
    if (const auto problem = buffer_.insert(transform, sender, fixed)) {
      note(transform, sender, *problem);
    } else {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++report_.taken;
    }
  }
}

void TransformReceiver::note(const geometry_msgs::TransformStamped& transform, const std::string& sender,
                             const TransformProblem& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++report_.refused;
  ++report_.refused_in_all;
  report_.last_refusal = "the transform of frame '" + printable(transform.child_frame_id) + "' in '" +
                         printable(transform.header.frame_id) + "' from " + sender +
                         " is refused: " + problem.what + " (" + problem.remedy + ")";
  last_sender_ = sender;
  ++unlogged_;
  logRefusals();
}

// The caller holds the mutex.
void TransformReceiver::logRefusals() {
  if (unlogged_ == 0 || !throttle_.isDue(last_sender_)) return;
  const std::uint64_t others = std::exchange(unlogged_, 0) - 1;
  ROS_WARN_STREAM(report_.last_refusal
                  << (others > 0 ? "; " + std::to_string(others) + " others were refused before" : ""));
}

TransformReport TransformReceiver::take() {
  TransformReport report;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    logRefusals();
    report = report_;
    report_.taken = report_.refused = 0;
  }
  report.frames = buffer_.frameCount();
  return report;
}

}  // namespace concave_distance
