#pragma once

#include <string>

namespace concave_distance {

/// The process of a node, asked from the node itself; 0 when it does not answer.
int processOf(const std::string& node);

/// Processor seconds that a process has used so far; NaN when there is none.
double processSeconds(int process);

/// Seconds of all cores so far (proc(5)).
struct MachineSeconds {
  double idle;    ///< nobody had anything to do
  double stolen;  ///< the machine below a virtual one had taken the core away
};
MachineSeconds machineSeconds();

}  // namespace concave_distance
