#pragma once

#include <ros/time.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace concave_distance {

/// A distance_node of its own, which runs beside the test until it is told to end.
class StartedNode {
 public:
  /// @param arguments remappings and parameters, e.g. "__name:=other", "_rate:=100"
  explicit StartedNode(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {std::filesystem::read_symlink("/proc/self/exe").parent_path() /
                                        "distance_node"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    process_ = fork();
    if (process_ == 0) {
      std::vector<char*> pointers;
      for (std::string& part : command) pointers.push_back(part.data());
      pointers.push_back(nullptr);
      execv(pointers.front(), pointers.data());
      _exit(127);
    }
  }
  ~StartedNode() {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
  }
  StartedNode(const StartedNode&) = delete;
  StartedNode& operator=(const StartedNode&) = delete;

  void interrupt() const { kill(process_, SIGINT); }
  /// The status it ended with; nothing when it still runs after so many seconds.
  std::optional<int> waitForEnd(double seconds) {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(seconds);
    int status = 0;
    while (ros::WallTime::now() < deadline) {
      if (waitpid(process_, &status, WNOHANG) == process_) {
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      }
      ros::WallDuration(0.02).sleep();
    }
    return std::nullopt;
  }

 private:
  pid_t process_ = -1;
};

}  // namespace concave_distance
