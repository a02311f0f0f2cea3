#pragma once

#include <iostream>

#include "base/number_text.h"
#include "base/short_text.h"

namespace concave_distance {

/// The status of a command-line tool whose files are at fault.
inline constexpr int kFileProblem = 1;
/// The status of a tool with a wrong command line.
inline constexpr int kWrongCommandLine = 2;

/// Writes what is wrong with a command line, or the help that it asks for; of a long argument its beginning
/// and end.
/// @param app a CLI::App, whose `parse` has thrown
/// @return the tool's status
template <typename App, typename ParseError>
int reportParseError(const App& app, const ParseError& error) {
  TextStream problem;
  const bool is_fault = app.exit(error, std::cout, problem) != 0;
  std::cerr << shortText(problem.str());
  return is_fault ? kWrongCommandLine : 0;
}

/// Runs a command-line tool for its `main`, writes out what is buffered and returns its status. An exception
/// becomes a message on standard error that begins with the tool's name, and kFileProblem.
int runTool(const char* name, int argc, char** argv, int (*run)(int argc, char** argv));

}  // namespace concave_distance
