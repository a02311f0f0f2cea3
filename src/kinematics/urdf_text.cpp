#include "urdf_text.h"

#include <urdf_parser/urdf_parser.h>

#include <exception>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "frame_name.h"
#include "message_capture.h"
#include "urdf_values.h"
#include "wording.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kLongestDescription = 64'000'000;  // bytes
constexpr std::size_t kMostLinks = 10'000;
constexpr std::size_t kLongestQuote = 60;  // characters of a text that is not a URDF

}  // namespace

ParsedModel parseModel(const std::string& urdf) {
  const MessageCapture capture;
  ParsedModel parsed;
  try {
    parsed.model = urdf::parseURDF(urdf);
    parsed.messages = capture.messages();
  } catch (const std::exception& exception) {  // urdfdom lets a ParseError or a bad number through at times
    parsed.model.reset();
    parsed.messages = capture.messages();
    parsed.messages.emplace_back(exception.what());
  }
  return parsed;
}

std::size_t countChildren(const tinyxml2::XMLElement& parent, const char* name) {
  std::size_t count = 0;
  for (const auto* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    ++count;
  }
  return count;
}

void parseXml(tinyxml2::XMLDocument& document, const std::string& urdf, const std::string& where) {
  if (urdf.size() > kLongestDescription) {
    throw Error(where, "the URDF has " + std::to_string(urdf.size()) + " bytes",
                "allowed: at most " + std::to_string(kLongestDescription));
  }
  document.Parse(urdf.c_str(), urdf.size());
  if (document.Error()) {
    const std::string seen =
        urdf.find('<') == std::string::npos ? "; it is '" + urdf.substr(0, kLongestQuote) + "'" : "";
    throw Error(where, "the URDF cannot be read; " + xmlError(document) + seen, kCheckUrdf);
  }
  std::size_t links = 0;
  if (const auto* robot = document.FirstChildElement("robot")) links = countChildren(*robot, "link");
  if (links > kMostLinks) {
    throw Error(where, "the URDF has " + std::to_string(links) + " links",
                "allowed: at most " + std::to_string(kMostLinks));
  }
}

std::string printed(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

ParsedModel requireModel(const tinyxml2::XMLDocument& document, const std::string& where) {
  ParsedModel parsed = parseModel(printed(document));
  if (!parsed.model) {
    throw Error(where, "the URDF cannot be read; urdfdom says: " + joinedText(parsed.messages, "; "),
                kCheckUrdf);
  }
  return parsed;
}

RobotStructure structureOf(const tinyxml2::XMLElement& root, const urdf::ModelInterface& model) {
  RobotStructure structure;
  structure.name = model.getName();
  for (const auto* link = root.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    structure.links.push_back(withoutLeadingSlash(attribute(*link, "name")));
  }
  for (const auto* element = root.FirstChildElement("joint"); element != nullptr;
       element = element->NextSiblingElement("joint")) {
    // urdfdom refuses the whole text where it cannot read a joint.
    const urdf::JointConstSharedPtr joint = model.getJoint(attribute(*element, "name"));
    if (joint) structure.joints.push_back(toJoint(*joint));
  }
  return structure;
}

}  // namespace concave_distance::detail
