#pragma once

#include <concave_distance/CancelClearance.h>
#include <concave_distance/GetClearance.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "answer_query.h"
#include "concave_distance/kinematics/clearance.h"
#include "node_limits.h"
#include "ros/topics/scene_store.h"
#include "service_queues.h"

namespace concave_distance {

/// The services get_clearance and cancel_clearance and the topic clearance_progress. One request runs at a
/// time, on its own thread, behind the gate for motions; the queries of other services have theirs.
class ClearanceService {
 public:
  /// @param context tf and the reference frame; its other fields are not read
  ClearanceService(ServiceQueues& queues, SceneStore& keeper, const QueryContext& context,
                   const NodeLimits& limits);

 private:
  using StopFlag = std::shared_ptr<std::atomic<bool>>;

  bool getClearance(GetClearance::Request& request, GetClearance::Response& response);
  bool cancel(CancelClearance::Request& request, CancelClearance::Response& response);
  void answer(const GetClearance::Request& request, const std::atomic<bool>& stop,
              GetClearance::Response& response);
  ClearanceResult find(const GetClearance::Request& request, const ServedScene& served,
                       const ClearanceParameters& parameters, std::vector<std::string>& remarks) const;
  SceneState stateNow(const GetClearance::Request& request, const ServedScene& served,
                      const SceneKinematics& joints) const;
  Eigen::Isometry3d requireFrame(const std::string& frame, const std::string& where) const;
  StopFlag begin(const std::string& id);
  void end(const std::string& id);

  ros::NodeHandle heavy_;
  RequestGate& gate_;
  SceneStore& keeper_;
  QueryContext context_;
  NodeLimits limits_;
  std::mutex mutex_;
  std::multimap<std::string, StopFlag> running_;  ///< waiting ones too, by id
  ros::Publisher progress_;
  ros::ServiceServer get_clearance_;
  ros::ServiceServer cancel_clearance_;
};

}  // namespace concave_distance
