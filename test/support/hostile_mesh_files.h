#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

namespace concave_distance::test {

/// A file of test/support/hostile_meshes.py and whether it is to be served or refused.
struct HostileMesh {
  std::string expectation;
  std::string name;
  std::string path;
};

inline std::vector<HostileMesh> writeHostileMeshes(const std::string& folder) {
  const std::string command =
      "python3 '" CONCAVE_DISTANCE_SOURCE_DIR "/test/support/hostile_meshes.py' '" + folder + "'";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string output;
  char buffer[4096];
  while (const std::size_t size = fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, size);
  EXPECT_EQ(pclose(pipe), 0) << command;
  std::vector<HostileMesh> meshes;
  std::istringstream lines(output);
  for (HostileMesh mesh; lines >> mesh.expectation >> mesh.name >> mesh.path;) meshes.push_back(mesh);
  return meshes;
}

}  // namespace concave_distance::test
