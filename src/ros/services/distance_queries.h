#pragma once

#include <concave_distance/DistanceQuery.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <concave_distance/PairContactState.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "node_limits.h"
#include "ros/tf/transform_buffer.h"
#include "ros/topics/scene_store.h"
#include "service_queues.h"

namespace concave_distance {

/// Holds what a query is answered with besides the scene.
struct QueryContext {
  const TransformBuffer* transforms = nullptr;
  std::string reference_frame;
  double transform_timeout = 0.2;  ///< s
  double stale_after = 1.0;        ///< s
  /// All queries of a call end at this time: running ones stop with the bound they have.
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  const std::atomic<bool>* stop = nullptr;                      ///< set: running queries end, no other begins
  std::size_t memory_limit = TrackerParameters().memory_limit;  ///< bytes, of one query's solve
  std::size_t answer_limit = TrackerParameters().memory_limit;  ///< bytes, of the niches and contacts of one
                                                                ///< answer, while it is kept and sent
};

/// The answer to one query.
struct QueryAnswer {
  PairNiches result;
  PairContactState contacts;  ///< empty unless asked for
};

/// Answers one query by a solve of its own: nothing that is tracked is read or changed. Never throws: what
/// cannot be answered has a status that says why.
QueryAnswer answerQuery(const DistanceQuery& query, const Scene& scene, const QueryContext& context,
                        ros::Time now) noexcept;

/// True when the answer carries a distance.
bool isAnswered(const PairNiches& answer);

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
