#include "robot_description.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "kinematics/urdf_text.h"
#include "kinematics/urdf_values.h"
#include "kinematics/wording.h"

namespace concave_distance::detail {
namespace {

const char* elementName(GeometrySource geometry) {
  return geometry == GeometrySource::Collision ? "collision" : "visual";
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

std::vector<LinkText> scan(const tinyxml2::XMLElement& root, const char* wanted) {
  std::vector<LinkText> links;
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
    links.push_back(counted);
  }
  return links;
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

// About the centre of mass, in the link's axes: in the URDF the tensor has its own axes.
std::optional<MassProperties> inertiaOf(const urdf::Link& link) {
  if (!link.inertial) return std::nullopt;
  const urdf::Inertial& given = *link.inertial;
  const Eigen::Isometry3d link_from_inertial = toIsometry(given.origin);
  MassProperties inertia;
  inertia.mass = given.mass;
  inertia.centre_in_body = link_from_inertial.translation();
  inertia.inertia << given.ixx, given.ixy, given.ixz, given.ixy, given.iyy, given.iyz, given.ixz, given.iyz,
      given.izz;
  inertia.inertia = link_from_inertial.linear() * inertia.inertia * link_from_inertial.linear().transpose();
  return inertia;
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
  const ParsedModel full = requireModel(document, where);
  tinyxml2::XMLElement* root = document.FirstChildElement("robot");
  const std::vector<LinkText> text = scan(*root, wanted);
  const bool visual_is_wanted = geometry == GeometrySource::Visual;
  const std::vector<LinkText> other =
      scan(*root, elementName(visual_is_wanted ? GeometrySource::Collision : GeometrySource::Visual));
  RobotDescription robot;
  RobotStructure structure = structureOf(*root, *full.model);
  robot.name = structure.name;
  robot.joints = std::move(structure.joints);
  keepOnly(*root, wanted);
  const ParsedModel geometry_only = parseModel(printed(document));
  const std::map<std::string, std::string> all_faults = messagesByLink(full.messages);
  const std::map<std::string, std::string> geometry_faults = messagesByLink(geometry_only.messages);

  robot.links_with_other_geometry = static_cast<std::size_t>(
      std::count_if(other.begin(), other.end(), [](const LinkText& link) { return link.elements > 0; }));
  for (const LinkText& link_text : text) {
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
  requireDistinctLinks(robot, where);
  return robot;
}

}  // namespace concave_distance::detail
