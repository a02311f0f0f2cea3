#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace concave_distance {

/// Messages of a topic that wait for a slow subscriber.
inline constexpr std::uint32_t kQueueLength = 10;

/// A publisher that knows without a search whether anybody listens: roscpp's getNumSubscribers() looks
/// through all topics of the node, too long for two topics a pair in every cycle. Copies share the topic.
class WatchedTopic {
 public:
  WatchedTopic() = default;

  template <typename Message>
  static WatchedTopic advertise(const ros::NodeHandle& node, const std::string& name,
                                std::uint32_t queue_length) {
    // A node handle keeps 300 bytes of every publisher that it ever made.
    ros::NodeHandle own_node(node);
    WatchedTopic topic;
    topic.subscribers_ = std::make_shared<Subscribers>();
    topic.publisher_ = own_node.advertise<Message>(
        name, queue_length,
        [subscribers = topic.subscribers_](const ros::SingleSubscriberPublisher&) {
          ++subscribers->count;
          subscribers->has_new = true;
        },
        [subscribers = topic.subscribers_](const ros::SingleSubscriberPublisher&) { --subscribers->count; });
    return topic;
  }

  explicit operator bool() const { return subscribers_ != nullptr; }
  bool isWatched() const { return subscribers_ && subscribers_->count > 0; }
  /// Returns whether somebody has subscribed since the last call.
  bool takeNew() const { return subscribers_->has_new.exchange(false); }

  template <typename MessagePointer>
  void publish(const MessagePointer& message) const {
    publisher_.publish(message);
  }

 private:
  struct Subscribers {
    std::atomic<int> count{0};
    std::atomic<bool> has_new{false};
  };
  ros::Publisher publisher_;
  std::shared_ptr<Subscribers> subscribers_;
};

}  // namespace concave_distance
