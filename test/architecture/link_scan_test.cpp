#include <gtest/gtest.h>
#include <link.h>

#include <regex>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {
namespace {

/// Every shared object of this process, which links the core and GoogleTest and nothing else.
std::vector<std::string> loadedLibraries() {
  std::vector<std::string> names;
  const auto collect = [](dl_phdr_info* object, std::size_t, void* result) {
    static_cast<std::vector<std::string>*>(result)->emplace_back(object->dlpi_name);
    return 0;
  };
  dl_iterate_phdr(collect, &names);
  return names;
}

TEST(Architecture, TheCoreLinksNoRosLibrary) {
  const SurfaceMesh uses_the_core({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                  {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}}, "");
  EXPECT_EQ(uses_the_core.triangleCount(), 1u);
  const std::regex ros_library(
      R"(/lib(ros|xmlrpcpp|cpp_common|tf2?[._]|tf2_ros|catkin|nodelet|actionlib|urdf\.so))");
  bool core_seen = false;
  for (const std::string& name : loadedLibraries()) {
    EXPECT_FALSE(std::regex_search(name, ros_library)) << name;
    core_seen = core_seen || name.find("libconcave_distance_internal") != std::string::npos;
  }
  EXPECT_TRUE(core_seen);
}

// A mesh file ends nothing but the process that reads it: mesh_import_worker alone has the import library.
TEST(Architecture, TheCoreLinksNoImportLibrary) {
  for (const std::string& name : loadedLibraries()) {
    EXPECT_EQ(name.find("assimp"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace concave_distance
