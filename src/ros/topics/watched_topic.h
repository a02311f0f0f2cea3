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

  /// @param on_subscribe called, from the node handle's queue, for every new subscriber
  template <typename Message>
  static WatchedTopic advertise(const ros::NodeHandle& node, const std::string& name,
                                std::uint32_t queue_length, const std::function<void()>& on_subscribe = {}) {
    // A node handle keeps 300 bytes of every publisher that it ever made.
    ros::NodeHandle own_node(node);
    WatchedTopic topic;
    topic.subscribers_ = std::make_shared<std::atomic<int>>(0);
    topic.publisher_ = own_node.advertise<Message>(
        name, queue_length,
        [count = topic.subscribers_, on_subscribe](const ros::SingleSubscriberPublisher&) {
          ++*count;
          if (on_subscribe) {
            on_subscribe();
          }
        },
        [count = topic.subscribers_](const ros::SingleSubscriberPublisher&) { --*count; });
    return topic;
  }

  explicit operator bool() const { return subscribers_ != nullptr; }
  bool isWatched() const { return subscribers_ && *subscribers_ > 0; }

  template <typename MessagePointer>
  void publish(const MessagePointer& message) const {
    publisher_.publish(message);
  }

 private:
  ros::Publisher publisher_;
  std::shared_ptr<std::atomic<int>> subscribers_;
};

}  // namespace concave_distance
