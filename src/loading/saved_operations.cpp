#include "saved_operations.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "base/number_text.h"
#include "body_spec_reader.h"
#include "build_bodies.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "mesh/surface/primitive_table.h"
#include "scene/apply_operations.h"
#include "scene_parts.h"
#include "set_effects.h"
#include "settings_reader.h"
#include "shape_reader.h"
#include "yaml_text.h"

namespace concave_distance::detail {
namespace {

// A line that begins so ends a document, whatever it is in.
bool isMark(const std::string& yaml, std::size_t line) {
  return yaml.compare(line, 3, "---") == 0 && (line + 3 == yaml.size() || yaml[line + 3] == ' ' ||
                                               yaml[line + 3] == '\n' || yaml[line + 3] == '\r');
}

bool isBlank(const std::string& yaml, std::size_t line) {
  const std::size_t first = yaml.find_first_not_of(" \t\r", line);
  return first == std::string::npos || yaml[first] == '\n' || yaml[first] == '#' || yaml[first] == '%';
}

// Where the second document begins; npos: there is none.
std::size_t secondDocument(const std::string& yaml) {
  bool has_first = false;
  for (std::size_t line = 0; line < yaml.size();
       line = std::min(yaml.find('\n', line), yaml.size() - 1) + 1) {
    if (has_first && isMark(yaml, line)) return line;
    has_first = has_first || (!isBlank(yaml, line) && !isMark(yaml, line));
  }
  return std::string::npos;
}

std::vector<std::string> readTexts(const YamlValue& value) {
  std::vector<std::string> texts;
  for (const YamlValue& item : value.list("a list of texts")) texts.push_back(item.text());
  return texts;
}

std::string readFrame(const YamlValue& value) {
  return requireFrameName(value.text(), value.where());
}

std::string require(YamlMap& map, const char* key, const char* remedy) {
  return map.require(key, remedy).text();
}

void readWarning(YamlMap& map, SceneOperation& operation) {
  if (auto v = map.take("warning_distance"); v && !v->isText("none"))
    operation.warning_distance = readLengthOrZero(*v);
  if (auto v = map.take("warning_hysteresis")) operation.warning_hysteresis = readLengthOrZero(*v);
}

void readAdd(YamlMap& map, SavedOperation& saved) {
  SceneOperation& operation = saved.operation;
  BodyDescription& description = saved.description;
  description.name = operation.body;
  description.frame = readFrame(map.require("frame_id", "name the frame that the body is fixed to"));
  const auto& fields = map.entries();
  if (std::none_of(fields.begin(), fields.end(), [](const auto& field) { return field.first == "shapes"; }))
    map.value().fail("'shapes' is missing", "give a list of shapes");
  readShapes(map, description);
  if (auto v = map.take("max_edge_length")) description.max_edge_length = readLength(*v);
  if (auto v = map.take("chord_error")) description.chord_error = readLength(*v);
  if (auto v = map.take("pose")) saved.looks.frame_from_body = readPose(*v);
  BodySpec looks;
  readLooks(map, looks);
  saved.looks.label = looks.label;
  saved.looks.colour = looks.colour;
  saved.looks.margin = looks.margin;
  if (auto v = map.take("pair_with")) operation.partners.names = readTexts(*v);
  if (auto v = map.take("without_pairs")) operation.partners.none = v->boolean();
  if (auto v = map.take("touch_links")) operation.partners.may_touch = readTexts(*v);
  if (auto v = map.take("rigid_frames")) operation.rigid_frames = readTexts(*v);
  readWarning(map, operation);
}

void readPlace(YamlMap& map, SceneOperation& operation) {
  operation.frame = readFrame(map.require("frame_id", "name the frame of the pose"));
  if (auto v = map.take("pose")) operation.frame_from_body = readPose(*v);
}

void readFields(YamlMap& map, SavedOperation& saved) {
  SceneOperation& operation = saved.operation;
  const auto read_body = [&] { operation.body = require(map, "body", "name the body"); };
  const auto read_pair = [&] { operation.pair = require(map, "pair", "name the pairs"); };
  switch (operation.kind) {
    case OperationKind::Add:
      read_body();
      readAdd(map, saved);
      break;
    case OperationKind::Remove:
      read_body();
      if (auto v = map.take("allow_robot_link")) operation.allow_robot_link = v->boolean();
      break;
    case OperationKind::Detach:
      if (auto v = map.take("switched_on")) operation.switched_on = readTexts(*v);
      [[fallthrough]];
    case OperationKind::Move:
      read_body();
      readPlace(map, operation);
      break;
    case OperationKind::Attach:
      read_body();
      operation.other = require(map, "other", "name the body, link or frame that it is attached to");
      if (auto v = map.take("frame_id")) operation.frame = readFrame(*v);
      if (auto v = map.take("pose")) operation.frame_from_body = readPose(*v);
      if (auto v = map.take("touch_links")) operation.touch_links = readTexts(*v);
      break;
    case OperationKind::AllowContact:
    case OperationKind::DisallowContact:
      read_body();
      operation.other = require(map, "other", "name the other side");
      break;
    case OperationKind::SetMargin:
      read_body();
      operation.margin = readLengthOrZero(map.require("margin", "give metres"));
      break;
    case OperationKind::EnablePairs:
    case OperationKind::DisablePairs:
      read_pair();
      break;
    case OperationKind::SetEffects: {
      read_pair();
      const YamlValue text = map.require("effects", "give none, or the text of a map");
      operation = effectsOperation(operation.pair, text.text(), text.where());
      break;
    }
    case OperationKind::SetWarningDistance:
      read_pair();
      readWarning(map, operation);
      break;
  }
}

SavedOperation readOperation(const YamlValue& value) {
  YamlMap map(value, "a map with operation and its fields");
  SavedOperation saved;
  saved.where = value.where();
  saved.operation.kind = map.require("operation", "say which operation it is").choice(kOperationNames);
  readFields(map, saved);
  map.finish();
  saved.operation.is_recorded = true;
  return saved;
}

// Reads the meshes of all in parallel.
void buildAdded(const std::vector<SavedOperation>& all, const std::string& base_folder,
                const SceneLoadOptions& options, const Scene& scene,
                std::vector<SceneOperation>& operations) {
  std::vector<BodySource> sources;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].operation.kind != OperationKind::Add) continue;
    BodyDescription description = all[i].description;
    if (!description.max_edge_length) description.max_edge_length = scene.defaults.max_edge_length;
    if (!description.chord_error) description.chord_error = scene.defaults.chord_error;
    description.mesh_access.limits = options.mesh_import;
    sources.push_back(sourceOf(description, base_folder));
    sources.back().frame_from_body = all[i].looks.frame_from_body;
    sources.back().colour = all[i].looks.colour;
    sources.back().margin = all[i].looks.margin;
    sources.back().label = all[i].looks.label;
    sources.back().material = scene.defaults.material;
    places.push_back(i);
  }
  std::vector<BuiltBody> built = buildBodies(
      std::move(sources),
      {options.package_locator, options.mesh_search_path, scene.pool, options.limits, options.progress});
  for (std::size_t k = 0; k < built.size(); ++k) {
    SceneOperation& operation = operations[places[k]];
    operation.added = std::move(built[k].body);
    if (!operation.added)
      operation.problem.emplace("shapes", built[k].problem, "mend it, or take the operation out");
  }
}

void addShape(const BodyShape& shape, const std::string& base_folder,
              const std::function<std::string(const TriangleSoup&)>& mesh_file, YamlItems& items) {
  if (const Primitive* primitive = findPrimitive(shape.primitive)) {
    YamlItems sizes;
    auto at = shape.dimensions.begin();
    for (const Primitive::Size& size : primitive->sizes) {
      const std::vector<double> numbers(at, at + static_cast<std::ptrdiff_t>(size.count));
      sizes.add(size.key, size.count == 1 ? yamlNumber(numbers.front()) : yamlNumbers(numbers));
      at += static_cast<std::ptrdiff_t>(size.count);
    }
    items.add(shape.primitive, sizes.flow());
  } else {
    items.add("mesh", yamlText(shape.triangles ? mesh_file(*shape.triangles)
                                               : savedResource(shape.mesh_resource, base_folder)));
    const Eigen::Vector3d& s = shape.scale;
    if (s != Eigen::Vector3d::Ones()) items.add("scale", yamlNumbers({s.x(), s.y(), s.z()}));
  }
}

void addPose(const Eigen::Isometry3d& pose, YamlItems& items) {
  if (pose.matrix() != Eigen::Matrix4d::Identity()) items.add("pose", yamlPose(pose));
}

void addTexts(const char* key, const std::vector<std::string>& texts, YamlItems& items) {
  if (!texts.empty()) items.add(key, yamlTexts(texts));
}

void addWarning(const SceneOperation& operation, YamlItems& items) {
  if (!operation.warning_distance) {
    items.add("warning_distance", "none");
    return;
  }
  items.add("warning_distance", yamlNumber(*operation.warning_distance));
  items.add("warning_hysteresis", yamlNumber(operation.warning_hysteresis));
}

void addAddition(const SceneOperation& operation,
                 const std::function<std::string(const TriangleSoup&)>& mesh_file, YamlItems& items) {
  const SceneBody& body = operation.added.value();
  if (!body.origin || body.origin->shapes.empty()) {
    throw Error("body '" + body.name + "'", "where its shape came from is not known",
                "add it by a scene file or a service, or remove it");
  }
  items.add("frame_id", yamlText(body.frame));
  addPose(body.frame_from_body, items);
  std::vector<std::string> shapes;
  for (const BodyShape& shape : body.origin->shapes) {
    YamlItems one;
    addShape(shape, body.origin->base_folder, mesh_file, one);
    addPose(shape.frame_from_geometry, one);
    shapes.push_back(one.flow());
  }
  items.add("shapes", "[" + joinedText(shapes, ", ") + "]");
  if (body.origin->max_edge_length) items.add("max_edge_length", yamlNumber(*body.origin->max_edge_length));
  if (body.origin->chord_error) items.add("chord_error", yamlNumber(*body.origin->chord_error));
  if (body.margin != 0.0) items.add("margin", yamlNumber(body.margin));
  const Eigen::Vector4d& c = body.colour;
  if (c != SceneBody().colour) items.add("colour", yamlNumbers({c[0], c[1], c[2], c[3]}));
  if (!body.label.empty()) items.add("label", yamlText(body.label));
  addTexts("pair_with", operation.partners.names, items);
  if (operation.partners.none) items.add("without_pairs", "true");
  addTexts("touch_links", operation.partners.may_touch, items);
  addTexts("rigid_frames", operation.rigid_frames, items);
  if (operation.warning_distance) addWarning(operation, items);
}

}  // namespace

std::string sceneTextOf(const std::string& yaml) {
  return yaml.substr(0, secondDocument(yaml));
}

SceneDocuments readSceneDocuments(const std::string& yaml, const std::string& file,
                                  const std::string& base_folder) {
  SceneDocuments documents{sceneTextOf(yaml), base_folder, {}};
  if (documents.scene.size() == yaml.size()) return documents;
  // Behind as many empty lines, so that errors name its own.
  const auto lines = std::count(documents.scene.begin(), documents.scene.end(), '\n');
  const std::string rest =
      std::string(static_cast<std::size_t>(lines), '\n') + yaml.substr(documents.scene.size());
  YamlMap map(YamlValue::parse(rest, file), "a map with operations");
  if (auto v = map.take("folder")) documents.folder = v->text();
  for (const YamlValue& item : map.require("operations", "give a list").list("a list of operations"))
    documents.operations.push_back(readOperation(item));
  map.finish();
  return documents;
}

void applySaved(const std::vector<SavedOperation>& all, const std::string& base_folder,
                const SceneLoadOptions& options, Scene& scene) {
  if (all.empty()) return;
  std::vector<SceneOperation> operations;
  for (const SavedOperation& saved : all) operations.push_back(saved.operation);
  buildAdded(all, base_folder, options, scene, operations);
  const AppliedOperations applied = applyOperations(scene, operations, {});
  for (const OperationFault& fault : applied.faults) {
    const std::string& where = all[fault.operation].where;
    std::string message = nameOf(operations[fault.operation]) + " is left out: " + fault.error.what();
    if (fault.selects_nothing) {
      scene.notes.push_back(where + ": " + message);
    } else {
      scene.problems.push_back({where, std::move(message)});
    }
  }
  for (const OperationRemark& remark : applied.remarks) {
    std::vector<std::string> unknown = remark.added.unknown;
    unknown.insert(unknown.end(), remark.unknown.begin(), remark.unknown.end());
    if (!unknown.empty()) {
      scene.notes.push_back(all[remark.operation].where + ": " + nameOf(operations[remark.operation]) +
                            " names what is no body: " + joinedText(unknown, ", "));
    }
  }
}

std::string savedOperation(const SceneOperation& operation,
                           const std::function<std::string(const TriangleSoup&)>& mesh_file) {
  YamlItems items;
  for (const auto& [name, kind] : kOperationNames) {
    if (kind == operation.kind) items.add("operation", name);
  }
  const bool is_of_body = operation.pair.empty();
  items.add(is_of_body ? "body" : "pair", yamlText(is_of_body ? operation.body : operation.pair));
  switch (operation.kind) {
    case OperationKind::Add:
      addAddition(operation, mesh_file, items);
      break;
    case OperationKind::Move:
    case OperationKind::Detach:
      items.add("frame_id", yamlText(operation.frame));
      addPose(operation.frame_from_body, items);
      addTexts("switched_on", operation.switched_on, items);
      break;
    case OperationKind::Remove:
      if (operation.allow_robot_link) items.add("allow_robot_link", "true");
      break;
    case OperationKind::Attach:
      items.add("other", yamlText(operation.other));
      if (!operation.frame.empty()) items.add("frame_id", yamlText(operation.frame));
      addPose(operation.frame_from_body, items);
      addTexts("touch_links", operation.touch_links, items);
      break;
    case OperationKind::AllowContact:
    case OperationKind::DisallowContact:
      items.add("other", yamlText(operation.other));
      break;
    case OperationKind::SetMargin:
      items.add("margin", yamlNumber(operation.margin));
      break;
    case OperationKind::EnablePairs:
    case OperationKind::DisablePairs:
      break;
    case OperationKind::SetEffects:
      items.add("effects", yamlText(operation.effects_after ? effectsText(*operation.effects_after)
                                                            : operation.effects));
      break;
    case OperationKind::SetWarningDistance:
      addWarning(operation, items);
      break;
  }
  return items.flow();
}

std::string savedResource(const std::string& resource, const std::string& base_folder) {
  if (resource.find("://") != std::string::npos) return resource;
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::path(base_folder) / resource;
  return std::filesystem::absolute(path, ignored).lexically_normal().string();
}

}  // namespace concave_distance::detail
