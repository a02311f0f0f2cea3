#pragma once

#include <concave_distance/RecordPair.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <mutex>
#include <string>

#include "node_limits.h"
#include "ros/topics/scene_store.h"
#include "scene/pair_recorder.h"
#include "service_queues.h"

namespace concave_distance {

/// The service record_pair. It passes the gate for long requests, one at a time, on one thread.
class RecordService {
 public:
  /// @param save_folder below which recordings may be written; empty: nowhere
  RecordService(ServiceQueues& queues, SceneStore& keeper, PairRecorder& recorder, std::string save_folder,
                const NodeLimits& limits);

 private:
  bool recordPair(RecordPair::Request& request, RecordPair::Response& response);
  void write(const RecordPair::Request& request, WorkLimit::Clock::time_point end,
             RecordPair::Response& response);
  PairRecording takeCycles(const RecordPair::Request& request) const;

  ros::NodeHandle heavy_;
  RequestGate& gate_;
  SceneStore& keeper_;
  PairRecorder& recorder_;
  std::string save_folder_;
  double limit_seconds_;
  std::mutex running_;  ///< held by the recording that is being written
  ros::ServiceServer record_pair_;
};

}  // namespace concave_distance
