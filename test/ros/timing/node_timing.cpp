// How a running node keeps time: late cycles, processor time, latency from transforms to messages.
//
//   rosrun concave_distance node_timing [_node:=/concave_distance] [_seconds:=60] [_topic:=niches]
//   [_cutoff:=-1] [_markers:=false]
//
// _topic is `niches` or `distances`; with _markers it subscribes to `markers` too, as rviz does; a _cutoff
// that is not negative (m) is first set for every pair. Subscribes to that topic and to the diagnostics,
// warms up, listens for that many seconds and prints figures, one a line. scripts/measure.sh node starts it
// beside the demo scenes. How to read them:
//   cycles         the node's own count from its diagnostics; late: ended after the next one was due
//   messages       on the topic, counted here: what a subscriber got; the largest gap between two of them
//   solved         pairs a cycle; repeated: answers that stand because no newer transforms had come
//   bare timer     the same count of a thread that only sleeps: what the machine alone makes late; of all
//                  cores' time: idle, and stolen by the machine below a virtual one
//   thread CPU     of the cycle's thread and its helpers, a cycle, and as a share of the period
//   process CPU    of the whole node (tf, sockets, services too), as a share of one core
//   lists          of niches, of all pairs in all messages, and the longest wait of a pair for a complete one
//   warm, cold solves   wall time of the solves of single pairs, and the longest of them
//   from stamp     from the transforms' stamp until the message is here: the way through two sockets, the
//   wait
//                  for the next cycle and the cycle
//   from receipt   the same from when the transforms came here, nearly when the node got them
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/service.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "bare_timer.h"
#include "measurement.h"
#include "processor_time.h"

namespace concave_distance {
namespace {

constexpr double kWarmUp = 5.0;          // s, after the first solved message
constexpr double kLongestStart = 120.0;  // s, that the scene may take to load

/// False when the node does not take it.
bool setCutoff(const std::string& node, double cutoff) {
  dynamic_reconfigure::Reconfigure service;
  dynamic_reconfigure::StrParameter parameter;  // a text, as it may be `none`
  parameter.name = "cutoff";
  parameter.value = std::to_string(cutoff);
  service.request.config.strs.push_back(parameter);
  if (!ros::service::call(node + "/set_parameters", service)) return false;
  const auto& taken = service.response.config.strs;
  return std::any_of(taken.begin(), taken.end(), [&](const dynamic_reconfigure::StrParameter& other) {
    return other.name == parameter.name && other.value != "none" && std::stod(other.value) == cutoff;
  });
}

/// Handles messages for that long, or until the condition holds.
template <typename Condition>
bool spinFor(double seconds, const Condition& until) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.05));
    if (until()) {
      return true;
    }
  }
  return false;
}

MachineSeconds since(const MachineSeconds& before) {
  const MachineSeconds now = machineSeconds();
  return {now.idle - before.idle, now.stolen - before.stolen};
}

int run() {
  const ros::NodeHandle parameters("~");
  const std::string measured = parameters.param<std::string>("node", "/concave_distance");
  const double seconds = parameters.param("seconds", 60.0);
  const std::string topic = parameters.param<std::string>("topic", "niches");
  if (topic != "niches" && topic != "distances") {
    std::fprintf(stderr, "~topic is '%s': expected niches or distances.\n", topic.c_str());
    return 1;
  }
  ros::NodeHandle node;
  Measurement measurement(node, measured, topic);
  ros::Subscriber markers;
  if (parameters.param("markers", false)) {
    const boost::function<void(const visualization_msgs::MarkerArrayConstPtr&)> ignore = [](const auto&) {};
    markers = node.subscribe<visualization_msgs::MarkerArray>(measured + "/markers", 10, ignore);
  }
  if (!spinFor(kLongestStart, [&] { return measurement.hasSeenADistance(); })) {
    std::fprintf(stderr, "No distance came on %s/%s within %.0f s.\n", measured.c_str(), topic.c_str(),
                 kLongestStart);
    return 1;
  }
  const double cutoff = parameters.param("cutoff", -1.0);
  if (cutoff >= 0.0 && !setCutoff(measured, cutoff)) {
    std::fprintf(stderr, "The cutoff could not be set.\n");
    return 1;
  }
  double rate = 0.0;
  node.getParam(measured + "/rate", rate);
  const auto never = [] { return false; };
  spinFor(kWarmUp, never);
  const int process = processOf(measured);
  const MachineSeconds machine_before = machineSeconds();
  const double process_before = processSeconds(process);
  const ros::WallTime begin = ros::WallTime::now();
  BareTimer bare(1.0 / rate);
  measurement.restart();
  spinFor(seconds, never);
  bare.stop();
  print(measurement.figures(), rate, (ros::WallTime::now() - begin).toSec(),
        processSeconds(process) - process_before, bare, since(machine_before));
  return 0;
}

}  // namespace
}  // namespace concave_distance

int main(int argc, char** argv) {
  ros::init(argc, argv, "node_timing");
  return concave_distance::run();
}
