#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "benchmark/support/benchmark_pairs.h"
#include "concave_distance/scene/simulation_settings.h"
#include "thesis/benchmark/support/manoeuvre_methods.h"

namespace concave_distance::benchmark {

/// The curves of Carretero, figures 6.6 and 6.7, and the time of each step beside them, as a CSV file:
/// a line a method and an instant, of the convex partition with quadratic programs (warm, all sub-pairs, cut
/// by hand), of the thesis's search with its Table 6.1, and of the pair tracker at `nodes` (with that search,
/// too), `refined` and `certified` with all niches.
class ManoeuvreCurves {
 public:
  /// @throws Error when the file cannot be written
  explicit ManoeuvreCurves(const std::string& path);

  /// A method's steps, when it is one of these. @param exact proven distances, metres; @param best_nodes
  /// those of the best node pair there is
  void add(const Method& method, const std::vector<TimedPose>& poses, const std::vector<MethodStep>& steps,
           const std::vector<double>& exact, const std::vector<double>& best_nodes);

 private:
  std::ofstream csv_;
};

/// The distance of the best node pair at every pose, metres: enumeration.
std::vector<double> bestNodeDistances(const PartitionedPair& pair, const std::vector<TimedPose>& poses);

}  // namespace concave_distance::benchmark
