#include "scene_truth.h"

#include <algorithm>
#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/continuous/constraint_tree_file.h"
#include "concave_distance/distance/certificate.h"
#include "concave_distance/distance/enumeration.h"
#include "concave_distance/mesh/import_mesh.h"
#include "concave_distance/mesh/repair_mesh.h"
#include "query_poses.h"

namespace concave_distance::evaluation {
namespace {

constexpr double kRegion = 1.1;
/// Niches as near as this to the nearest are the optimum again, at another corner of the same rim.
constexpr double kTie = 1.001;
/// Niches up to this many times the distance are asked for (the battery's nine reach 5.3 times).
constexpr double kNicheReach = 6.0;

struct SceneFiles {
  const char* prefix;
  const char* a;
  const char* b;
};
constexpr SceneFiles kScenes[] = {{"boxes", "box", "notched_box"},
                                  {"cylinder", "semi_extruded", "grooved_cylinder"},
                                  {"battery", "fixture", "battery"}};

std::shared_ptr<const BodyMesh> loadBody(const std::string& folder, const std::string& name, double edge) {
  const std::string path = folder + "/" + name + ".stl";
  BodyMeshOptions options;
  options.max_edge_length = edge;
  return std::make_shared<const BodyMesh>(name, repairMesh(importMesh(path), {}, path).mesh, options);
}

}  // namespace

SceneTruth loadScene(const ExperimentScene& scene, const std::string& folder) {
  const auto* const files = std::find_if(std::begin(kScenes), std::end(kScenes), [&](const SceneFiles& f) {
    return scene.name.rfind(f.prefix, 0) == 0;
  });
  if (files == std::end(kScenes)) {
    throw Error("scene " + scene.name, "is not known",
                "name one of " + folder +
                    ": boxes_position_1, boxes_position_2, cylinder_position_1, "
                    "cylinder_position_2, battery_static");
  }
  SceneTruth truth;
  truth.a = loadBody(folder, files->a, scene.max_edge_length);
  truth.b = loadBody(folder, files->b, scene.max_edge_length);
  const std::string poses = folder + "/" + scene.name + ".csv";
  const std::vector<tools::QueryPose> queries = tools::readQueryPoses(poses);
  const std::optional<Eigen::Isometry3d> pose =
      queries.empty() ? std::nullopt : tools::poseOf(queries.front());
  if (!pose) throw Error(poses, "has no pose", "a line t,x,y,z,qx,qy,qz,qw below the header");
  truth.a_from_b = *pose;

  CertificateWorkspace workspace;
  truth.exact_distance =
      certifyDistance(*truth.a, *truth.b, truth.a_from_b, nullptr, 0, {}, workspace).distance;
  truth.node_distance = std::sqrt(enumerateNodePairs(*truth.a, *truth.b, truth.a_from_b).squared_distance);
  truth.niche_cutoff = kNicheReach * truth.exact_distance;
  LocalMinimaRequest request;
  request.cutoff = truth.niche_cutoff;
  truth.niches = findLocalMinima(*truth.a, *truth.b, truth.a_from_b, request);
  truth.region_limit = kRegion * truth.node_distance;
  truth.exact_region_limit = kRegion * truth.exact_distance;
  for (const LocalMinimum& niche : truth.niches.niches) {
    if (niche.distance > kTie * truth.exact_distance) {
      truth.second_distance = std::min(truth.second_distance, niche.distance);
    }
  }
  truth.region_limit = std::min(truth.region_limit, truth.second_distance);
  truth.exact_region_limit = std::min(truth.exact_region_limit, truth.second_distance);
  truth.tree_a = readConstraintTreeFile(folder + "/trees/" + files->a + ".yaml");
  truth.tree_b = readConstraintTreeFile(folder + "/trees/" + files->b + ".yaml");
  return truth;
}

}  // namespace concave_distance::evaluation
