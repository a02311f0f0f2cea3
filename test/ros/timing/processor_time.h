#pragma once

#include <string>

namespace concave_distance {

/// The process of a node, asked from the node itself; 0 when it does not answer.
int processOf(const std::string& node);

/// Processor seconds that a process has used so far; NaN when there is none.
double processSeconds(int process);

/// Processor seconds of all cores that the machine below this one has taken away so far (steal, proc(5)).
double stolenSeconds();

}  // namespace concave_distance
