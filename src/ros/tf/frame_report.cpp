#include "frame_report.h"

#include <ros/time.h>

#include <set>

#include "base/number_text.h"
#include "kinematics/wording.h"

namespace concave_distance {
namespace {

// Longest chain of frames; a longer one is a loop.
constexpr int kLongestPath = 1000;

std::string listed(const std::set<std::string>& names) {
  return "'" + joinedText({names.begin(), names.end()}, "', '") + "'";
}

std::string rootOf(const tf2::BufferCore& buffer, std::string frame) {
  std::string parent;
  for (int step = 0; step < kLongestPath && buffer._getParent(frame, ros::Time(0), parent); ++step) {
    frame = parent;
  }
  return frame;
}

}  // namespace

std::string describeMissingFrames(const tf2::BufferCore& buffer, const Scene& scene,
                                  const std::string& reference_frame) {
  std::set<std::string> unknown;
  std::set<std::string> elsewhere;
  std::set<std::string> roots;
  for (const SceneBody& body : scene.bodies) {
    if (body.frame == reference_frame || buffer.canTransform(reference_frame, body.frame, ros::Time(0))) {
      continue;
    }
    if (buffer._frameExists(body.frame)) {
      elsewhere.insert(body.frame);
      roots.insert(rootOf(buffer, body.frame));
    } else {
      unknown.insert(body.frame);
    }
  }
  TextStream text;
  if (!unknown.empty()) {
    text << detail::counted(unknown.size(), "frame") << " of bodies " << (unknown.size() == 1 ? "is" : "are")
         << " not on tf: " << listed(unknown)
         << "; check that robot_state_publisher runs and that the joint states name every joint.";
  }
  if (!elsewhere.empty()) {
    text << (unknown.empty() ? "" : " ") << "tf does not connect the reference frame '" << reference_frame
         << "' with " << listed(elsewhere) << ", which are below " << listed(roots)
         << "; set ~reference_frame to " << (roots.size() == 1 ? "that" : "one of these")
         << ", or publish the transform between the two.";
  }
  return text.str();
}

std::string missingClock() {
  if (!ros::Time::isSimTime() || !ros::Time::now().isZero()) {
    return "";
  }
  return "No cycle runs: /use_sim_time is true and nothing publishes /clock. Start the simulation, or play "
         "the bag with --clock. If an earlier simulation left the parameter set, rosparam set "
         "/use_sim_time false and start the node again.";
}

}  // namespace concave_distance
