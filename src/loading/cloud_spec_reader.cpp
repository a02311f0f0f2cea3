#include "cloud_spec_reader.h"

#include <cmath>
#include <memory>
#include <utility>

#include "body_spec_reader.h"
#include "kinematics/frame_name.h"

namespace concave_distance::detail {
namespace {

constexpr double kDefaultVoxelSize = 0.05;  // m
constexpr double kLeastVoxelSize = 1e-4;    // m
constexpr double kLargestVoxelSize = 10.0;  // m
constexpr double kLargestPadding = 10.0;    // m
constexpr double kLargestRate = 1000.0;     // Hz
constexpr std::size_t kMostVoxels = 1'000'000;

double readWithin(const YamlValue& value, double least, double most, const std::string& allowed) {
  return value.number(allowed, [&](double number) { return number >= least && number <= most; });
}

double readPositive(const YamlValue& value, const std::string& allowed) {
  return value.number(allowed, [](double number) { return number > 0.0; });
}

CloudSettings readSettings(YamlMap& map) {
  CloudSettings settings;
  settings.topic = map.require("topic", "name the topic of the cloud or map").text();
  settings.voxel_size = kDefaultVoxelSize;
  if (auto v = map.take("voxel_size"))
    settings.voxel_size = readWithin(*v, kLeastVoxelSize, kLargestVoxelSize, "0.0001 to 10, metres");
  if (auto v = map.take("range")) settings.range = readPositive(*v, "a positive number, metres, or .inf");
  if (auto v = map.take("rate")) {
    settings.rate = v->number("above 0, at most 1000, Hz",
                              [](double rate) { return rate > 0.0 && rate <= kLargestRate; });
  }
  if (auto v = map.take("stale_after"))
    settings.stale_after = readPositive(*v, "a positive number, seconds, or .inf");
  if (auto v = map.take("padding"))
    settings.padding = readWithin(*v, 0.0, kLargestPadding, "0 to 10, metres");
  if (auto v = map.take("leave_out")) {
    for (const YamlValue& item : v->list("a list of bodies, groups and patterns"))
      settings.leave_out.push_back(item.text());
  }
  if (auto v = map.take("niches")) settings.niches = v->boolean();
  if (auto v = map.take("largest_voxel_count"))
    settings.largest_voxel_count = v->count(1, kMostVoxels, "voxels");
  return settings;
}

}  // namespace

BodySpec readCloudSpec(const YamlValue& value) {
  YamlMap map(value, "a map with name, topic and frame");
  BodySpec body;
  body.where = value.where();
  BodyDescription& description = body.description;
  const YamlValue name = map.require("name", "give every cloud a name");
  description.name = readPlainText(name);
  const YamlValue frame =
      map.require("frame", "name the tf frame in which the voxels stand, such as the robot's base");
  description.frame = requireFrameName(frame.text(), frame.where());
  const CloudSettings settings = readSettings(map);
  // One voxel stands for the cloud until it comes.
  description.primitive = "box";
  description.dimensions.assign(3, settings.voxel_size);
  CloudState state;
  state.settings = std::make_shared<const CloudSettings>(settings);
  state.voxel_size = settings.voxel_size;
  body.cloud = std::make_shared<const CloudState>(std::move(state));
  readLooks(map, body);
  map.finish();
  return body;
}

}  // namespace concave_distance::detail
