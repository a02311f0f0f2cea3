#pragma once

#include <concave_distance/DistanceQuery.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "answer_query.h"
#include "node_limits.h"
#include "ros/topics/scene_store.h"
#include "service_queues.h"

namespace concave_distance {

/// The services get_distance and get_distances, on the queue and behind the gate for long requests.
class DistanceQueries {
 public:
  /// @param threads number of threads for the queries of one call
  DistanceQueries(ServiceQueues& queues, SceneStore& keeper, QueryContext context, const NodeLimits& limits,
                  std::uint32_t threads);

 private:
  bool getDistance(GetDistance::Request& request, GetDistance::Response& response);
  bool getDistances(GetDistances::Request& request, GetDistances::Response& response);
  void answerOne(const DistanceQuery& query, const QueryContext& context, GetDistance::Response& response);
  void answerAll(const std::vector<DistanceQuery>& queries, const QueryContext& context,
                 GetDistances::Response& response);
  /// @param arrival when the call arrived; its time counts from then
  /// @param queries in the call, whose answers share the memory
  QueryContext currentContext(std::chrono::steady_clock::time_point arrival, std::size_t queries);

  ros::NodeHandle node_;
  RequestGate& gate_;
  SceneStore& keeper_;
  QueryContext context_;
  NodeLimits limits_;
  std::size_t threads_;
  ros::ServiceServer get_distance_;
  ros::ServiceServer get_distances_;
};

}  // namespace concave_distance
