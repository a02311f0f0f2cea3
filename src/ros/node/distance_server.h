#pragma once

#include <concave_distance/ConcaveDistanceConfig.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include <atomic>
#include <boost/thread/recursive_mutex.hpp>
#include <functional>
#include <memory>
#include <string>

#include "body_publisher.h"
#include "concave_distance/base/error.h"
#include "cycle_runner.h"
#include "description_watch.h"
#include "node_parameters.h"
#include "ros/clouds/cloud_receivers.h"
#include "ros/services/clearance_service.h"
#include "ros/services/distance_queries.h"
#include "ros/services/move_receiver.h"
#include "ros/services/operation_services.h"
#include "ros/services/scene_services.h"
#include "ros/services/state_services.h"
#include "ros/tf/transform_buffer.h"
#include "ros/tf/transform_receiver.h"
#include "ros/topics/scene_store.h"
#include "ros/topics/topic_publishers.h"
#include "scene/lateness_monitor.h"
#include "scene/restart_requests.h"
#include "scene_loader.h"

namespace concave_distance {

/// All of the node, shared by the program and the nodelet: reads parameters, loads the scene as soon as it
/// can be, and wires cycle, services, diagnostics and reconfiguration. Nothing in it waits.
class DistanceServer {
 public:
  using FatalCallback = std::function<void(const Error&)>;

  /// @param node for /tf and /diagnostics; its queue serves timers and subscribers, not the services
  /// @param private_node for parameters, topics and services
  /// @param name of the node or nodelet, for the diagnostics
  /// @param on_fatal called from a callback of `private_node` when the scene file is wrong, so that nothing
  ///        can be served
  /// @throws Error for a wrong parameter
  DistanceServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node, std::string name,
                 FatalCallback on_fatal);
  /// Ends the running requests of services.
  ~DistanceServer();
  DistanceServer(const DistanceServer&) = delete;
  DistanceServer& operator=(const DistanceServer&) = delete;

 private:
  void tryToLoad();
  void followLoading();
  void giveUpLoading(const Error& problem);
  /// The cutoff scaled to a robot, for pairs added later and for reconfiguration.
  void adoptCutoff(double cutoff);
  void forgetAutomaticCutoff();
  void reportLateness();
  void doHousekeeping();
  void publishDiagnostics();
  void onReconfigure(ConcaveDistanceConfig& config, std::uint32_t level);
  void reportMissingFrames();
  void reportChangedDescription();
  /// Loads the scene again, for the service reload.
  Scene loadAgain(const std::shared_ptr<BodyPool>& pool);
  void onReloaded(const Scene& loaded);
  void reportMissingClock();
  void setUpDiagnostics();
  /// A wall timer; exceptions in its callback are logged and end there.
  ros::WallTimer startTimer(double period, const char* name, void (DistanceServer::*act)());

  ros::NodeHandle private_node_;
  NodeParameters parameters_;
  bool cutoff_is_automatic_;  ///< nobody has set one
  FatalCallback on_fatal_;
  TransformBuffer transforms_;
  TransformReceiver receiver_;
  TopicPublishers publishers_;
  SceneStore keeper_;
  RestartRequests restarts_;
  ServiceQueues service_queues_;
  DistanceQueries queries_;
  ClearanceService clearances_;
  SceneServices scene_services_;
  OperationServices operation_services_;
  DescriptionWatch descriptions_;
  SceneRequest reload_request_;  ///< of the reload that runs, or the last
  StateServices state_services_;
  MoveReceiver moves_;
  CloudReceivers clouds_;
  CycleRunner runner_;
  diagnostic_updater::Updater updater_;
  CycleWindow window_;  ///< of the diagnostics being published

  boost::recursive_mutex reconfigure_mutex_;
  ConcaveDistanceConfig config_;
  std::atomic<bool> settings_were_written_{false};  ///< by the reconfigure server
  ConcaveDistanceConfig config_of_loading_;         ///< what the scene that is loading was given
  std::unique_ptr<dynamic_reconfigure::Server<ConcaveDistanceConfig>> reconfigure_;

  BodyPublisher body_publisher_;
  SceneLoader loader_;  ///< used by load_timer_ alone
  ros::WallTimer load_timer_;
  ros::WallTimer housekeeping_timer_;
  ros::WallTimer diagnostics_timer_;
  ros::WallTimer description_timer_;
  ros::WallTime last_load_message_;
  ros::WallTime last_frame_message_;
  ros::WallTime last_clock_message_ = ros::WallTime::now();
  LatenessMonitor lateness_;
};

}  // namespace concave_distance
