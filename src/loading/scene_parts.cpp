#include "scene_parts.h"

#include <algorithm>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "kinematics/wording.h"
#include "scene/name_pattern.h"

namespace concave_distance::detail {
namespace {

std::string bodyName(const RobotSpec& spec, const std::string& link) {
  return spec.prefix + link;
}

void addSource(BodySource source, const std::string& where, const std::string& remedy, SceneParts& parts) {
  const auto same = std::find_if(parts.sources.begin(), parts.sources.end(),
                                 [&](const BodySource& other) { return other.name == source.name; });
  if (same != parts.sources.end()) {
    throw Error(where, "the body name '" + source.name + "' is taken by " + same->source, remedy);
  }
  parts.sources.push_back(std::move(source));
}

// Links that `skip_links` takes out, each pattern of which must match one.
std::set<std::string> skippedLinks(const RobotSpec& spec, const RobotDescription& robot) {
  std::set<std::string> skipped;
  for (const Selector& selector : spec.skipped_links) {
    const std::string wanted = withoutLeadingSlash(selector.text);
    bool matched = false;
    for (const RobotLink& link : robot.links) {
      if (link.name != wanted && !matchesPattern(wanted, link.name)) continue;
      skipped.insert(link.name);
      matched = true;
    }
    if (!matched) {
      throw Error(selector.where, "'" + selector.text + "' matches no link of robot '" + robot.name + "'",
                  "name a link as the URDF does");
    }
  }
  return skipped;
}

BodySource linkSource(const RobotSpec& spec, const RobotLink& link, const DescriptionText& urdf) {
  BodySource source;
  source.name = bodyName(spec, link.name);
  source.frame = source.name;
  source.source = urdf.where + ", link '" + link.name + "'";
  source.geometry = link.geometry;
  source.base_folder = urdf.base_folder;
  source.max_edge_length = spec.max_edge_length;
  for (GeometryElement& element : source.geometry) element.chord_error = spec.chord_error;
  if (link.colour) source.colour = *link.colour;
  source.material = spec.material;
  source.margin = spec.margin;
  if (const auto own = spec.own.find(link.name); own != spec.own.end()) {
    source.margin = own->second.margin.value_or(spec.margin);
    source.label = own->second.label;
  }
  source.in_robot_model = !spec.description.empty();
  source.is_robot_link = true;
  source.inertia = link.inertia;
  source.problem = link.problem;
  return source;
}

void addLinks(const RobotSpec& spec, const RobotDescription& robot, const DescriptionText& urdf,
              SceneParts& parts) {
  const std::set<std::string> skipped = skippedLinks(spec, robot);
  std::vector<std::string> members;
  std::vector<std::string> served;
  std::size_t bare = 0;
  for (const RobotLink& link : robot.links) {
    if (skipped.count(link.name) != 0) continue;
    if (!link.hasGeometry()) {
      parts.bare_links.insert(bodyName(spec, link.name));
      ++bare;
      continue;
    }
    addSource(linkSource(spec, link, urdf), spec.where, "give one of the robots a prefix, or skip the link",
              parts);
    members.push_back(bodyName(spec, link.name));
    served.push_back(link.name);
  }
  for (const auto& [link, own] : spec.own) {
    if (std::find(served.begin(), served.end(), link) != served.end()) continue;
    throw Error(own.where, "'" + link + "' is no link of robot '" + robot.name + "' that becomes a body",
                "name a link with geometry as the URDF does");
  }
  parts.notes.push_back(urdf.where + ": " + counted(members.size(), "link") + " with geometry, " +
                        std::to_string(bare) + " without, " + std::to_string(skipped.size()) + " skipped");
  parts.groups.emplace_back(spec.name.empty() ? spec.prefix + robot.name : spec.name, std::move(members));
}

// A robot whose joints make no sense is served all the same: tf says where its links are.
void addKinematics(const RobotSpec& spec, const RobotDescription& robot, const DescriptionText& urdf,
                   SceneParts& parts) {
  RobotStructure structure{robot.name, {}, robot.joints};
  for (const RobotLink& link : robot.links) structure.links.push_back(link.name);
  try {
    parts.robots.push_back(std::make_shared<const RobotKinematics>(structure, urdf.where, spec.prefix));
  } catch (const Error& error) {
    parts.notes.push_back(std::string(error.what()) + "; this robot has no queries at joint positions, no " +
                          "rows of constraints and no cutoff of its own");
  }
}

}  // namespace

const char* SceneParts::filterReason(std::size_t source_a, std::size_t source_b) const {
  const BodySource& a = sources[source_a];
  const BodySource& b = sources[source_b];
  const LinkPair pair = linkPair(a.name, b.name);
  if (disabled_by_srdf.count(pair) != 0) return kDisabledBySrdf;
  if (rigid.areJoined(a.frame, b.frame)) return kRigid;
  if (adjacent.count(pair) != 0) return kAdjacent;
  return nullptr;
}

void addRobot(const RobotSpec& spec, const RobotDescription& robot, const DescriptionText& urdf,
              SceneParts& parts) {
  for (const std::string& note : robot.notes) parts.notes.push_back(urdf.where + ", " + note);
  addLinks(spec, robot, urdf, parts);
  addKinematics(spec, robot, urdf, parts);
  for (const RobotJoint& joint : robot.joints) {
    if (joint.type == JointType::Fixed)
      parts.rigid.join(bodyName(spec, joint.parent), bodyName(spec, joint.child));
    if (joint.type == JointType::Floating) {
      parts.notes.push_back(urdf.where + ", joint '" + joint.name +
                            "' floats, so robot_state_publisher leaves out " + "the transform from '" +
                            bodyName(spec, joint.parent) + "' to '" + bodyName(spec, joint.child) +
                            "': what is below it has no distance until " +
                            "something publishes that (robot_mover.py publishes the joint's origin)");
    }
  }
  for (const LinkPair& pair : adjacentLinks(robot)) {
    parts.adjacent.insert(linkPair(bodyName(spec, pair.first), bodyName(spec, pair.second)));
  }
}

void addSemantics(const RobotSpec& spec, const SemanticDescription& semantics, SceneParts& parts) {
  for (const LinkPair& pair : semantics.disabled) {
    parts.disabled_by_srdf.insert(linkPair(bodyName(spec, pair.first), bodyName(spec, pair.second)));
  }
  for (const auto& [name, links] : semantics.groups) {
    std::vector<std::string> members;
    for (const std::string& link : links) members.push_back(bodyName(spec, link));
    parts.groups.emplace_back(spec.prefix + name, std::move(members));
  }
  parts.notes.insert(parts.notes.end(), semantics.notes.begin(), semantics.notes.end());
  parts.warnings.insert(parts.warnings.end(), semantics.warnings.begin(), semantics.warnings.end());
}

void addBody(const BodySpec& spec, const std::string& base_folder, SceneParts& parts) {
  BodySource source = sourceOf(spec.description, base_folder);
  source.source = spec.where + ", " + source.source;
  source.colour = spec.colour;
  source.margin = spec.margin;
  source.material = spec.material;
  source.label = spec.label;
  source.frame_from_body = spec.frame_from_body;
  source.cloud = spec.cloud;
  addSource(std::move(source), spec.where, "give it another name", parts);
}

void limitImports(SceneParts& parts, const MeshImportLimits& limits) {
  for (BodySource& source : parts.sources) {
    for (GeometryElement& element : source.geometry) element.access.limits = limits;
  }
}

BodySource sourceOf(const BodyDescription& description, const std::string& base_folder) {
  BodySource source;
  source.name = description.name;
  source.frame = description.frame;
  source.source = "body '" + description.name + "'";
  const auto add = [&](const BodyShape& shape, const std::string& which) {
    GeometryElement element;
    element.mesh_resource = shape.mesh_resource;
    element.scale = shape.scale;
    element.primitive = shape.primitive;
    element.dimensions = shape.dimensions;
    element.triangles = shape.triangles;
    element.chord_error = description.chord_error;
    element.frame_from_geometry = shape.frame_from_geometry;
    element.access = description.mesh_access;
    element.where = source.source + which;
    source.geometry.push_back(std::move(element));
  };
  const std::vector<BodyShape>& others = description.other_shapes;
  add(description, others.empty() ? "" : ", shape 1");
  for (std::size_t i = 0; i < others.size(); ++i) add(others[i], ", shape " + std::to_string(i + 2));
  source.base_folder = base_folder;
  source.max_edge_length = description.max_edge_length;
  BodyOrigin origin;
  origin.shapes.push_back(description);
  origin.shapes.insert(origin.shapes.end(), others.begin(), others.end());
  origin.base_folder = base_folder;
  origin.max_edge_length = description.max_edge_length;
  origin.chord_error = description.chord_error;
  source.origin = std::make_shared<const BodyOrigin>(std::move(origin));
  return source;
}

}  // namespace concave_distance::detail
