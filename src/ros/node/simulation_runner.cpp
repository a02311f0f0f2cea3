#include "simulation_runner.h"

#include <ros/console.h>
#include <ros/init.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <utility>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "parameter_reader.h"
#include "ros/callback_guard.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kProgressSeconds = 2.0;
// The clock begins here and not at 0, which ROS takes for "no time yet".
constexpr double kFirstStamp = 1.0;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

const ParameterTable<SimulationNodeParameters>& simulationNodeParameters() {
  using P = SimulationNodeParameters;
  const std::vector<std::pair<std::string, SimulationEnd>> ends = {
      {"hold", SimulationEnd::Hold}, {"loop", SimulationEnd::Loop}, {"exit", SimulationEnd::Exit}};
  static const ParameterTable<P> table = {
      text<P>(
          "scene_file", "a path", [](auto& p) -> auto& { return p.scene_file; },
          "scene YAML with a section `simulation` ([scene_file](scene_file.md#simulation))"),
      text<P>(
          "robot_description", "a name", [](auto& p) -> auto& { return p.robot_description; },
          "as the distance node's"),
      text<P>(
          "world_frame", "a tf frame", [](auto& p) -> auto& { return p.world_frame; },
          "tf frame of the simulation's world"),
      number<P>(
          "rate", [](auto& p) -> auto& { return p.rate; }, "publications a second of simulated time")
          .from(0.1)
          .to(10000.0),
      number<P>(
          "speed", [](auto& p) -> auto& { return p.speed; },
          "simulated over real seconds; 0: as fast as it can")
          .to(1000.0),
      number<P>(
          "start_delay", [](auto& p) -> auto& { return p.start_delay; },
          "real time of standing still at the start")
          .inUnit("s")
          .to(3600.0),
      flag<P>(
          "publish_clock", [](auto& p) -> auto& { return p.publish_clock; }, "publish `/clock`"),
      choice<P>(
          "at_end", ends, [](auto& p) -> auto& { return p.at_end; }, "what happens at the end"),
  };
  return table;
}

SimulationNodeParameters parseSimulationParameters(const XmlRpc::XmlRpcValue& values) {
  ParameterReader reader(values, "~");
  SimulationNodeParameters p;
  reader.read(simulationNodeParameters(), false, p);
  if (p.scene_file.empty()) {
    throw Error("~scene_file", "it is empty", "name a scene file with a section `simulation`");
  }
  p.world_frame = requireFrameName(p.world_frame, "~world_frame");
  const std::vector<std::string> unknown = reader.unread({});
  if (!unknown.empty()) {
    throw Error("~" + unknown.front(), "there is no such parameter",
                "see doc/simulation_node.md for those there are");
  }
  return p;
}

void fillSimulationState(const Simulation& simulation, const std::string& world_frame, ros::Time stamp,
                         double real_seconds, SimulationState& message) {
  message.header.frame_id = world_frame;
  message.header.stamp = stamp;
  message.time = simulation.time();
  message.duration = simulation.settings().duration;
  message.real_time_factor = real_seconds > 0.0 ? simulation.time() / real_seconds : 0.0;
  message.diverged = simulation.status() == SimulationStatus::Diverged;
  const std::vector<SimulatedBody>& bodies = simulation.bodies();
  message.bodies.resize(bodies.size());
  message.poses.resize(bodies.size());
  message.twists.resize(bodies.size());
  message.contact_wrenches.resize(bodies.size());
  message.drive_wrenches.resize(bodies.size());
  message.load_wrenches.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    message.bodies[i] = bodies[i].name;
    message.poses[i] = tf2::toMsg(bodies[i].world_from_body);
    message.twists[i].linear = toVector(bodies[i].velocity);
    message.twists[i].angular = toVector(bodies[i].angular_velocity);
    message.contact_wrenches[i] = toWrench(bodies[i].contact_wrench);
    message.drive_wrenches[i] = toWrench(bodies[i].drive_wrench);
    message.load_wrenches[i] = toWrench(bodies[i].load_wrench);
  }
  const std::vector<SimulatedPair>& pairs = simulation.pairs();
  message.pairs.resize(pairs.size());
  message.lower_bounds.resize(pairs.size());
  message.depths.resize(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    message.pairs[i] = pairs[i].name;
    message.lower_bounds[i] = pairs[i].lower_bound;
    message.depths[i] = 0.0;
    for (const ContactRegion& region : pairs[i].contacts.regions) {
      message.depths[i] = std::max(message.depths[i], region.overlap.depth);
    }
  }
  const EnergyAccount& energy = simulation.energy();
  message.kinetic_energy = energy.kinetic;
  message.gravity_potential = energy.gravity_potential;
  message.drive_potential = energy.drive_potential;
  message.energy_balance_error = energy.balanceError();
  message.steps = simulation.counters().steps;
}

SimulationRunner::SimulationRunner(ros::NodeHandle node, ros::NodeHandle private_node, Scene scene,
                                   SimulationNodeParameters parameters)
    : scene_(std::move(scene)), parameters_(std::move(parameters)) {
  zero_ = ros::Time(kFirstStamp);
  restart();
  for (const std::string& warning : simulation_->warnings()) ROS_WARN_STREAM(warning);
  state_publisher_ = private_node.advertise<SimulationState>("state", 10);
  if (parameters_.publish_clock) clock_publisher_ = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  restart_service_ = private_node.advertiseService("restart", &SimulationRunner::onRestart, this);
  pause_service_ = private_node.advertiseService("pause", &SimulationRunner::onPause, this);
  const double period = parameters_.speed > 0.0 ? 1.0 / (parameters_.rate * parameters_.speed) : 1e-4;
  timer_ = node.createSteadyTimer(ros::WallDuration(period), &SimulationRunner::onTimer, this);
}

void SimulationRunner::restart() {
  simulation_ = std::make_unique<Simulation>(scene_);
  held_ = real_seconds_ = 0.0;
  started_ = shown_ = Clock::now();
}

void SimulationRunner::onTimer(const ros::SteadyTimerEvent&) {
  guarded("A step of the simulation", [this] { step(); });
}

void SimulationRunner::step() {
  if (!paused_ && secondsSince(started_) >= parameters_.start_delay) {
    if (simulation_->time() < simulation_->settings().duration &&
        simulation_->status() == SimulationStatus::Ok) {
      advance();
    } else {
      finish();
    }
  }
  publish();
}

void SimulationRunner::advance() {
  const Clock::time_point start = Clock::now();
  const double until = simulation_->time() + 1.0 / parameters_.rate;
  simulation_->advanceTo(std::min(until, simulation_->settings().duration));
  real_seconds_ += secondsSince(start);
  const bool over = simulation_->time() >= simulation_->settings().duration;
  if (over || secondsSince(shown_) >= kProgressSeconds) showProgress();
  if (simulation_->status() == SimulationStatus::Diverged) {
    ROS_ERROR(
        "the simulation has diverged at %.6f s and stands still (make step_fraction smaller, or contacts "
        "softer)",
        simulation_->time());
  }
}

void SimulationRunner::finish() {
  switch (parameters_.at_end) {
    case SimulationEnd::Hold:
      held_ += 1.0 / parameters_.rate;
      break;
    case SimulationEnd::Loop:
      // Time goes on: a clock that jumps back would cost the listeners their buffers.
      zero_ += ros::Duration(simulation_->time() + held_ + 1.0 / parameters_.rate);
      restart();
      break;
    case SimulationEnd::Exit:
      ros::requestShutdown();
      break;
  }
}

void SimulationRunner::publish() {
  const ros::Time stamp =
      parameters_.publish_clock ? zero_ + ros::Duration(simulation_->time() + held_) : ros::Time::now();
  if (parameters_.publish_clock) {
    rosgraph_msgs::Clock clock;
    clock.clock = stamp;
    clock_publisher_.publish(clock);
  }
  const std::vector<SimulatedBody>& bodies = simulation_->bodies();
  transforms_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    transforms_[i] = tf2::eigenToTransform(bodies[i].world_from_body);
    transforms_[i].header.stamp = stamp;
    transforms_[i].header.frame_id = parameters_.world_frame;
    transforms_[i].child_frame_id = scene_.bodies[i].frame;
  }
  // Nothing new while it stands still: listeners complain of transforms that come twice.
  if (stamp != last_stamp_) broadcaster_.sendTransform(transforms_);
  last_stamp_ = stamp;
  if (state_publisher_.getNumSubscribers() == 0) return;
  fillSimulationState(*simulation_, parameters_.world_frame, stamp, real_seconds_, state_);
  state_.paused = paused_;
  state_publisher_.publish(state_);
}

void SimulationRunner::showProgress() {
  shown_ = Clock::now();
  ROS_INFO(
      "t = %.3f of %.3f s, real-time factor %.3f, %llu steps, energy balance %.2g J", simulation_->time(),
      simulation_->settings().duration, real_seconds_ > 0.0 ? simulation_->time() / real_seconds_ : 0.0,
      static_cast<unsigned long long>(simulation_->counters().steps), simulation_->energy().balanceError());
}

bool SimulationRunner::onRestart(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  zero_ += ros::Duration(simulation_->time() + held_ + 1.0 / parameters_.rate);
  restart();
  response.success = 1;
  response.message = "the simulation begins anew; the clock goes on";
  return true;
}

bool SimulationRunner::onPause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  paused_ = request.data != 0;
  response.success = 1;
  response.message = paused_ ? "paused" : "running";
  return true;
}

}  // namespace concave_distance
