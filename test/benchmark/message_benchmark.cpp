// Measures what it costs to publish a pair's solution: its conversion to messages and to markers, and their
// serialisation, beside the solve itself. No master and no node: the functions that the node calls in every
// cycle.
//
//   message_benchmark [--pairs name,name,...] [--steps 200] [--output doc/results/messages.csv]
//
// A row is a pair and a level, along the pair's motion as in accuracy_benchmark (5 s, the first instant left
// out). Mean microseconds a cycle, processor time of one thread: `solve`, the tracker's cycle; `message`,
// from the solution to PairNiches (to PairDistance where the distance alone is asked for); `markers`, from
// that message to the MarkerArray that rviz shows; `wire`, both into the bytes that subscribers in other
// processes get. The node sends messages in every cycle and markers at `marker_rate`, and nothing to nobody.
#include <ros/serialization.h>
#include <CLI/CLI.hpp>
#include <vector>

#include "benchmark/support/accuracy_pairs.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "ros/markers/niche_markers.h"
#include "ros/messages/conversions.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kDuration = 5.0;  // seconds of a motion

struct Level {
  const char* name;
  AccuracyLevel accuracy;
  bool niches;
};

/// Sums over the warm cycles, microseconds.
struct Sums {
  double solve = 0.0;
  double message = 0.0;
  double markers = 0.0;
  double wire = 0.0;
  double niches = 0.0;
  double bytes = 0.0;
};

/// Times what is between its calls, less what asking for the time takes: a third of a microsecond, as much as
/// a short message.
class Laps {
 public:
  Laps() {
    constexpr int kCalls = 1000;
    const double start = processorMicroseconds();
    for (int k = 0; k < kCalls; ++k) last_ = processorMicroseconds();
    own_ = (last_ - start) / kCalls;
  }
  void begin() { last_ = processorMicroseconds(); }
  void add(double& sum) {
    const double now = processorMicroseconds();
    sum += now - last_ - own_;
    last_ = now;
  }

 private:
  double last_ = 0.0;
  double own_ = 0.0;
};

PairHeading headingOf(const BenchmarkPair& pair, const Level& level) {
  PairHeading heading;
  heading.pair = pair.name;
  heading.body_a = pair.a->name();
  heading.body_b = pair.b->name();
  heading.reference_frame = "world";
  heading.reference_from_a.translate(Eigen::Vector3d(1.0, 2.0, 3.0));
  heading.accuracy = level.accuracy;
  heading.with_niches = level.niches;
  return heading;
}

// Returns all that is drawn for a pair alone in its scene but the label.
std::vector<visualization_msgs::Marker> drawnMarkers(const PairNiches& message, const MarkerStyle& style) {
  std::vector<visualization_msgs::Marker> markers;
  for (const DrawnPair& drawn : selectPairs({&message}, style)) {
    const std::vector<visualization_msgs::Marker> of_pair = nicheMarkers(drawn, style);
    markers.insert(markers.end(), of_pair.begin(), of_pair.end());
  }
  return markers;
}

Sums follow(const BenchmarkPair& pair, const Level& level, int steps) {
  TrackerParameters parameters;
  parameters.accuracy = level.accuracy;
  parameters.niches_wanted = level.niches;
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  PairHeading heading = headingOf(pair, level);
  MarkerStyle style;
  style.scale = 0.02 * pair.b->diameter();
  style.far = 0.5;
  ShownMarkers shown;
  Laps laps;
  Sums all;
  for (int k = 0; k < steps; ++k) {
    const double t = static_cast<double>(k) / (steps - 1);
    heading.stamp = ros::Time(1.0 + kDuration * t);
    Sums sums;
    laps.begin();
    tracker.update(pair.motion(t), kDuration * t, solution);
    laps.add(sums.solve);
    if (level.niches) {
      const PairNiches message = toNiches(heading, solution);
      laps.add(sums.message);
      const visualization_msgs::MarkerArray markers =
          withDeletions(drawnMarkers(message, style), message.header, shown);
      laps.add(sums.markers);
      sums.bytes = static_cast<double>(ros::serialization::serializeMessage(message).num_bytes +
                                       ros::serialization::serializeMessage(markers).num_bytes);
      laps.add(sums.wire);
    } else {
      const PairDistance message = toDistance(heading, solution);
      laps.add(sums.message);
      sums.bytes = static_cast<double>(ros::serialization::serializeMessage(message).num_bytes);
      laps.add(sums.wire);
    }
    if (k == 0) continue;  // begins cold
    all.solve += sums.solve;
    all.message += sums.message;
    all.markers += sums.markers;
    all.wire += sums.wire;
    all.bytes += sums.bytes;
    all.niches += static_cast<double>(solution.niches.size());
  }
  return all;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("What a solution costs to tell");
  std::vector<std::string> names = accuracyPairs();
  int steps = 200;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run, rings_100k or of the benchmark pairs")->delimiter(',');
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::Range(2, 1000000));
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  ResultTable table(output, "pair,level,solve,message,markers,wire,niches,bytes");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadAccuracyPair(name);
    for (const Level& level :
         {Level{"nodes", AccuracyLevel::Nodes, true}, Level{"refined", AccuracyLevel::Refined, true},
          Level{"certified", AccuracyLevel::Certified, true},
          Level{"certified, distance alone", AccuracyLevel::Certified, false}}) {
      const Sums sums = follow(pair, level, steps);
      const double count = steps - 1;
      table.add(name, level.name, sums.solve / count, sums.message / count, sums.markers / count,
                sums.wire / count, sums.niches / count, sums.bytes / count);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
