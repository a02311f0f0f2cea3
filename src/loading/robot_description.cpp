#include "robot_description.h"

#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

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
constexpr const char* kCheckUrdf = "check it with check_urdf; a xacro file must be expanded first";

const char* elementName(GeometrySource geometry) {
  return geometry == GeometrySource::Collision ? "collision" : "visual";
}

// The same parse with what urdfdom said meanwhile.
struct ParsedModel {
  urdf::ModelInterfaceSharedPtr model;
  std::vector<std::string> messages;
};

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

// urdfdom reports a link's fault as some messages and a last one that names the link.
std::map<std::string, std::string> messagesByLink(const std::vector<std::string>& messages) {
  std::map<std::string, std::string> by_link;
  std::vector<std::string> pending;
  for (const std::string& message : messages) {
    pending.push_back(message);
    const std::string mark = "for Link [";
    const std::size_t begin = message.rfind(mark);
    const std::size_t end = message.rfind(']');
    if (begin == std::string::npos || end == std::string::npos || end < begin + mark.size()) continue;
    by_link[message.substr(begin + mark.size(), end - begin - mark.size())] = joinedText(pending, "; ");
    pending.clear();
  }
  return by_link;
}

// Counts what the text holds of the wanted kind, because urdfdom drops the rest of a link at the first fault
// (of an inertial or visual element too) and all but the first shape of a geometry.
struct LinkText {
  std::string name;
  std::size_t elements = 0;
  std::size_t most_shapes = 0;  ///< in one geometry element
};

struct RobotText {
  std::vector<LinkText> links;
  std::vector<std::string> joints;  ///< names, in the order of the text
};

/// @param name nullptr: of any name
std::size_t countChildren(const tinyxml2::XMLElement& parent, const char* name = nullptr) {
  std::size_t count = 0;
  for (const auto* child = parent.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    ++count;
  }
  return count;
}

RobotText scan(const tinyxml2::XMLElement& root, const char* wanted) {
  RobotText text;
  for (const auto* link = root.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    LinkText counted;
    counted.name = attribute(*link, "name");
    for (const auto* element = link->FirstChildElement(wanted); element != nullptr;
         element = element->NextSiblingElement(wanted)) {
      ++counted.elements;
      if (const auto* geometry = element->FirstChildElement("geometry")) {
        counted.most_shapes = std::max(counted.most_shapes, countChildren(*geometry));
      }
    }
    text.links.push_back(counted);
  }
  for (const auto* joint = root.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    text.joints.push_back(attribute(*joint, "name"));
  }
  return text;
}

// Takes all but the wanted elements out of every link.
void keepOnly(tinyxml2::XMLElement& root, const std::string& wanted) {
  for (auto* link = root.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    for (auto* child = link->FirstChildElement(); child != nullptr;) {
      auto* next = child->NextSiblingElement();
      if (child->Value() != wanted) link->DeleteChild(child);
      child = next;
    }
  }
}

std::string printed(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

// Deeply nested text would overflow the stack in urdfdom. So tinyxml2, which limits depth, reads the text
// first, and the number of links is limited.
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

GeometryElement toElement(const urdf::Geometry& geometry, const urdf::Pose& origin,
                          const std::string& where) {
  GeometryElement element;
  element.where = where;
  element.frame_from_geometry = toIsometry(origin);
  switch (geometry.type) {
    case urdf::Geometry::BOX: {
      const urdf::Vector3& size = static_cast<const urdf::Box&>(geometry).dim;
      element.primitive = "box";
      element.dimensions = {size.x, size.y, size.z};
      break;
    }
    case urdf::Geometry::SPHERE:
      element.primitive = "sphere";
      element.dimensions = {static_cast<const urdf::Sphere&>(geometry).radius};
      break;
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = static_cast<const urdf::Cylinder&>(geometry);
      element.primitive = "cylinder";
      element.dimensions = {cylinder.radius, cylinder.length};
      break;
    }
    case urdf::Geometry::MESH: {
      const auto& mesh = static_cast<const urdf::Mesh&>(geometry);
      element.mesh_resource = mesh.filename;
      element.scale = Eigen::Vector3d(mesh.scale.x, mesh.scale.y, mesh.scale.z);
      break;
    }
  }
  return element;
}

template <typename Elements>
std::vector<GeometryElement> toElements(const Elements& elements, const std::string& link, const char* kind) {
  std::vector<GeometryElement> converted;
  for (const auto& element : elements) {
    TextStream where;
    where << "link '" << link << "', " << kind;
    if (elements.size() > 1) where << " " << converted.size() + 1;
    converted.push_back(toElement(*element->geometry, element->origin, where.str()));
  }
  return converted;
}

std::vector<GeometryElement> geometryOf(const urdf::Link& link, GeometrySource geometry) {
  return geometry == GeometrySource::Collision ? toElements(link.collision_array, link.name, "collision")
                                               : toElements(link.visual_array, link.name, "visual");
}

std::optional<Eigen::Vector4d> colourOf(const urdf::Link& link) {
  if (!link.visual || !link.visual->material || !link.visual->material->texture_filename.empty()) {
    return std::nullopt;
  }
  const urdf::Color& colour = link.visual->material->color;
  return Eigen::Vector4d(colour.r, colour.g, colour.b, colour.a);
}

// '/a' and 'a' are two links for urdfdom and one frame for tf2.
void requireDistinctLinks(const RobotDescription& robot, const std::string& where) {
  std::set<std::string> names;
  for (const RobotLink& link : robot.links) {
    if (names.insert(link.name).second) continue;
    throw Error(where, "two links are called '" + link.name + "', one of them with a leading slash",
                "rename one: both would have the same tf frame");
  }
}

}  // namespace

const RobotLink* RobotDescription::findLink(const std::string& link) const {
  for (const RobotLink& candidate : links) {
    if (candidate.name == link) return &candidate;
  }
  return nullptr;
}

RobotDescription readRobotDescription(const std::string& urdf, const std::string& where,
                                      GeometrySource geometry) {
  const char* wanted = elementName(geometry);
  tinyxml2::XMLDocument document;
  parseXml(document, urdf, where);
  const ParsedModel full = parseModel(printed(document));
  if (!full.model) {
    throw Error(where, "the URDF cannot be read; urdfdom says: " + joinedText(full.messages, "; "),
                kCheckUrdf);
  }
  tinyxml2::XMLElement* root = document.FirstChildElement("robot");
  const RobotText text = scan(*root, wanted);
  const bool visual_is_wanted = geometry == GeometrySource::Visual;
  const RobotText other =
      scan(*root, elementName(visual_is_wanted ? GeometrySource::Collision : GeometrySource::Visual));
  keepOnly(*root, wanted);
  const ParsedModel geometry_only = parseModel(printed(document));
  const std::map<std::string, std::string> all_faults = messagesByLink(full.messages);
  const std::map<std::string, std::string> geometry_faults = messagesByLink(geometry_only.messages);

  RobotDescription robot;
  robot.name = full.model->getName();
  robot.links_with_other_geometry = static_cast<std::size_t>(std::count_if(
      other.links.begin(), other.links.end(), [](const LinkText& link) { return link.elements > 0; }));
  for (const LinkText& link_text : text.links) {
    RobotLink link;
    link.name = link_text.name;
    const urdf::LinkConstSharedPtr full_link = full.model->getLink(link.name);
    const urdf::LinkConstSharedPtr parsed =
        geometry_only.model ? geometry_only.model->getLink(link.name) : full_link;
    if (parsed) link.geometry = geometryOf(*parsed, geometry);
    if (full_link) link.colour = colourOf(*full_link);
    if (full_link) link.inertia = inertiaOf(*full_link);
    const auto fault = geometry_faults.find(link.name);
    const auto other_fault = all_faults.find(link.name);
    if (link.name.empty() && link_text.elements > 0) {
      link.problem = "the link has no name";
    } else if (link.geometry.size() != link_text.elements) {
      link.problem = "urdfdom read " + std::to_string(link.geometry.size()) + " of " +
                     std::to_string(link_text.elements) + " " + wanted + " elements" +
                     (fault != geometry_faults.end() ? ": " + fault->second : "");
    } else if (link_text.most_shapes > 1) {
      link.problem = "a geometry element holds " + std::to_string(link_text.most_shapes) +
                     " shapes and urdfdom reads the first alone; give each its own " + wanted + " element";
    } else if (other_fault != all_faults.end()) {
      robot.notes.push_back("link '" + link.name + "': " + other_fault->second + "; its " + wanted +
                            " geometry is read all the same");
    }
    if (!link.problem.empty()) link.geometry.clear();
    link.name = withoutLeadingSlash(link.name);
    robot.links.push_back(std::move(link));
  }
  for (const std::string& name : text.joints) {
    const urdf::JointConstSharedPtr joint = full.model->getJoint(name);
    if (!joint) continue;  // urdfdom refuses the whole text instead
    robot.joints.push_back(toJoint(*joint));
  }
  requireDistinctLinks(robot, where);
  return robot;
}

}  // namespace concave_distance::detail
