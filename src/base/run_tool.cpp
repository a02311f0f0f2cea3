#include "run_tool.h"

#include <cstdio>
#include <exception>

#include "output_file.h"

namespace concave_distance {

int runTool(const char* name, int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    ignoreClosedPipes();
    const int status = run(argc, argv);
    finishStandardOutput();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, shortText(error.what()).c_str());
    return kFileProblem;
  }
}

}  // namespace concave_distance
