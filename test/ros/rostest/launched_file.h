#pragma once

#include <gtest/gtest.h>
#include <ros/time.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace concave_distance {

/// A launch file of this package, started by roslaunch while this object lives.
class LaunchedFile {
 public:
  /// @param arguments of roslaunch after the package, the file first
  explicit LaunchedFile(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {"roslaunch", "concave_distance"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    log_ = std::filesystem::temp_directory_path() / ("launched_" + std::to_string(getpid()) + ".log");
    process_ = fork();
    if (process_ == 0) {
      setsid();
      FILE* log = std::freopen(log_.c_str(), "w", stdout);
      if (log == nullptr || dup2(fileno(log), STDERR_FILENO) < 0) _exit(126);
      std::vector<char*> pointers;
      for (std::string& part : command) pointers.push_back(part.data());
      pointers.push_back(nullptr);
      execvp(pointers.front(), pointers.data());
      _exit(127);
    }
  }
  ~LaunchedFile() {
    if (!ended_) end();
    std::filesystem::remove(log_);
  }
  LaunchedFile(const LaunchedFile&) = delete;
  LaunchedFile& operator=(const LaunchedFile&) = delete;

  std::string output() const { return test::contentOf(log_); }

  /// Fails when roslaunch or one of its nodes has ended.
  void expectAllUp() {
    EXPECT_EQ(waitpid(process_, nullptr, WNOHANG), 0) << "roslaunch has ended:\n" << output();
    const std::string text = output();
    for (const char* sign : {"has died", "has finished cleanly", "cannot launch", "Invalid", "FATAL"}) {
      EXPECT_EQ(text.find(sign), std::string::npos) << "'" << sign << "' in\n" << text;
    }
  }

  /// Ctrl-C. False when roslaunch had to be killed.
  bool end() {
    ended_ = true;
    kill(process_, SIGINT);
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(40.0);
    while (ros::WallTime::now() < deadline) {
      if (waitpid(process_, nullptr, WNOHANG) == process_) return true;
      ros::WallDuration(0.05).sleep();
    }
    kill(-process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    return false;
  }

 private:
  pid_t process_ = -1;
  std::string log_;
  bool ended_ = false;
};

}  // namespace concave_distance
