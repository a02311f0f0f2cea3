#include "concave_distance/loading/resource_locator.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/ascii.h"
#include "concave_distance/base/error.h"
#include "resource_paths.h"

namespace concave_distance {
namespace {

namespace fs = std::filesystem;

// Workspaces nest packages in repositories, seldom deeper than this.
constexpr int kDeepestPackageFolder = 5;

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// RFC 3986, sec. 2.1; a % that no two hexadecimal digits follow stands for itself, as people write it.
std::string decodePercent(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hexDigit(text[i + 1]);
      const int low = hexDigit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        decoded.push_back(static_cast<char>(16 * high + low));
        i += 2;
        continue;
      }
    }
    decoded.push_back(text[i]);
  }
  return decoded;
}

bool startsWith(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

// A scheme as in RFC 3986, sec. 3.1, followed by "://".
std::optional<std::string> schemeOf(std::string_view resource) {
  const std::size_t end = resource.find("://");
  if (end == std::string_view::npos || end == 0) return std::nullopt;
  for (const char c : resource.substr(0, end)) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         c == '+' || c == '-' || c == '.';
    if (!allowed) return std::nullopt;
  }
  return std::string(resource.substr(0, end));
}

constexpr std::string_view kPackageScheme = "package://";
// Longer than any path that the system accepts.
constexpr std::size_t kLongestResource = 4096;

detail::ResourcePaths pathsInPackage(const std::string& resource, const PackageLocator& package_locator) {
  const std::string rest = resource.substr(kPackageScheme.size());
  const std::size_t slash = rest.find('/');
  const std::string package = decodePercent(std::string_view(rest).substr(0, slash));
  if (package.empty() || slash == std::string::npos || slash + 1 == rest.size()) {
    throw Error(resource, "a package and a file in it are expected", "write package://<package>/<path>");
  }
  // Names that rospack would take for options or further arguments are not passed to it.
  const bool is_name = package.front() != '-' && std::all_of(package.begin(), package.end(), [](char c) {
                         return isLetterOrDigit(c) || c == '_' || c == '-' || c == '.';
                       });
  const std::string folder = is_name && package_locator ? package_locator(package) : std::string();
  if (folder.empty()) {
    throw Error(resource, "package '" + package + "' is not known",
                "install it or source the workspace that has it (ROS_PACKAGE_PATH)");
  }
  const std::string path = rest.substr(slash + 1);
  return {{(fs::path(folder) / fs::path(decodePercent(path)).relative_path()).string(),
           (fs::path(folder) / fs::path(path).relative_path()).string()},
          folder};
}

// RFC 8089: file:///path, file://localhost/path.
detail::ResourcePaths pathsOfFileUri(const std::string& resource) {
  const std::string rest = resource.substr(std::string_view("file://").size());
  const std::size_t slash = rest.find('/');
  const std::string host = rest.substr(0, slash);
  if (slash == std::string::npos || !(host.empty() || host == "localhost")) {
    throw Error(resource, "'" + host + "' is where a host name is expected",
                "write file:///<absolute path>, or a path without file:// for a relative one");
  }
  const std::string path = rest.substr(slash);
  return {{decodePercent(path), path}, ""};
}

detail::ResourcePaths pathsOf(const std::string& resource, const std::string& base_folder,
                              const PackageLocator& package_locator) {
  if (startsWith(resource, kPackageScheme)) return pathsInPackage(resource, package_locator);
  if (startsWith(resource, "file://")) return pathsOfFileUri(resource);
  if (const std::optional<std::string> scheme = schemeOf(resource)) {
    throw Error(resource, "scheme '" + *scheme + "' is not known",
                "use package://, file:// or a path of this machine");
  }
  const fs::path path(resource);
  if (path.is_absolute()) return {{resource, decodePercent(resource)}, ""};
  if (base_folder.empty()) {
    throw Error(resource, "a relative path in a text that comes from no file",
                "write package://<package>/<path> or an absolute path");
  }
  const fs::path base(base_folder);
  return {{(base / path).string(), (base / decodePercent(resource)).string()}, ""};
}

std::string packageNameIn(const fs::path& package_xml) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(package_xml.c_str()) != tinyxml2::XML_SUCCESS) return {};
  const tinyxml2::XMLElement* root = document.FirstChildElement("package");
  const tinyxml2::XMLElement* name = root != nullptr ? root->FirstChildElement("name") : nullptr;
  const char* text = name != nullptr ? name->GetText() : nullptr;
  return text != nullptr ? text : std::string();
}

// Depth first, in the order of names, not below a package and not where CATKIN_IGNORE says so.
std::string crawl(const fs::path& folder, const std::string& package, int depth) {
  std::error_code error;
  if (fs::exists(folder / "CATKIN_IGNORE", error)) return {};
  if (fs::is_regular_file(folder / "package.xml", error)) {
    return packageNameIn(folder / "package.xml") == package ? folder.string() : std::string();
  }
  if (depth == 0) return {};
  std::vector<fs::path> children;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::error_code entry_error;
    if (entry.is_directory(entry_error) && entry.path().filename().string().front() != '.') {
      children.push_back(entry.path());
    }
  }
  std::sort(children.begin(), children.end());
  for (const fs::path& child : children) {
    std::string found = crawl(child, package, depth - 1);
    if (!found.empty()) return found;
  }
  return {};
}

std::vector<std::string> pathsIn(const char* variable) {
  std::vector<std::string> paths;
  const char* value = std::getenv(variable);
  if (value == nullptr) return paths;
  std::istringstream stream(value);
  for (std::string path; std::getline(stream, path, ':');) {
    if (!path.empty()) paths.push_back(path);
  }
  return paths;
}

std::string findPackage(const std::string& package, const std::vector<std::string>& workspaces) {
  if (package.empty() || package.find('/') != std::string::npos || package.front() == '.') return {};
  std::vector<std::string> shares = workspaces;
  for (const std::string& prefix : pathsIn("CMAKE_PREFIX_PATH")) shares.push_back(prefix + "/share");
  // Debian's own ROS packages are here; they come without a setup file that would say so.
  shares.emplace_back("/usr/share");
  for (const std::string& share : shares) {
    const fs::path folder = fs::path(share) / package;
    std::error_code error;
    if (fs::is_regular_file(folder / "package.xml", error)) return folder.string();
  }
  for (const std::string& workspace : workspaces) {
    std::string found = crawl(workspace, package, kDeepestPackageFolder);
    if (!found.empty()) return found;
  }
  return {};
}

}  // namespace

std::string packagePathFromEnvironment(const std::string& package) {
  return findPackage(package, pathsIn("ROS_PACKAGE_PATH"));
}

PackageLocator packagesBelow(std::vector<std::string> folders) {
  const std::vector<std::string> others = pathsIn("ROS_PACKAGE_PATH");
  folders.insert(folders.end(), others.begin(), others.end());
  return [folders = std::move(folders)](const std::string& package) { return findPackage(package, folders); };
}

std::string locateResource(const std::string& resource, const std::string& base_folder,
                           const PackageLocator& package_locator) {
  return detail::firstFile(resource,
                           detail::resourcePaths(resource, base_folder, package_locator).candidates);
}

namespace detail {

std::optional<std::string> packageOf(const std::string& resource) {
  if (!startsWith(resource, kPackageScheme)) return std::nullopt;
  const std::string rest = resource.substr(kPackageScheme.size());
  return decodePercent(std::string_view(rest).substr(0, rest.find('/')));
}

ResourcePaths resourcePaths(const std::string& resource, const std::string& base_folder,
                            const PackageLocator& package_locator) {
  if (resource.empty()) {
    throw Error("resource", "the file name is empty",
                "give package://<package>/<path>, file:///<path> or a path");
  }
  if (resource.size() > kLongestResource) {
    throw Error(resource.substr(0, 60) + "...",
                "a file name of " + std::to_string(resource.size()) + " characters",
                "allowed: at most " + std::to_string(kLongestResource));
  }
  ResourcePaths paths = pathsOf(resource, base_folder, package_locator);
  for (const std::string& candidate : paths.candidates) {
    if (candidate.find('\0') != std::string::npos) {
      // The text after the zero byte would be missing in messages.
      throw Error(resource.substr(0, resource.find('\0')), "the file name holds a zero byte",
                  "remove it (%00)");
    }
  }
  return paths;
}

// Only a regular file can hold triangles, not a folder or a socket.
std::string firstFile(const std::string& resource, const std::vector<std::string>& candidates) {
  std::error_code error;
  for (const std::string& candidate : candidates) {
    if (fs::is_regular_file(candidate, error)) return candidate;
  }
  if (fs::is_directory(candidates.front(), error)) {
    throw Error(resource, "'" + candidates.front() + "' is a folder", "name a file");
  }
  if (fs::exists(candidates.front(), error)) {
    throw Error(resource, "'" + candidates.front() + "' is no regular file", "name a file");
  }
  throw Error(resource, "file '" + candidates.front() + "' does not exist",
              "check the path and its upper and lower case letters");
}

}  // namespace detail
}  // namespace concave_distance
