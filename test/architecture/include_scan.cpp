#include "architecture/include_scan.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace concave_distance {
namespace {

const std::string kTopRoom = "ros";
const std::string kPackage = "concave_distance";

std::vector<std::string> includesOf(const std::string& text) {
  static const std::regex directive(R"(^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"])");
  std::vector<std::string> included;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, directive)) included.push_back(match[1]);
  }
  return included;
}

/// The room of an include of this package, empty for any other: "concave_distance/mesh/x.h" gives "mesh".
std::string roomOf(const std::string& included) {
  const std::filesystem::path path(included);
  const std::vector<std::filesystem::path> parts(path.begin(), path.end());
  return parts.size() == 3 && parts.front() == kPackage ? parts[1].string() : std::string();
}

bool belongsToRos(const std::string& included) {
  static const std::regex ros_header(
      R"(^(ros|tf|tf2[a-z_]*|[a-z_]+_msgs|[a-z_]+_srvs|std_srvs|urdf|pluginlib|nodelet|dynamic_reconfigure|)"
      R"(diagnostic_updater|interactive_markers|resource_retriever|message_filters|rosbag|concave_distance)/)");
  const bool generated = std::filesystem::path(included).parent_path() == kPackage;
  return generated || (std::regex_search(included, ros_header) && roomOf(included).empty());
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

const std::vector<std::string>& roomsFromTheGround() {
  static const std::vector<std::string> rooms = {
      "base",    "mesh",     "distance", "partition",  "continuous", "search",     "interference",
      "contact", "tracking", "scene",    "simulation", "tools",      "evaluation", kTopRoom};
  return rooms;
}

std::vector<std::string> faultsOfIncludes(const std::string& text, const std::string& room,
                                          const std::string& own_header) {
  const std::vector<std::string>& rooms = roomsFromTheGround();
  const auto here = std::find(rooms.begin(), rooms.end(), room);
  std::vector<std::string> faults;
  if (here == rooms.end()) faults.push_back("room '" + room + "' is not in the list of rooms");
  const std::vector<std::string> included = includesOf(text);
  for (const std::string& header : included) {
    if (room != kTopRoom && belongsToRos(header)) faults.push_back("includes ROS's " + header);
    const std::string target = roomOf(header);
    if (target.empty()) continue;
    const auto there = std::find(rooms.begin(), rooms.end(), target);
    if (there == rooms.end())
      faults.push_back("includes " + header + ", which is in no listed room");
    else if (there > here)
      faults.push_back("includes " + header + ", an arrow upwards");
  }
  if (!own_header.empty() && (included.empty() || included.front() != own_header))
    faults.push_back("does not include its own header " + own_header + " first");
  return faults;
}

std::vector<std::string> faultsOfRooms(const std::filesystem::path& package, std::size_t& files_seen) {
  namespace fs = std::filesystem;
  const fs::path headers = package / "include" / kPackage;
  const fs::path sources = package / "src";
  std::vector<std::string> faults;
  for (const fs::path& root : {headers, sources}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".h" && file.extension() != ".cpp") continue;
      const std::string room = fs::relative(file, root).begin()->string();
      const std::string header_name = file.stem().string() + ".h";
      const bool has_header = file.extension() == ".cpp" && fs::exists(headers / room / header_name);
      const std::string own_header = has_header ? (fs::path(kPackage) / room / header_name).string() : "";
      for (const std::string& fault : faultsOfIncludes(contentOf(file), room, own_header))
        faults.push_back(file.string() + ": " + fault);
      ++files_seen;
    }
  }
  return faults;
}

}  // namespace concave_distance
