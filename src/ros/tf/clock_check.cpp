#include "clock_check.h"

#include <ros/time.h>

namespace concave_distance {

std::string missingClock() {
  if (!ros::Time::isSimTime() || !ros::Time::now().isZero()) {
    return "";
  }
  return "No cycle runs: /use_sim_time is true and nothing publishes /clock. Start the simulation, or play "
         "the bag with --clock. If an earlier simulation left the parameter set, rosparam set "
         "/use_sim_time false and start the node again.";
}

}  // namespace concave_distance
