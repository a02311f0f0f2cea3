#include "concave_distance/base/error.h"
#include "mesh_tool_convex.h"

namespace concave_distance::tools {
namespace {

[[noreturn]] void failWithoutCgal(const char* command) {
  throw Error(command, "this mesh_tool was built without CGAL and ALGLIB",
              "install them (scripts/install_dependencies.sh build) and build with "
              "-DCONCAVE_DISTANCE_WITH_CGAL=ON");
}

}  // namespace

void hullOfMeshFile(const MeshToolOptions&, std::ostream&) {
  failWithoutCgal("hull");
}

void partitionMeshFile(const MeshToolOptions&, std::ostream&) {
  failWithoutCgal("partition");
}

void treeOfMeshFile(const MeshToolOptions&, std::ostream&) {
  failWithoutCgal("tree");
}

}  // namespace concave_distance::tools
