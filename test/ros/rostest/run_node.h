#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace concave_distance {

/// How a program ended.
struct Ended {
  int exit_code;
  std::string output;
};

/// Runs a command of the shell until it ends; what it says.
inline Ended runCommand(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  Ended ended{-1, ""};
  std::array<char, 256> buffer{};
  while (pipe != nullptr && fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    ended.output += buffer.data();
  }
  const int status = pipe == nullptr ? -1 : pclose(pipe);
  ended.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return ended;
}

/// Runs a node of its own until it ends; what it says on both streams.
inline Ended runNode(const std::string& arguments, const std::string& program = "distance_node") {
  // It stands beside this program.
  const std::string node = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  return runCommand("timeout 20 " + node + " " + arguments + " 2>&1");
}

}  // namespace concave_distance
