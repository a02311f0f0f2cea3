#pragma once

#include <concave_distance/SimulationState.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/steady_timer.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <chrono>
#include <memory>
#include <string>

#include "base/parameter.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/simulation/simulation.h"

namespace concave_distance {

/// Says what the simulation does when its duration is over.
enum class SimulationEnd : std::uint8_t { Hold, Loop, Exit };

/// Every private parameter of the simulation node, validated (doc/simulation_node.md). SI units.
struct SimulationNodeParameters {
  std::string scene_file;
  std::string robot_description = "robot_description";
  std::string world_frame = "world";
  double rate = 100.0;        ///< publications a second of simulated time
  double speed = 1.0;         ///< simulated over real seconds; 0: as fast as it can
  double start_delay = 0.0;   ///< real seconds of standing still at the begin
  bool publish_clock = true;  ///< /clock
  SimulationEnd at_end = SimulationEnd::Hold;
};

/// The simulation node's parameters, declared once.
const ParameterTable<SimulationNodeParameters>& simulationNodeParameters();
/// @throws Error naming the parameter, the value seen and what is allowed
SimulationNodeParameters parseSimulationParameters(const XmlRpc::XmlRpcValue& values);

/// The message of a simulation as it is now.
/// @param stamp simulated time since the clock's zero @param real_seconds that the simulation took so far
void fillSimulationState(const Simulation& simulation, const std::string& world_frame, ros::Time stamp,
                         double real_seconds, SimulationState& message);

/// Runs a simulation in steps of the publishing rate, paced by real time, and publishes tf, the state and the
/// clock after each. One thread.
class SimulationRunner {
 public:
  /// @throws Error for a scene that cannot be simulated
  SimulationRunner(ros::NodeHandle node, ros::NodeHandle private_node, Scene scene,
                   SimulationNodeParameters parameters);

 private:
  void step();
  void onTimer(const ros::SteadyTimerEvent& event);
  void restart();
  void advance();
  void finish();
  void publish();
  void showProgress();
  bool onRestart(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  Scene scene_;
  SimulationNodeParameters parameters_;
  std::unique_ptr<Simulation> simulation_;
  SimulationState state_;
  tf2_ros::TransformBroadcaster broadcaster_;
  std::vector<geometry_msgs::TransformStamped> transforms_;
  ros::Publisher state_publisher_;
  ros::Publisher clock_publisher_;
  ros::ServiceServer restart_service_;
  ros::ServiceServer pause_service_;
  ros::SteadyTimer timer_;
  ros::Time zero_;             ///< the clock at the simulation's begin
  ros::Time last_stamp_;       ///< of the last transforms
  double held_ = 0.0;          ///< simulated seconds past the end
  double real_seconds_ = 0.0;  ///< spent in simulating
  bool paused_ = false;
  std::chrono::steady_clock::time_point started_;
  std::chrono::steady_clock::time_point shown_;
};

}  // namespace concave_distance
