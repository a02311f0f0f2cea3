#include <gtest/gtest.h>
#include <link.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::link_scan_test {
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

// Lines of what a command writes.
std::vector<std::string> linesOf(const std::string& command) {
  std::vector<std::string> lines;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return lines;
  char line[4096];
  while (std::fgets(line, sizeof line, pipe) != nullptr) lines.emplace_back(line);
  ::pclose(pipe);
  return lines;
}

// Functions of C that read or write by the host program's locale, and std::to_string of a double, which calls
// one of them. base/number_text.h and base/ascii.h have what to use instead.
TEST(Architecture, TheLibraryCallsNothingThatDependsOnALocale) {
  const std::regex by_locale(
      "(strto(f|d|ld)|ato(f|i|l)|(__isoc[0-9]+_)?v?f?sscanf|is(alnum|alpha|blank|cntrl|digit|graph|lower|"
      "print|"
      "punct|space|upper|xdigit)|tolower|toupper|strcoll|strcasecmp|strftime|mbtowc|mbstowcs)(@.*)?");
  std::size_t symbols = 0;
  for (const std::string& library : loadedLibraries()) {
    if (library.find("libconcave_distance_internal") == std::string::npos) continue;
    for (const std::string& line : linesOf("nm '" + library + "'")) {
      std::istringstream words(line);
      std::string symbol;
      while (words >> symbol) continue;  // the last one
      ++symbols;
      EXPECT_FALSE(std::regex_match(symbol, by_locale)) << symbol;
      EXPECT_EQ(symbol.find("__to_xstring"), std::string::npos) << "std::to_string of a number with a point";
    }
  }
  EXPECT_GT(symbols, 1000U);
}

// The streams of C++ that format by the global locale; TextStream and OutputFile have the classic one.
TEST(Architecture, NoMessageIsWrittenByAStreamOfTheGlobalLocale) {
  namespace fs = std::filesystem;
  const fs::path source = fs::path(CONCAVE_DISTANCE_SOURCE_DIR) / "src";
  const std::regex stream(R"(std::(o?stringstream|regex|put_time|get_time)\b)");
  // Tools and the program that reads mesh files set no locale.
  const std::vector<std::string> programs{"tools", "import_worker"};
  std::size_t files = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(source)) {
    const std::string path = entry.path().lexically_relative(source).string();
    const bool is_program = std::any_of(programs.begin(), programs.end(), [&](const std::string& folder) {
      return path.find(folder + "/") != std::string::npos;
    });
    if (!entry.is_regular_file() || is_program || path == "base/number_text.h") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_FALSE(std::regex_search(text, stream)) << path;
    ++files;
  }
  EXPECT_GT(files, 300U);
}

}  // namespace
}  // namespace concave_distance::link_scan_test
