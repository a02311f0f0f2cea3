#include "thesis/benchmark/support/manoeuvre_curves.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

#include "concave_distance/base/error.h"
#include "thesis/src/evaluation/enumeration.h"

namespace concave_distance::benchmark {

ManoeuvreCurves::ManoeuvreCurves(const std::string& path) : csv_(path) {
  if (!csv_) throw Error(path, "cannot be written", "name a file in a folder that is there");
  csv_ << "method,time,distance,exact,best_nodes,us,mflop,niches\n";
}

void ManoeuvreCurves::add(const Method& method, const std::vector<TimedPose>& poses,
                          const std::vector<MethodStep>& steps, const std::vector<double>& exact,
                          const std::vector<double>& best_nodes) {
  const bool partition = method.name == "QP, warm" && method.partition == "hand";
  const std::vector<std::string> levels = {"comb-GA-wl-sh, Table 6.1", "nodes", "refined", "certified"};
  if (!partition && std::find(levels.begin(), levels.end(), method.name) == levels.end()) return;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    csv_ << '"' << (partition ? "partition" : method.name) << '"' << ',' << poses[k].time
         << std::setprecision(std::numeric_limits<double>::max_digits10) << ',' << steps[k].distance << ','
         << exact[k] << ',' << best_nodes[k] << std::setprecision(6) << ',' << steps[k].time_us << ','
         << 1e-6 * steps[k].flops << ',' << steps[k].niches << '\n';
  }
}

std::vector<double> bestNodeDistances(const PartitionedPair& pair, const std::vector<TimedPose>& poses) {
  std::vector<double> distances;
  distances.reserve(poses.size());
  for (const TimedPose& pose : poses) {
    distances.push_back(std::sqrt(enumerateNodePairs(*pair.a, *pair.b, pose.pose).squared_distance));
  }
  return distances;
}

}  // namespace concave_distance::benchmark
