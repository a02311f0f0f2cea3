#include "saved_scene.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/content_hash.h"
#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/wording.h"
#include "mesh/import/obj_text.h"
#include "mesh/surface/primitive_table.h"
#include "robot_at_rest.h"
#include "saved_rules.h"
#include "saved_settings.h"
#include "scene/body_pool.h"
#include "select_pairs.h"
#include "yaml_text.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kMegabyte = 1'000'000;

class SceneWriter {
 public:
  SceneWriter(const Scene& scene, std::string stem, bool with_meshes)
      : scene_(scene), stem_(std::move(stem)), with_meshes_(with_meshes) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) place_of_[scene.bodies[i].serial] = i;
  }

  SavedScene write() {
    std::string text = std::string(kSavedSceneMark) + "\n";
    text += "defaults:\n" + defaults().block("  ", "  ");
    if (scene_.pool) {
      const std::size_t megabytes = scene_.pool->metricMemory()->limit() / kMegabyte;
      text += "metric_memory_limit_mb: " + yamlNumber(static_cast<double>(megabytes)) + "\n";
    }
    text += section("robots", robots()) + section("bodies", bodies()) + section("clouds", clouds()) +
            section("groups", groups());
    text += section("rigid_frames", rigidFrames()) + savedPairs(scene_) + section("disable", disabled());
    remark();
    result_.files.insert(result_.files.begin(), {stem_ + ".yaml", std::move(text)});
    return std::move(result_);
  }

 private:
  static std::string section(const std::string& key, const std::string& lines) {
    return lines.empty() ? "" : key + ":\n" + lines;
  }

  YamlItems defaults() const {
    const SceneDefaults& defaults = scene_.defaults;
    YamlItems items;
    addSettings(defaults.pairs, {}, items);
    if (defaults.max_edge_length) items.add("max_edge_length", yamlNumber(*defaults.max_edge_length));
    if (defaults.chord_error) items.add("chord_error", yamlNumber(*defaults.chord_error));
    if (!haveEqualValues(defaults.material, Material()))
      items.add("material", savedMaterial(defaults.material));
    return items;
  }

  // Robots and bodies may say this each for itself.
  void addOverDefaults(const std::optional<double>& max_edge_length, const std::optional<double>& chord_error,
                       const Material& material, YamlItems& items) const {
    if (max_edge_length != scene_.defaults.max_edge_length)
      items.add("max_edge_length", max_edge_length ? yamlNumber(*max_edge_length) : "auto");
    if (chord_error && chord_error != scene_.defaults.chord_error)
      items.add("chord_error", yamlNumber(*chord_error));
    if (!haveEqualValues(material, scene_.defaults.material)) items.add("material", savedMaterial(material));
  }

  std::string robots() const {
    std::string lines;
    for (std::size_t i = 0; scene_.named_robots && i < scene_.named_robots->size(); ++i)
      lines += robot((*scene_.named_robots)[i]).block("  - ", "    ");
    return lines;
  }

  const SceneBody* linkOf(const SceneRobot& robot, const std::string& link) const {
    const std::optional<std::size_t> body = scene_.findBody(robot.prefix + link);
    return body && scene_.bodies[*body].is_robot_link ? &scene_.bodies[*body] : nullptr;
  }

  YamlItems robot(const SceneRobot& robot) const {
    YamlItems items;
    const auto add_source = [&](const char* parameter_key, const std::string& parameter, const char* file_key,
                                const std::string& file) {
      if (!parameter.empty()) items.add(parameter_key, yamlText(parameter));
      if (!file.empty()) items.add(file_key, yamlText(savedResource(file, robot.base_folder)));
    };
    add_source("description", robot.description, "urdf", robot.urdf);
    add_source("semantic_description", robot.semantic_description, "srdf", robot.srdf);
    if (!robot.name.empty()) items.add("name", yamlText(robot.name));
    if (!robot.prefix.empty()) items.add("prefix", yamlText(robot.prefix));
    items.add("geometry", robot.geometry == GeometrySource::Collision ? "collision" : "visual");
    std::vector<std::string> skipped = robot.skip_links;
    YamlItems own;
    for (const std::string& link : robot.links) {
      const SceneBody* body = linkOf(robot, link);
      if (body == nullptr) {
        // One that could not be loaded is tried again.
        if (scene_.loaded && scene_.loaded->findBody(robot.prefix + link)) skipped.push_back(link);
        continue;
      }
      YamlItems of_link;
      if (body->margin != robot.margin) of_link.add("margin", yamlNumber(body->margin));
      if (body->pairLabel() != bodyLabel(body->name)) of_link.add("label", yamlText(body->pairLabel()));
      if (!of_link.empty()) own.add(yamlText(link), of_link.flow());
    }
    if (!skipped.empty()) items.add("skip_links", yamlTexts(skipped));
    if (robot.margin != 0.0) items.add("margin", yamlNumber(robot.margin));
    if (!own.empty()) items.add("links", own.flow());
    addOverDefaults(robot.max_edge_length, robot.chord_error, robot.material, items);
    return items;
  }

  std::string bodies() {
    std::string lines;
    for (const SceneBody& body : scene_.bodies) {
      if (!body.is_robot_link && !body.cloud) lines += this->body(body).block("  - ", "    ");
    }
    return lines;
  }

  std::string clouds() const {
    std::string lines;
    for (const SceneBody& body : scene_.bodies) {
      if (body.cloud) lines += savedCloud(body).block("  - ", "    ");
    }
    return lines;
  }

  YamlItems savedCloud(const SceneBody& body) const {
    const CloudSettings& settings = *body.cloud->settings;
    YamlItems items;
    items.add("name", yamlText(body.name));
    items.add("topic", yamlText(settings.topic));
    items.add("frame", yamlText(body.frame));
    items.add("voxel_size", yamlNumber(settings.voxel_size));
    items.add("range", yamlNumber(settings.range));
    items.add("rate", yamlNumber(settings.rate));
    items.add("stale_after", yamlNumber(settings.stale_after));
    items.add("padding", yamlNumber(settings.padding));
    if (!settings.leave_out.empty()) items.add("leave_out", yamlTexts(settings.leave_out));
    if (settings.niches) items.add("niches", "true");
    items.add("largest_voxel_count", std::to_string(settings.largest_voxel_count));
    addLooks(body, items);
    return items;
  }

  void addLooks(const SceneBody& body, YamlItems& items) const {
    if (body.margin != 0.0) items.add("margin", yamlNumber(body.margin));
    if (body.colour != SceneBody().colour) {
      const Eigen::Vector4d& c = body.colour;
      items.add("colour", yamlNumbers({c[0], c[1], c[2], c[3]}));
    }
    if (body.pairLabel() != bodyLabel(body.name)) items.add("label", yamlText(body.pairLabel()));
  }

  YamlItems body(const SceneBody& body) {
    if (!body.origin || body.origin->shapes.empty()) {
      throw Error("body '" + body.name + "'", "where its shape came from is not known",
                  "add it by a scene file or a service, or remove it");
    }
    YamlItems items;
    items.add("name", yamlText(body.name));
    items.add("frame", yamlText(body.frame));
    const std::vector<BodyShape>& shapes = body.origin->shapes;
    if (shapes.size() == 1) {
      addShape(shapes.front(), body.origin->base_folder, items);
    } else {
      std::vector<std::string> all;
      for (const BodyShape& shape : shapes) {
        YamlItems one;
        addShape(shape, body.origin->base_folder, one);
        all.push_back(one.flow());
      }
      items.add("shapes", "[" + joinedText(all, ", ") + "]");
    }
    if (body.frame_from_body.matrix() != Eigen::Matrix4d::Identity())
      items.add("placed", yamlPose(body.frame_from_body));
    const bool is_moved = (body.attachment ? body.attachment->carrier_before : body.carrier) == body.serial;
    if (is_moved) items.add("moved", "true");
    if (body.attachment) items.add("attached", attachment(*body.attachment));
    if (body.added_rule) {
      YamlItems rule;
      rule.add(body.added_rule->all ? "all_but" : "only", yamlTexts(namesOf(body.added_rule->bodies)));
      items.add("added", rule.flow());
    }
    addLooks(body, items);
    addOverDefaults(body.origin->max_edge_length, body.origin->chord_error, body.material, items);
    return items;
  }

  void addShape(const BodyShape& shape, const std::string& base_folder, YamlItems& items) {
    if (const Primitive* primitive = findPrimitive(shape.primitive)) {
      YamlItems sizes;
      std::size_t at = 0;
      for (const Primitive::Size& size : primitive->sizes) {
        const std::vector<double> numbers(
            shape.dimensions.begin() + static_cast<std::ptrdiff_t>(at),
            shape.dimensions.begin() + static_cast<std::ptrdiff_t>(at + size.count));
        sizes.add(size.key, size.count == 1 ? yamlNumber(numbers.front()) : yamlNumbers(numbers));
        at += size.count;
      }
      items.add(shape.primitive, sizes.flow());
    } else {
      items.add("mesh", yamlText(shape.triangles ? meshFile(*shape.triangles)
                                                 : savedResource(shape.mesh_resource, base_folder)));
      const Eigen::Vector3d& s = shape.scale;
      if (s != Eigen::Vector3d::Ones()) items.add("scale", yamlNumbers({s.x(), s.y(), s.z()}));
    }
    if (shape.frame_from_geometry.matrix() != Eigen::Matrix4d::Identity())
      items.add("pose", yamlPose(shape.frame_from_geometry));
  }

  // One file for equal meshes.
  std::string meshFile(const TriangleSoup& soup) {
    std::string text = objText(soup);
    std::string name = stem_ + "_" + hashBytes(text.data(), text.size()).text() + ".obj";
    bool is_new = with_meshes_;
    for (const SavedFile& file : result_.files) is_new = is_new && file.name != name;
    if (is_new) result_.files.push_back({name, std::move(text)});
    return name;
  }

  std::vector<std::string> namesOf(const std::unordered_set<std::uint64_t>& serials) const {
    std::vector<std::string> names;
    for (const SceneBody& body : scene_.bodies) {
      if (serials.count(body.serial) != 0) names.push_back(body.name);
    }
    return names;
  }

  std::string attachment(const Attachment& attachment) const {
    YamlItems items;
    items.add("to", yamlText(attachment.parent));
    if (const auto touched = namesOf(attachment.may_touch); !touched.empty())
      items.add("touch_links", yamlTexts(touched));
    std::vector<std::string> switched_off;
    for (const std::string& pair : attachment.switched_off) {
      if (scene_.pairs.find(pair)) switched_off.push_back(pair);
    }
    if (!switched_off.empty()) items.add("switched_off", yamlTexts(switched_off));
    return items.flow();
  }

  std::string groups() const {
    std::string lines;
    for (const auto& [name, members] : scene_.groups) {
      if (scene_.groups_of_robots.count(name) != 0) continue;
      std::vector<std::string> present;
      for (const std::string& member : members) {
        if (scene_.findBody(member)) present.push_back(member);
      }
      lines += "  " + yamlText(name) + ": " + yamlTexts(present) + "\n";
    }
    return lines;
  }

  std::string rigidFrames() const {
    std::string lines;
    for (const auto& [a, b] : scene_.joined_by_tf) lines += "  - " + yamlTexts({a, b}) + "\n";
    return lines;
  }

  std::string disabled() const {
    std::string lines;
    for (const auto& [a, b] : scene_.overlapping) {
      const auto body_a = place_of_.find(a);
      const auto body_b = place_of_.find(b);
      if (body_a == place_of_.end() || body_b == place_of_.end()) continue;
      if (scene_.pairs.find(body_a->second, body_b->second)) continue;
      lines +=
          "  - " + yamlTexts({scene_.bodies[body_a->second].name, scene_.bodies[body_b->second].name}) + "\n";
    }
    return lines;
  }

  void remark() {
    std::vector<std::string>& remarks = result_.remarks;
    if (!scene_.problems.empty()) {
      remarks.push_back(counted(scene_.problems.size(), "part") +
                        " could not be loaded (list_bodies has them): bodies among them are not in the file");
    }
    if (scene_.simulation)
      remarks.emplace_back("the section 'simulation' is not in the file: add it by hand");
    if (!std::isfinite(scene_.defaults.pairs.tracker.cutoff) && countRuledPairs(scene_) > kFewPairs) {
      remarks.push_back("it has more than " + std::to_string(kFewPairs) +
                        " pairs and no cutoff: loading the file gives it one (set cutoff in defaults)");
    }
  }

  const Scene& scene_;
  std::string stem_;
  bool with_meshes_;
  std::unordered_map<std::uint64_t, std::size_t> place_of_;  ///< by serial
  SavedScene result_;
};

}  // namespace

std::string savedResource(const std::string& resource, const std::string& base_folder) {
  if (resource.find("://") != std::string::npos) return resource;
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::path(base_folder) / resource;
  return std::filesystem::absolute(path, ignored).lexically_normal().string();
}

SavedScene savedScene(const Scene& scene, const std::string& stem, bool with_meshes) {
  return SceneWriter(scene, stem, with_meshes).write();
}

}  // namespace concave_distance::detail
