#include "benchmark/support/accuracy_pairs.h"

#include <algorithm>
#include <filesystem>

#include "benchmark/support/circling_pair.h"
#include "benchmark/support/shapes.h"

namespace concave_distance::benchmark {
namespace {

struct HeldOutFiles {
  const char* name;
  const char* a;
  const char* b;
};
constexpr HeldOutFiles kHeldOut[] = {
    {"atlas_hand_torso", "sdf/atlas/l_hand.stl", "sdf/atlas/utorso.stl"},
    {"atlas_foot_shin", "sdf/atlas/r_foot.stl", "sdf/atlas/l_lleg.stl"},
    {"atlas_pelvis_forearm", "sdf/atlas/pelvis.stl", "sdf/atlas/l_farm.stl"},
    {"atlas_head_clavicle", "sdf/atlas/head.stl", "sdf/atlas/r_clav.stl"},
    {"fetch_gripper_forearm", "mjcf/openai/robotics/stls/fetch/gripper_link.stl",
     "mjcf/openai/robotics/stls/fetch/forearm_roll_link_collision.stl"},
    {"fetch_base_elbow", "mjcf/openai/robotics/stls/fetch/base_link_collision.stl",
     "mjcf/openai/robotics/stls/fetch/elbow_flex_link_collision.stl"}};

std::string dartFile(const char* file) {
  return std::string("/usr/share/doc/dart/data/") + file;
}

const HeldOutFiles* findHeldOut(const std::string& name) {
  const auto* const found = std::find_if(std::begin(kHeldOut), std::end(kHeldOut),
                                         [&](const HeldOutFiles& files) { return name == files.name; });
  return found == std::end(kHeldOut) ? nullptr : found;
}

BenchmarkPair makeRings() {
  const SurfaceMesh surface = makeBumpyRing(100000);
  BenchmarkPair pair;
  pair.name = "rings_100k";
  pair.a = std::make_shared<const BodyMesh>("a", surface, BodyMeshOptions());
  pair.b = std::make_shared<const BodyMesh>("b", surface, BodyMeshOptions());
  pair.fcl_a = pair.fcl_b = makeFclModel(surface);
  pair.motion = ringPassingBy;
  return pair;
}

}  // namespace

std::vector<std::string> accuracyPairs() {
  return {"notched_boxes",  "grooved_cylinder", "battery_insertion",
          "kr5_bicep_palm", "wam1_wam6",        "rings_100k"};
}

std::vector<std::string> heldOutPairs() {
  std::vector<std::string> names;
  for (const HeldOutFiles& files : kHeldOut) names.emplace_back(files.name);
  return names;
}

bool isHeldOut(const std::string& name) {
  return findHeldOut(name) != nullptr;
}

bool isInstalled(const std::string& name) {
  const HeldOutFiles* const files = findHeldOut(name);
  return files != nullptr && std::filesystem::exists(dartFile(files->a)) &&
         std::filesystem::exists(dartFile(files->b));
}

BenchmarkPair loadAccuracyPair(const std::string& name, std::optional<double> max_edge_length) {
  if (const HeldOutFiles* const files = findHeldOut(name)) {
    return makeCirclingPair(name, dartFile(files->a), dartFile(files->b), max_edge_length);
  }
  return name == "rings_100k" ? makeRings() : loadBenchmarkPair(name, max_edge_length);
}

}  // namespace concave_distance::benchmark
