#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/mesh/surface/mass_properties.h"
#include "geometry_element.h"
#include "kinematics/robot_joint.h"

namespace concave_distance::detail {

struct RobotLink {
  std::string name;                       ///< without a leading slash
  std::vector<GeometryElement> geometry;  ///< of the chosen kind, link frame; empty: no body
  std::optional<Eigen::Vector4d> colour;  ///< of the first visual element, when it has one
  std::optional<MassProperties> inertia;  ///< as given, link frame
  std::string problem;                    ///< why the geometry could not be read; empty: it could
  bool hasGeometry() const { return !geometry.empty() || !problem.empty(); }
};

/// Holds what a URDF says that matters here; links and joints in the order of the text. Link names have no
/// leading slash: they come from the days of tf, robot_state_publisher drops it from the frames, and tf2
/// refuses it.
struct RobotDescription {
  std::string name;
  std::vector<RobotLink> links;
  std::vector<RobotJoint> joints;
  std::vector<std::string> notes;
  std::size_t links_with_other_geometry = 0;  ///< visual where collision is wanted, and the other way round
  const RobotLink* findLink(const std::string& link) const;
};

/// Reads a URDF through urdfdom. A link whose geometry cannot be read carries a problem, the others go on.
/// @param where named in the error: file or parameter
/// @throws Error with what urdfdom says when it makes no model of the text, and for links of one name
RobotDescription readRobotDescription(const std::string& urdf, const std::string& where,
                                      GeometrySource geometry);

}  // namespace concave_distance::detail
