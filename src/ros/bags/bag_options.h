#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bag_transforms.h"
#include "ros/node/node_parameters.h"

namespace concave_distance {

/// Names the parameter that a robot's description usually has.
inline constexpr const char* kUsualDescription = "robot_description";

/// Holds the command line of distance_bag.
struct BagOptions {
  BagSelection bags;
  NodeParameters node;
  std::string robot_description;
  std::vector<std::string> descriptions;  ///< NAME=FILE
  std::vector<std::string> pairs;         ///< patterns
  std::string output;
  std::string niches_output;
  std::string plot;
};

/// @param options outlives `app`
void addBagOptions(CLI::App& app, BagOptions& options);
/// Completes and checks what was parsed. @throws Error naming the option
void checkBagOptions(const CLI::App& app, BagOptions& options);
/// @throws Error when an output is an input, or the other output
void requireDistinctFiles(const BagOptions& options);

}  // namespace concave_distance
