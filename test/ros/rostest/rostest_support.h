#pragma once

#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/service.h>
#include <ros/subscriber.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace concave_distance {

/// Seconds of wall time that a test waits for what must happen; far more than it takes.
inline constexpr double kDeadline = 15.0;

/// Looks every 5 ms until the condition holds. False when it did not within the deadline.
inline bool eventually(const std::function<bool()>& condition, double deadline = kDeadline) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(deadline);
  while (ros::ok() && ros::WallTime::now() < end) {
    if (condition()) {
      return true;
    }
    ros::WallDuration(0.005).sleep();
  }
  return condition();
}

/// Subscribes while it lives and keeps what comes. Thread-safe; needs a spinner in another thread.
template <typename Message>
class Collector {
 public:
  explicit Collector(const std::string& topic)
      : subscriber_(node_.subscribe<Message>(topic, 1000, [this](const typename Message::ConstPtr& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          messages_.push_back(*message);
        })) {}

  std::size_t count() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }
  std::vector<Message> all() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  std::optional<Message> last() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.empty() ? std::nullopt : std::optional<Message>(messages_.back());
  }
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.clear();
  }
  /// Waits for a message that satisfies the condition, among all that have come since clear() and those to
  /// come; the first one.
  std::optional<Message> match(const std::function<bool(const Message&)>& condition,
                               double deadline = kDeadline) {
    std::optional<Message> found;
    std::size_t seen = 0;
    eventually(
        [&] {
          const std::lock_guard<std::mutex> lock(mutex_);
          for (; !found && seen < messages_.size(); ++seen) {
            if (condition(messages_[seen])) found = messages_[seen];
          }
          return found.has_value();
        },
        deadline);
    return found;
  }
  /// Waits for a message that satisfies the condition, among those to come and the last one.
  bool waitFor(const std::function<bool(const Message&)>& condition, double deadline = kDeadline) {
    return eventually(
        [&] {
          const std::optional<Message> message = last();
          return message && condition(*message);
        },
        deadline);
  }

 private:
  ros::NodeHandle node_;
  std::mutex mutex_;
  std::vector<Message> messages_;
  ros::Subscriber subscriber_;
};

/// Calls a service that must exist and must answer, be it with a refusal. Under load roscpp loses one call in
/// some thousands (doc/services.md): such a call is repeated once.
template <typename Service>
typename Service::Response call(const std::string& name, const typename Service::Request& request) {
  Service service;
  service.request = request;
  EXPECT_TRUE(ros::service::waitForService(name, ros::Duration(kDeadline))) << name;
  EXPECT_TRUE(ros::service::call(name, service) || ros::service::call(name, service)) << name;
  return service.response;
}

}  // namespace concave_distance
