#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "support/temporary_folder.h"

namespace concave_distance::test {

/// Runs a program in a folder and returns the exit status; -1: a signal ended it.
/// The file "log" of the folder gets what it prints.
inline int runIn(const TemporaryFolder& folder, const std::string& program, const std::string& arguments) {
  const std::string command = "cd " + folder.path() + " && " + program + " " + arguments + " > log 2>&1";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace concave_distance::test
