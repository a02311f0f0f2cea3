#pragma once

#include <ros/node_handle.h>

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include "scene_loader.h"

namespace concave_distance {

/// Notices that a robot's description on the parameter server is not the one that was loaded. Thread-safe.
class DescriptionWatch {
 public:
  explicit DescriptionWatch(const ros::NodeHandle& node) : node_(node) {}

  /// The scene of these descriptions is served.
  void remember(const SceneRequest& request);
  /// Compares them with what the master has sent: it sends a parameter when that changes, and is not asked
  /// again. @return the name of a parameter whose change was not reported yet; empty: none
  std::string findNews();
  /// Returns the parameter that findNews() found to differ last; empty: none does.
  std::string changed();

 private:
  ros::NodeHandle node_;
  std::mutex mutex_;
  std::map<std::string, std::size_t> loaded_;    ///< hashes by parameter
  std::map<std::string, std::size_t> reported_;  ///< of those that differ
};

}  // namespace concave_distance
