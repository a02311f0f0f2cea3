#include "frame_name.h"

#include <algorithm>

#include "base/ascii.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

// tf2 has no limit; a longer name is a mistake, and tf2 would keep it as long as the node runs.
constexpr std::size_t kLongestFrameName = 255;

}  // namespace

std::string tfFrameProblem(std::string_view frame) {
  if (frame.empty()) return "it is empty";
  if (frame.size() > kLongestFrameName) {
    return "it has " + std::to_string(frame.size()) + " characters, more than " +
           std::to_string(kLongestFrameName);
  }
  if (frame.front() == '/') return "it begins with a slash that tf2 does not look up";
  const auto control = std::find_if(frame.begin(), frame.end(), isControl);
  if (control != frame.end()) {
    return "it contains the control character with code " +
           std::to_string(static_cast<int>(static_cast<unsigned char>(*control)));
  }
  return "";
}

std::string withoutLeadingSlash(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

std::string frameNameProblem(std::string_view frame) {
  std::string problem = tfFrameProblem(frame);
  if (!problem.empty()) return problem;
  return frame.find(' ') == std::string_view::npos ? "" : "it contains a blank";
}

std::string requireFrameName(const std::string& frame, const std::string& where) {
  std::string name = withoutLeadingSlash(frame);
  const std::string problem = frameNameProblem(name);
  if (!problem.empty()) {
    throw Error(where, "it is not a valid tf frame name: " + problem,
                "name a frame that tf knows, such as world, without blanks");
  }
  return name;
}

}  // namespace concave_distance
