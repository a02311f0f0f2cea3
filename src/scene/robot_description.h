#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/mesh/mass_properties.h"
#include "concave_distance/scene/load_scene.h"
#include "geometry_element.h"

namespace concave_distance::detail {

struct RobotLink {
  std::string name;                       ///< as in the URDF
  std::vector<GeometryElement> geometry;  ///< of the chosen kind, link frame; empty: no body
  std::optional<Eigen::Vector4d> colour;  ///< of the first visual element, when it has one
  std::optional<MassProperties> inertia;  ///< as given, link frame
  std::string problem;                    ///< why the geometry could not be read; empty: it could
  bool hasGeometry() const { return !geometry.empty() || !problem.empty(); }
};

struct RobotJoint {
  std::string name;
  std::string parent;
  std::string child;
  bool fixed = false;
};

/// What a URDF says that matters here; links and joints in the order of the text.
struct RobotDescription {
  std::string name;
  std::vector<RobotLink> links;
  std::vector<RobotJoint> joints;
  std::vector<std::string> notes;
  const RobotLink* findLink(const std::string& link) const;
};

/// Reads a URDF through urdfdom. A link whose geometry cannot be read carries a problem, the others go on.
/// @param where named in the error: file or parameter
/// @throws Error with what urdfdom says when it makes no model of the text
RobotDescription readRobotDescription(const std::string& urdf, const std::string& where,
                                      GeometrySource geometry);

}  // namespace concave_distance::detail
