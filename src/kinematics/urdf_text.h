#pragma once

#include <tinyxml2.h>
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <cstddef>
#include <string>
#include <vector>

#include "robot_joint.h"

namespace concave_distance::detail {

inline constexpr const char* kCheckUrdf = "check it with check_urdf; a xacro file must be expanded first";

/// Holds what urdfdom makes of a text, with what it said meanwhile.
struct ParsedModel {
  urdf::ModelInterfaceSharedPtr model;  ///< nullptr: it made none
  std::vector<std::string> messages;
};
ParsedModel parseModel(const std::string& urdf);

/// Reads the XML of a URDF. Deeply nested text would overflow the stack in urdfdom; so tinyxml2, which limits
/// depth, reads it first, and the number of links is limited.
/// @throws Error naming `where`
void parseXml(tinyxml2::XMLDocument& document, const std::string& urdf, const std::string& where);
std::string printed(const tinyxml2::XMLDocument& document);

/// Reads the model of a document. @throws Error with what urdfdom says when it makes none
ParsedModel requireModel(const tinyxml2::XMLDocument& document, const std::string& where);

/// @param name nullptr: of any name
std::size_t countChildren(const tinyxml2::XMLElement& parent, const char* name = nullptr);

/// The links and joints of a model in the order of its text.
RobotStructure structureOf(const tinyxml2::XMLElement& root, const urdf::ModelInterface& model);

}  // namespace concave_distance::detail
