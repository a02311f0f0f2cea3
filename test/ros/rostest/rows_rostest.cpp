// The demo `rows`: robots that keep clear by all rows reach their goals; by the nearest row alone they do not
// keep clear.
#include <gtest/gtest.h>
#include <ros/package.h>
#include <ros/param.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "run_node.h"
#include "support/temporary_folder.h"

namespace concave_distance::rows_rostest {
namespace {

const std::string kProgram = "rosrun concave_distance follow_rows.py _step:=0.01 _margin:=0.004 _gain:=10 ";

std::string packagePath(const std::string& path) {
  return ros::package::getPath("concave_distance") + "/" + path;
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

// Holds what a run has written.
struct RecordedRun {
  std::string text;
  std::string state;
  double seconds = 0.0;
  double least_value = 1.0;   // m
  double largest_jump = 0.0;  // of a joint's commanded velocity from one step to the next, m/s or rad/s
};

RecordedRun readRun(const std::filesystem::path& path) {
  RecordedRun run;
  run.text = test::contentOf(path);
  std::istringstream stream(run.text);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = cellsOf(line);
  std::vector<double> last;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    std::vector<double> velocities;
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (header[i].rfind("v_", 0) == 0) velocities.push_back(std::stod(cells[i]));
      if (header[i] == "value" && !cells[i].empty()) {
        run.least_value = std::min(run.least_value, std::stod(cells[i]));
      }
    }
    for (std::size_t i = 0; i < last.size(); ++i) {
      run.largest_jump = std::max(run.largest_jump, std::abs(velocities[i] - last[i]));
    }
    run.seconds = std::stod(cells.front());
    run.state = cells.back();
    // At the end of a run the velocity is 0.
    if (run.state == "moving") last = velocities;
  }
  return run;
}

class RowsDemo : public ::testing::Test {
 protected:
  RowsDemo() : folder_(std::filesystem::temp_directory_path() / ("rows_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~RowsDemo() override {
    std::filesystem::remove_all(folder_);
    ros::param::set("/use_sim_time", false);
  }

  void launch(const std::string& arguments) {
    const Ended ended =
        runCommand("timeout 400 roslaunch concave_distance rows.launch rviz:=false speed:=0 output:=" +
                   folder_.string() + " " + arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.output;
    output_ = ended.output;
  }
  RecordedRun run(const std::string& name) const {
    EXPECT_TRUE(std::filesystem::exists(folder_ / name)) << output_;
    return readRun(folder_ / name);
  }

  std::filesystem::path folder_;
  std::string output_;
};

TEST_F(RowsDemo, AToolAroundAnEdgeNeedsAllRows) {
  launch("scene:=clamp");
  const RecordedRun all = run("clamp_all.csv");
  EXPECT_EQ(all.state, "goal");
  EXPECT_LT(all.seconds, 3.0);
  EXPECT_GT(all.least_value, 0.0039) << "the margin is 4 mm";
  const RecordedRun nearest = run("clamp_nearest.csv");
  EXPECT_EQ(nearest.state, "contact");
  EXPECT_GT(nearest.largest_jump, 2.0 * all.largest_jump);
  launch("scene:=clamp rows:=all");
  EXPECT_EQ(run("clamp_all.csv").text, all.text) << "a run is the same every time";
}

TEST_F(RowsDemo, AnArmBetweenPostsNeedsAllRows) {
  launch("scene:=arm");
  const RecordedRun all = run("arm_all.csv");
  EXPECT_EQ(all.state, "goal");
  EXPECT_GT(all.least_value, 0.019) << "the margin is 20 mm";
  const RecordedRun nearest = run("arm_nearest.csv");
  EXPECT_LT(nearest.least_value, 0.01);
  EXPECT_GT(nearest.largest_jump, 2.0 * all.largest_jump);
}

TEST_F(RowsDemo, SaysWhatIsMissing) {
  ros::param::del("/robot_description");
  ros::param::del("/follow_rows");
  Ended ended = runCommand(kProgram + "_rows:=some 2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("rows is 'some': expected both, all or nearest"), std::string::npos)
      << ended.output;
  ros::param::set("/follow_rows/rows", "both");
  ended = runCommand(kProgram + "2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("there is no parameter robot_description"), std::string::npos) << ended.output;

  ros::param::set("/robot_description", test::contentOf(packagePath("urdf/clamp.urdf")));
  ended = runCommand(kProgram + "2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("there is no task"), std::string::npos) << ended.output;

  ASSERT_EQ(runCommand("rosparam load " + packagePath("config/rows_clamp_task.yaml") + " /follow_rows/task")
                .exit_code,
            0);
  ended = runCommand("timeout 60 " + kProgram + "_longest_wait:=2 2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("no rows came on /concave_distance/constraints within 2 s"), std::string::npos)
      << ended.output;
  EXPECT_NE(ended.output.find("roslaunch concave_distance rows.launch"), std::string::npos) << ended.output;

  ros::param::set("/follow_rows/task/start/turn", "left");
  ended = runCommand(kProgram + "2>&1");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.output.find("task: "), std::string::npos) << ended.output;
  ros::param::del("/robot_description");
}

}  // namespace
}  // namespace concave_distance::rows_rostest
