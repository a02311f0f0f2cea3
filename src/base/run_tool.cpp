#include "run_tool.h"

#include <cstdio>
#include <exception>
#include <string>

#include "output_file.h"
#include "versions.h"

namespace concave_distance {

int runTool(const char* name, int argc, char** argv, int (*run)(int argc, char** argv)) {
  try {
    ignoreClosedPipes();
    int status = 0;
    if (argc == 2 && argv[1] == std::string("--version")) {
      for (const auto& [part, version] : buildVersions())
        std::printf("%s %s\n", part.c_str(), version.c_str());
    } else {
      status = run(argc, argv);
    }
    finishStandardOutput();
    return status;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return kFileProblem;
  }
}

}  // namespace concave_distance
