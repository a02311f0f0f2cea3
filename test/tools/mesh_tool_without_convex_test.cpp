#include <gtest/gtest.h>

#include <sstream>

#include "concave_distance/base/error.h"
#include "tools/mesh_tool_convex.h"

namespace concave_distance::tools::mesh_tool_without_convex_test {
namespace {

TEST(MeshToolWithoutCgal, SaysWhatToInstallAndWhichOptionToTurnOn) {
  std::ostringstream out;
  for (const auto& command : {hullOfMeshFile, partitionMeshFile, treeOfMeshFile}) {
    try {
      command({}, out);
      ADD_FAILURE() << "no error";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("CONCAVE_DISTANCE_WITH_CGAL=ON"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace concave_distance::tools::mesh_tool_without_convex_test
