#include "pair_record_reader.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "base/csv_table.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "effects_reader.h"
#include "query_poses.h"
#include "record_answers.h"
#include "settings_reader.h"
#include "shape_reader.h"

namespace concave_distance::detail {
namespace {

constexpr std::uintmax_t kMostFacts = 1'000'000;    // bytes of record.yaml
constexpr std::uintmax_t kMostTable = 256'000'000;  // of each table
constexpr std::uint64_t kMostNodes = 1'000'000'000;
constexpr const char* kRemedy = "the recording is damaged: ask for it once more, or mend the file";

constexpr std::pair<const char*, RoundKind> kKinds[] = {
    {"sphere", RoundKind::Sphere}, {"capsule", RoundKind::Capsule}, {"cylinder", RoundKind::Cylinder}};

void requireFile(const std::string& path, std::uintmax_t most) {
  requireReadableFile(path);
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) throw Error(path, "the file is missing", "name the folder of a whole recording");
  if (size > most) {
    throw Error(path, "it has " + std::to_string(size) + " bytes",
                "a recording has at most " + std::to_string(most) + " in this file");
  }
}

std::string readText(const std::string& path, std::uintmax_t most) {
  requireFile(path, most);
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw Error(path, "the file cannot be read", "check its permissions");
  return text;
}

RoundShape readShape(const YamlValue& value) {
  YamlMap map(value, "a map with kind and radius");
  RoundShape shape;
  shape.kind = map.require("kind", kRemedy).choice(kKinds);
  shape.radius = readLength(map.require("radius", kRemedy));
  shape.half_length = readLengthOrZero(map.require("half_length", kRemedy));
  shape.chord_error = readLength(map.require("chord_error", kRemedy));
  shape.body_from_shape = readPose(map.require("pose", kRemedy));
  map.finish();
  return shape;
}

void readGrid(const YamlValue& value, BodyMeshOptions& options) {
  YamlMap map(value, "a map of the limits of the search's grid");
  options.max_edge_length = readEdgeLength(map.require("max_edge_length", kRemedy));
  options.search_node_limit = map.require("search_node_limit", kRemedy).count(1, kMostNodes);
  options.largest_node_count = map.require("largest_node_count", kRemedy).count(1, kMostNodes);
  options.matrix_node_limit = map.require("matrix_node_limit", kRemedy).count(0, 65535);
  map.finish();
}

SurfaceMesh readSurface(const std::string& path, std::uint64_t vertices, std::uint64_t triangles) {
  requireFile(path, 2 * kMostTable);
  TriangleSoup soup = importMesh(path);
  if (soup.vertices.size() != vertices || soup.triangles.size() != triangles) {
    throw Error(path,
                "it has " + std::to_string(soup.vertices.size()) + " vertices and " +
                    std::to_string(soup.triangles.size()) + " triangles of " + std::to_string(vertices) +
                    " and " + std::to_string(triangles) + " that were recorded",
                kRemedy);
  }
  std::vector<TriangleNodes> corners;
  corners.reserve(soup.triangles.size());
  for (const auto& t : soup.triangles) corners.push_back({NodeIndex{t[0]}, NodeIndex{t[1]}, NodeIndex{t[2]}});
  return SurfaceMesh(std::move(soup.vertices), std::move(corners), path);
}

std::shared_ptr<const SceneBody> readBody(const YamlValue& value, const std::string& mesh_path) {
  YamlMap map(value, "a map with name, vertices, triangles, margin and grid");
  SceneBody body;
  body.name = map.require("name", kRemedy).text();
  const std::uint64_t vertices = map.require("vertices", kRemedy).count(1, kMostNodes);
  const std::uint64_t triangles = map.require("triangles", kRemedy).count(1, kMostNodes);
  body.margin = readLengthOrZero(map.require("margin", kRemedy));
  BodyMeshOptions options;
  readGrid(map.require("grid", kRemedy), options);
  if (const auto shape = map.take("shape")) {
    options.shape = readShape(*shape);
    options.shape->validate(shape->where());
  }
  if (const auto material = map.take("material")) body.material = readMaterial(*material, {});
  map.finish();
  SurfaceMesh surface = readSurface(mesh_path, vertices, triangles);
  body.mesh = std::make_shared<const BodyMesh>(body.name, std::move(surface), options);
  body.bounds = boundsOf(*body.mesh);
  return std::make_shared<const SceneBody>(std::move(body));
}

std::shared_ptr<const ScenePair> readPair(const YamlValue& name, const YamlValue& settings) {
  auto pair = std::make_shared<ScenePair>();
  pair->name = name.text();
  pair->body_b = 1;
  YamlMap map(settings, "a map of a pair's settings");
  readPairSettings(map, pair->settings);
  map.finish();
  validatePairSettings(pair->settings, settings.where());
  return pair;
}

std::vector<TimedPose> readPoses(const std::string& path, std::uint64_t count) {
  requireFile(path, kMostTable);
  std::vector<TimedPose> poses;
  for (const QueryPose& query : readQueryPoses(path)) {
    const std::string where = path + ", pose " + std::to_string(poses.size());
    if (!query.rotation)
      throw Error(path + ":1", "its rotations are quaternions",
                  std::string("a recording has ") + kMatrixPoseHeader);
    if (!query.position.allFinite() || !query.rotation->allFinite())
      throw Error(where, "it has a number that is not finite", kRemedy);
    if (!poses.empty() && query.time < poses.back().time)
      throw Error(where, "its time is before that of the one before", kRemedy);
    TimedPose& pose = poses.emplace_back();
    pose.time = query.time;
    pose.pose.linear() = *query.rotation;
    pose.pose.translation() = query.position;
  }
  if (poses.size() == count) return poses;
  throw Error(
      path,
      "it has " + std::to_string(poses.size()) + " poses of " + std::to_string(count) + " that were recorded",
      kRemedy);
}

}  // namespace

LoadedRecord loadRecord(const std::string& folder) {
  const auto path_of = [&](const char* file) { return (std::filesystem::path(folder) / file).string(); };
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw Error(folder, "there is no such folder", "name the folder that record_pair has written");
  const std::string facts = path_of(kRecordFile);
  YamlMap map(YamlValue::parse(readText(facts, kMostFacts), facts), "a map with format, pair, a and b");
  const YamlValue format = map.require("format", kRemedy);
  if (format.count(0, kMostNodes) != 1)
    format.fail("it is format " + format.seen(), "use distance_query of the version that wrote it");
  LoadedRecord loaded;
  const YamlMap versions(map.require("versions", kRemedy), "a map from a part to its version");
  for (const auto& [part, version] : versions.entries()) loaded.versions.emplace_back(part, version.text());
  const std::uint64_t poses = map.require("poses", kRemedy).count(1, kMostRecordPoses);
  loaded.answers.count = map.require("answered", kRemedy).count(0, poses);
  loaded.record.with_niches = map.require("with_niches", kRemedy).boolean();
  map.take("epoch");
  const YamlValue pair = map.require("pair", kRemedy);
  const YamlValue a = map.require("a", kRemedy);
  const YamlValue b = map.require("b", kRemedy);
  const YamlValue settings = map.require("settings", kRemedy);
  map.finish();
  loaded.record.pair = readPair(pair, settings);
  loaded.record.poses = readPoses(path_of(kRecordPoses), poses);
  loaded.answers.answers = readText(path_of(kRecordAnswers), kMostTable);
  if (loaded.record.with_niches) loaded.answers.niches = readText(path_of(kRecordNiches), kMostTable);
  requireWhole(folder, loaded.answers);
  loaded.record.body_a = readBody(a, path_of(kRecordMeshes[0]));
  loaded.record.body_b = readBody(b, path_of(kRecordMeshes[1]));
  return loaded;
}

}  // namespace concave_distance::detail
