#pragma once

#include <Eigen/Geometry>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "benchmark/support/benchmark_pairs.h"

namespace concave_distance::benchmark {

/// What a method said at one instant. Metres.
struct Answer {
  double distance;
  double lower_bound;  ///< NaN: none
  double microseconds;
};
/// @param time seconds since the motion began @param first of its motion or of the cold queries
using Query = std::function<Answer(const Eigen::Isometry3d& pose, double time, bool first)>;

/// Methods asked at instants along a pair's motion, cold or tracked: a row each, printed and written.
class Rows {
 public:
  static constexpr double kDuration = 5.0;  ///< seconds of a motion

  /// @param output CSV file; empty: none @param steps instants tracked @param cold instants of cold queries
  Rows(const std::string& output, int steps, int cold);

  /// Takes the truth of the pair's instants. @param set `tuned` or `held out`
  void begin(const BenchmarkPair& pair, const std::string& set);

  void cold(const std::string& method, const std::string& setting, const Query& query);
  void tracked(const std::string& method, const std::string& setting, const Query& query);

 private:
  struct Instant {
    double time;
    Eigen::Isometry3d pose;
    double distance;
  };

  static std::vector<Instant> instants(const BenchmarkPair& pair, int count);
  void add(const std::string& method, const std::string& setting, const char* mode,
           const std::vector<Instant>& instants, const Query& query);

  int steps_;
  int cold_;
  std::ofstream csv_;
  std::string name_;
  std::string set_;
  double unit_ = 1.0;
  std::vector<Instant> tracked_;
  std::vector<Instant> colds_;
};

/// As short as it can be.
std::string number(double value);

}  // namespace concave_distance::benchmark
