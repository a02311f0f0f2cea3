#pragma once

#include <concave_distance/DistanceQuery.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <concave_distance/PairContactState.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <tbb/task_arena.h>
#include <tf2/buffer_core.h>

#include <string>

#include "concave_distance/ros/scene_keeper.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// What a query is answered with besides the scene.
struct QueryContext {
  const tf2::BufferCore* buffer = nullptr;
  std::string reference_frame;
  double transform_timeout = 0.2;  ///< s
  double stale_after = 1.0;        ///< s
  PairSettings defaults;           ///< for bodies that are no pair of the scene
};

/// The answer to one query.
struct QueryAnswer {
  PairNiches result;
  PairContactState contacts;  ///< empty unless asked for
};

/// Answers one query by a solve of its own: nothing that is tracked is read or changed. Never throws: what
/// cannot be answered has a status that says why.
QueryAnswer answerQuery(const DistanceQuery& query, const Scene& scene, const QueryContext& context,
                        ros::Time now);

/// True when the answer carries a distance.
bool isAnswered(const PairNiches& answer);

/// The services get_distance and get_distances.
class DistanceQueries {
 public:
  DistanceQueries(const ros::NodeHandle& node, SceneKeeper& keeper, QueryContext context,
                  std::uint32_t threads);

 private:
  bool getDistance(GetDistance::Request& request, GetDistance::Response& response);
  bool getDistances(GetDistances::Request& request, GetDistances::Response& response);
  QueryContext currentContext();

  ros::NodeHandle node_;
  SceneKeeper& keeper_;
  QueryContext context_;
  tbb::task_arena arena_;
  ros::ServiceServer get_distance_;
  ros::ServiceServer get_distances_;
};

}  // namespace concave_distance
