#include "architecture/include_scan.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace concave_distance {
namespace {

const std::string kTopFolder = "ros";
const std::string kThesis = "thesis/src";
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

/// The listed folder that a path below src or include/concave_distance lies in, else the path's first folder.
std::string folderOf(const std::filesystem::path& path) {
  const std::string parent = path.parent_path().string() + "/";
  std::string found;
  for (const std::string& folder : foldersFromTheGround()) {
    if (parent.compare(0, folder.size() + 1, folder + "/") == 0 && folder.size() > found.size())
      found = folder;
  }
  return found.empty() && path.has_parent_path() ? path.begin()->string() : found;
}

bool isPublic(const std::string& included) {
  return included.compare(0, kPackage.size() + 1, kPackage + "/") == 0;
}

/// The folder of an include of this package, empty for any other and for the file's own folder:
/// "concave_distance/mesh/x.h" (public) and "mesh/x.h" (private) give "mesh".
std::string includedFolder(const std::string& included) {
  if (isPublic(included)) return folderOf(included.substr(kPackage.size() + 1));
  const std::string folder = folderOf(included);
  const std::vector<std::string>& known = foldersFromTheGround();
  const bool is_ours = folder != kTopFolder && std::find(known.begin(), known.end(), folder) != known.end();
  return is_ours ? folder : "";
}

bool belongsToRos(const std::string& included) {
  static const std::regex ros_header(
      R"(^(ros|tf|tf2[a-z_]*|[a-z_]+_msgs|[a-z_]+_srvs|std_srvs|urdf|pluginlib|nodelet|dynamic_reconfigure|)"
      R"(diagnostic_updater|resource_retriever|message_filters|rosbag|concave_distance)/)");
  const bool generated = std::filesystem::path(included).parent_path() == kPackage;
  return generated || (std::regex_search(included, ros_header) && includedFolder(included).empty());
}

bool isBelow(const std::string& folder, const std::string& other) {
  return folder == other || folder.compare(0, other.size() + 1, other + "/") == 0;
}

/// What only some of the higher folders may include.
struct Reserved {
  std::string folder;
  std::vector<std::string> users;
};
const std::vector<Reserved> kReserved = {{kThesis, {kThesis}},
                                         {"search/grid", {"search", "tracking", kThesis}}};

bool mayInclude(const std::string& folder, const std::string& target) {
  return std::all_of(kReserved.begin(), kReserved.end(), [&](const Reserved& reserved) {
    return !isBelow(target, reserved.folder) ||
           std::any_of(reserved.users.begin(), reserved.users.end(),
                       [&](const std::string& user) { return isBelow(folder, user); });
  });
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Includes in quotes that are not of public headers.
std::vector<std::string> privateIncludes(const std::string& text) {
  static const std::regex directive(R"x(#[ \t]*include[ \t]*"([^"]+)")x");
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), directive), end; match != end; ++match) {
    if (!isPublic((*match)[1])) found.push_back((*match)[1]);
  }
  return found;
}

}  // namespace

const std::vector<std::string>& foldersFromTheGround() {
  static const std::vector<std::string> folders = {"base",
                                                   "mesh/surface",
                                                   "mesh/trees",
                                                   "mesh/repair",
                                                   "mesh",
                                                   "mesh/import",
                                                   "distance",
                                                   "distance/kernels",
                                                   "distance/bound",
                                                   "distance/minima",
                                                   "distance/niches",
                                                   "search/grid",
                                                   "search",
                                                   "interference",
                                                   "contact",
                                                   "tracking",
                                                   "scene",
                                                   "simulation",
                                                   "kinematics",
                                                   "loading",
                                                   "thesis/src/genetic",
                                                   "thesis/src/partition",
                                                   "thesis/src/continuous",
                                                   "thesis/src/annealing",
                                                   kThesis,
                                                   "tools",
                                                   "python",
                                                   kTopFolder,
                                                   "ros/tf",
                                                   "ros/messages",
                                                   "ros/markers",
                                                   "ros/topics",
                                                   "ros/services",
                                                   "ros/clouds",
                                                   "ros/node",
                                                   "ros/bags",
                                                   "ros/guard"};
  return folders;
}

std::vector<std::string> faultsOfIncludes(const std::string& text, const std::filesystem::path& file,
                                          const std::string& own_header) {
  const std::vector<std::string>& folders = foldersFromTheGround();
  const std::string folder = folderOf(file);
  const auto here = std::find(folders.begin(), folders.end(), folder);
  std::vector<std::string> faults;
  if (here == folders.end()) faults.push_back("folder '" + folder + "' is not in the list of folders");
  const std::vector<std::string> included = includesOf(text);
  for (const std::string& header : included) {
    if (!isBelow(folder, kTopFolder) && belongsToRos(header)) faults.push_back("includes ROS's " + header);
    const std::string target = includedFolder(header);
    if (target.empty()) continue;
    const auto there = std::find(folders.begin(), folders.end(), target);
    if (there == folders.end())
      faults.push_back("includes " + header + ", which is in no listed folder");
    else if (there > here)
      faults.push_back("includes " + header + ", an arrow upwards");
    if (!mayInclude(folder, target))
      faults.push_back("includes " + header + ", which is not for folder '" + folder + "'");
  }
  if (!own_header.empty() && (included.empty() || included.front() != own_header))
    faults.push_back("does not include its own header " + own_header + " first");
  return faults;
}

std::vector<std::string> faultsOfFolders(const std::filesystem::path& package, std::size_t& files_seen) {
  namespace fs = std::filesystem;
  const fs::path headers = package / "include" / kPackage;
  const fs::path sources = package / "src";
  std::vector<std::string> faults;
  for (const fs::path& folder : {headers, sources, package / kThesis}) {
    const fs::path root = folder == package / kThesis ? package : folder;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".h" && file.extension() != ".cpp") continue;
      ++files_seen;
      const fs::path below = fs::relative(file, root);
      const fs::path header = fs::path(folderOf(below)) / (file.stem().string() + ".h");
      std::string own_header;
      if (file.extension() == ".cpp" && fs::exists(headers / header)) {
        own_header = (fs::path(kPackage) / header).string();
      } else if (file.extension() == ".cpp" && fs::exists(fs::path(file).replace_extension(".h"))) {
        own_header = header.filename();
      }
      const std::string text = contentOf(file);
      for (const std::string& fault : faultsOfIncludes(text, below, own_header))
        faults.push_back(file.string() + ": " + fault);
      if (root != headers) continue;
      for (const std::string& included : privateIncludes(text))
        faults.push_back(file.string() + ": a public header includes " + included +
                         ", which is not installed");
    }
  }
  return faults;
}

}  // namespace concave_distance
