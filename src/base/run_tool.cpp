#include "run_tool.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

#include "concave_distance/base/error.h"

namespace concave_distance {

int runTool(const char* name, int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    std::signal(SIGPIPE, SIG_IGN);  // a write fails instead when its reader goes away
    const int status = run(argc, argv);
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw Error("standard output", "not everything could be written",
                  "check the space on the device, and that its reader still runs");
    }
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, shortText(error.what()).c_str());
    return kFileProblem;
  }
}

}  // namespace concave_distance
