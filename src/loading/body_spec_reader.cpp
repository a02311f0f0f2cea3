#include "body_spec_reader.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/ascii.h"
#include "kinematics/frame_name.h"
#include "scene/name_pattern.h"
#include "settings_reader.h"
#include "shape_reader.h"

namespace concave_distance::detail {
namespace {

constexpr std::pair<const char*, GeometrySource> kGeometrySources[] = {
    {"collision", GeometrySource::Collision}, {"visual", GeometrySource::Visual}};

// One of two texts at most, one at least where it is required.
void readOneOf(YamlMap& map, const char* first, const char* second, std::string& into_first,
               std::string& into_second, bool required) {
  const std::optional<YamlValue> a = map.take(first);
  const std::optional<YamlValue> b = map.take(second);
  const std::string both = "'" + std::string(first) + "' and '" + second + "'";
  if (a && b) b->fail("both " + both + " are given", "give one of them");
  if (required && !a && !b) map.value().fail("neither of " + both + " is given", "give one of them");
  if (a) into_first = a->text();
  if (b) into_second = b->text();
}

Eigen::Vector4d readColour(const YamlValue& value) {
  const char* allowed = "three or four numbers from 0 to 1: red, green, blue, opacity";
  if (!value.isList()) value.refuse(allowed);
  const std::vector<YamlValue> parts = value.list(allowed);
  if (parts.size() != 3 && parts.size() != 4) value.refuse(allowed);
  Eigen::Vector4d colour(0, 0, 0, 1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    colour[static_cast<Eigen::Index>(i)] =
        parts[i].number("from 0 to 1", [](double c) { return c >= 0.0 && c <= 1.0; });
  }
  return colour;
}

/// Reads what robots and bodies may say each for itself, else `defaults` say.
void readOverDefaults(YamlMap& map, const BodyDefaults& defaults, std::optional<double>& max_edge_length,
                      std::optional<double>& chord_error, Material& material) {
  max_edge_length = defaults.max_edge_length;
  if (auto v = map.take("max_edge_length")) max_edge_length = readEdgeLength(*v);
  chord_error = defaults.chord_error;
  if (auto v = map.take("chord_error")) chord_error = readLength(*v);
  material = defaults.material;
  if (auto v = map.take("material")) material = readMaterial(*v, defaults.materials);
}

std::string readLabel(const YamlValue& value) {
  std::string label = value.text();
  requirePairName(value, label);
  return label;
}

std::map<std::string, LinkSpec> readLinks(const YamlValue& value) {
  std::map<std::string, LinkSpec> links;
  const YamlMap names(value, "a map from a link's name to its margin and label");
  for (const auto& [name, said] : names.entries()) {
    YamlMap map(said, "a map with margin and label");
    LinkSpec& link = links[name];
    link.where = said.where();
    if (auto v = map.take("margin")) link.margin = readLengthOrZero(*v);
    if (auto v = map.take("label")) link.label = readLabel(*v);
    map.finish();
  }
  return links;
}

}  // namespace

std::string readPlainText(const YamlValue& value) {
  std::string text = value.text();
  if (isPattern(text)) value.refuse("a text without * ? [");
  return text;
}

void requirePairName(const YamlValue& value, const std::string& name) {
  const auto allowed = [](char c) { return isLetterOrDigit(c) || c == '_' || c == '/'; };
  if (!std::all_of(name.begin(), name.end(), allowed) || name.front() == '/' || name.back() == '/' ||
      name.find("//") != std::string::npos) {
    value.refuse("letters, digits, _ and single / in between");
  }
}

void readBodyDefaults(YamlMap& map, BodyDefaults& defaults) {
  if (auto v = map.take("geometry")) defaults.geometry = v->choice(kGeometrySources);
  if (auto v = map.take("max_edge_length")) defaults.max_edge_length = readEdgeLength(*v);
  if (auto v = map.take("chord_error")) defaults.chord_error = readLength(*v);
  if (auto v = map.take("material")) defaults.material = readMaterial(*v, defaults.materials);
}

RobotSpec readRobotSpec(const YamlValue& value, const BodyDefaults& defaults) {
  YamlMap map(value, "a map with description or urdf");
  RobotSpec robot;
  robot.where = value.where();
  readOneOf(map, "description", "urdf", robot.description, robot.urdf, true);
  readOneOf(map, "semantic_description", "srdf", robot.semantic_description, robot.srdf, false);
  if (auto v = map.take("name")) robot.name = readPlainText(*v);
  if (auto v = map.take("prefix")) {
    robot.prefix = withoutLeadingSlash(readPlainText(*v));  // else tf2 would refuse every frame
  }
  robot.geometry = defaults.geometry;
  if (auto v = map.take("geometry")) robot.geometry = v->choice(kGeometrySources);
  if (auto v = map.take("skip_links")) {
    for (const YamlValue& link : v->list("a list of links and patterns")) {
      robot.skipped_links.push_back({link.where(), link.text()});
    }
  }
  if (auto v = map.take("margin")) robot.margin = readLengthOrZero(*v);
  if (auto v = map.take("links")) robot.own = readLinks(*v);
  readOverDefaults(map, defaults, robot.max_edge_length, robot.chord_error, robot.material);
  map.finish();
  return robot;
}

void readLooks(YamlMap& map, BodySpec& body) {
  if (auto v = map.take("label")) body.label = readLabel(*v);
  if (auto v = map.take("colour")) body.colour = readColour(*v);
  if (auto v = map.take("margin")) body.margin = readLengthOrZero(*v);
}

BodySpec readBodySpec(const YamlValue& value, const BodyDefaults& defaults) {
  YamlMap map(value, "a map with name, frame and a geometry");
  BodySpec body;
  body.where = value.where();
  BodyDescription& description = body.description;
  const YamlValue name = map.require("name", "give every body a name");
  description.name = readPlainText(name);
  description.frame = description.name;
  if (auto v = map.take("frame")) {
    description.frame = requireFrameName(v->text(), v->where());
  } else if (const std::string problem = tfFrameProblem(description.name); !problem.empty()) {
    name.fail("it cannot also be the name of its frame: " + problem, "give a 'frame' or another name");
  }
  readShapes(map, description);
  if (auto v = map.take("placed")) body.frame_from_body = readPose(*v);
  readLooks(map, body);
  readOverDefaults(map, defaults, description.max_edge_length, description.chord_error, body.material);
  map.finish();
  return body;
}

}  // namespace concave_distance::detail
