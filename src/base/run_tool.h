#pragma once

namespace concave_distance {

/// The status of a command-line tool whose files are at fault.
inline constexpr int kFileProblem = 1;
/// The status of a tool with a wrong command line.
inline constexpr int kWrongCommandLine = 2;

/// Runs a command-line tool for its `main`, writes out what is buffered and returns its status. An exception
/// becomes a message on standard error that begins with the tool's name, and kFileProblem. `--version` alone
/// prints buildVersions(), a line each.
int runTool(const char* name, int argc, char** argv, int (*run)(int argc, char** argv));

}  // namespace concave_distance
