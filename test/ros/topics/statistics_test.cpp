#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>

#include "ros/topics/diagnostics.h"
#include "scene/cycle_statistics.h"

namespace concave_distance::statistics_test {
namespace {

using diagnostic_msgs::DiagnosticStatus;

CycleRecord record(double duration, bool late) {
  CycleRecord result;
  result.duration = duration;
  result.cpu = duration;
  result.late = late;
  result.report.watched = 2;
  result.report.solved = 2;
  result.report.cost.generations = 2;
  return result;
}

std::string valueOf(const DiagnosticStatus& status, const std::string& key) {
  for (const auto& pair : status.values) {
    if (pair.key == key) {
      return pair.value;
    }
  }
  return "none";
}

TEST(CycleStatistics, CoverTheTimeSinceTheLastLook) {
  CycleStatistics statistics;
  statistics.take(10.0);
  for (int i = 0; i < 50; ++i) {
    statistics.add(record(i == 7 ? 0.030 : 0.010, i == 7));
  }
  const CycleWindow window = statistics.take(11.0);
  EXPECT_EQ(window.cycles, 50U);
  EXPECT_EQ(window.late, 1U);
  EXPECT_EQ(window.total.solved, 100U);
  EXPECT_EQ(window.total.cost.generations, 100U);
  diagnostic_updater::DiagnosticStatusWrapper status;
  describePairs(window, status);
  EXPECT_EQ(valueOf(status, "search generations"), "100");
  EXPECT_DOUBLE_EQ(window.seconds, 1.0);
  EXPECT_NEAR(window.duration.mean(), (49 * 0.010 + 0.030) / 50, 1e-12);
  EXPECT_DOUBLE_EQ(window.duration.largest, 0.030);
  EXPECT_EQ(statistics.take(12.0).cycles, 0U);
  EXPECT_EQ(statistics.totalCycles(), 50U);
  EXPECT_EQ(statistics.totalLate(), 1U);
}

TEST(DescribeCycle, WarnsOfLateCyclesAndOfARateNotReached) {
  CycleStatistics statistics;
  statistics.take(0.0);
  for (int i = 0; i < 50; ++i) {
    statistics.add(record(0.010, i < 2));
  }
  CycleWindow window = statistics.take(1.0);
  diagnostic_updater::DiagnosticStatusWrapper status;
  describeCycle(window, 50.0, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(valueOf(status, "late cycles"), "2");
  EXPECT_EQ(valueOf(status, "cycle time max (ms)"), "10.000");
  EXPECT_EQ(valueOf(status, "latency from transform to message mean (ms)"), "none") << "nothing was measured";
  window.late = 0;
  describeCycle(window, 50.0, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  describeCycle(window, 100.0, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN) << "50 Hz of 100";
  describeCycle(CycleWindow(), 100.0, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN) << "no cycle at all";
}

TEST(DescribeCycle, SaysThatALongCycleIsRunning) {
  CycleStatistics statistics;
  diagnostic_updater::DiagnosticStatusWrapper status;
  const auto described = [&](double now) {
    describeCycle(statistics.take(now), 50.0, status);
    return status.message;
  };
  EXPECT_NE(described(0.0).find("no cycle ran"), std::string::npos);
  statistics.begin(0.5);
  EXPECT_EQ(described(1.0), "a cycle has been running for 0.5 s");
  EXPECT_EQ(described(2.0), "a cycle has been running for 1.5 s");
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  statistics.add(record(2.0, true));
  EXPECT_EQ(described(3.0), "100.0 % of the cycles were late");
  EXPECT_NE(described(4.0).find("no cycle ran"), std::string::npos);
  statistics.begin(4.5);
  statistics.addFailure();
  EXPECT_EQ(described(5.0), "errors ended cycles (see the node's log)");
}

TEST(DescribePairs, NamesThePairsWithoutTransforms) {
  CycleWindow window;
  window.last.watched = 3;
  diagnostic_updater::DiagnosticStatusWrapper status;
  describePairs(window, status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  window.failing = {"a/b: frame b does not exist"};
  describePairs(window, status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(valueOf(status, "no transforms 1"), "a/b: frame b does not exist");
}

TEST(DescribeScene, TellsWhatCouldNotBeLoaded) {
  Scene scene;
  diagnostic_updater::DiagnosticStatusWrapper status;
  describeScene(scene, "", "", status);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  scene.problems.push_back({"cup.stl", "there is no such file"});
  describeScene(scene, "", "", status);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(valueOf(status, "problem 1"), "cup.stl: there is no such file");
  describeScene(scene, "there is no robot description", "", status);
  EXPECT_NE(status.message.find("robot description"), std::string::npos);
}

}  // namespace
}  // namespace concave_distance::statistics_test
