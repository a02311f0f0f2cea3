#include "scene_truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/random_engine.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "distance/bound/certificate.h"
#include "enumeration.h"
#include "loading/query_poses.h"
#include "random_nodes.h"
#include "search/grid/body_grid.h"
#include "thesis/src/continuous/constraint_tree_file.h"
#include "thesis/src/grid/grid_nodes.h"
#include "volume_nodes.h"

namespace concave_distance::evaluation {
namespace {

/// The matrices of a mesh metric hold every node of an experiment.
constexpr std::size_t kMatrixNodeLimit = 65535;
constexpr double kRegion = 1.1;
/// Niches as near as this to the nearest are the optimum again, at another corner of the same rim.
constexpr double kTie = 1.001;
/// Niches are asked for up to this many times the distance, or this share of the smaller body, whichever is
/// more (a distance may be near 0); of the thesis's static poses without a limit.
constexpr double kMotionNicheReach = 5.0;
constexpr double kNicheReachOfBody = 0.25;

struct SceneFiles {
  const char* prefix;
  const char* a;
  const char* b;
};
constexpr SceneFiles kScenes[] = {{"boxes", "box", "notched_box"},
                                  {"cylinder", "semi_extruded", "grooved_cylinder"},
                                  {"battery", "fixture", "battery"}};

/// @param stream keeps the two bodies' random points apart
std::shared_ptr<const BodyMesh> loadBody(const std::string& path, const ExperimentScene& scene,
                                         std::uint64_t stream) {
  RepairOptions repair;
  if (!scene.thesis_scene.empty()) repair.weld_tolerance = 0.0;  // made in double precision
  BodyMeshOptions options;
  options.max_edge_length = scene.max_edge_length;
  options.matrix_node_limit = kMatrixNodeLimit;
  const std::string name = std::filesystem::path(path).stem().string();
  const auto body =
      std::make_shared<const BodyMesh>(name, repairMesh(importMesh(path), repair, path).mesh, options);
  SearchNodes nodes = makeGridNodes(body->surface(), options, name);
  if (scene.nodes == NodeSource::Volume) {
    nodes = makeVolumeNodes(*body, std::move(nodes), scene.lattice_edge.value_or(*scene.max_edge_length));
  } else if (scene.nodes != NodeSource::Mesh) {
    RandomNodesOptions random;
    random.count = nodes.graph.nodeCount();
    random.vertices_and_edges = scene.nodes == NodeSource::RandomPoints;
    RandomEngine engine(streamSeed(scene.node_seed, "random points", stream));
    nodes = makeRandomNodes(body->surface(), body->topology(), random, engine, path);
  }
  body->attach(std::make_unique<BodyGrid>(*body, std::move(nodes)));
  return body;
}

std::vector<QueryPose> posesOf(const ExperimentScene& scene, const std::string& path) {
  const std::vector<QueryPose> all = readQueryPoses(path);
  std::vector<QueryPose> chosen;
  for (std::uint32_t i = 0; i < scene.instants.count; ++i) {
    const std::size_t place = scene.instants.first + std::size_t{i} * scene.instants.step;
    if (place >= all.size()) {
      throw Error(path, "has " + std::to_string(all.size()) + " poses",
                  "scene " + scene.name + " asks for number " + std::to_string(place) + ", from 0");
    }
    chosen.push_back(all[place]);
  }
  return chosen;
}

InstantTruth truthOf(const SceneTruth& scene, const Eigen::Isometry3d& a_from_b, bool of_thesis) {
  const BodyMesh& a = *scene.a;
  const BodyMesh& b = *scene.b;
  InstantTruth truth;
  truth.a_from_b = a_from_b;
  CertificateWorkspace workspace;
  truth.exact_distance = certifyDistance(a, b, a_from_b, nullptr, 0, {}, workspace).distance;
  truth.node_distance = std::sqrt(enumerateNodePairs(a, b, a_from_b).squared_distance);
  truth.niche_cutoff = of_thesis ? std::numeric_limits<double>::infinity()
                                 : std::max(kMotionNicheReach * truth.exact_distance,
                                            kNicheReachOfBody * std::min(a.diameter(), b.diameter()));
  LocalMinimaRequest request;
  request.cutoff = truth.niche_cutoff;
  request.through_material = true;
  truth.minima = findLocalMinima(a, b, a_from_b, request).niches;
  truth.region_limit = kRegion * truth.node_distance;
  truth.exact_region_limit = kRegion * truth.exact_distance;
  for (const LocalMinimum& niche : truth.minima) {
    if (isNiche(truth, niche) && !isNearest(truth, niche.distance)) {
      truth.second_distance = std::min(truth.second_distance, niche.distance);
    }
  }
  truth.region_limit = std::min(truth.region_limit, truth.second_distance);
  truth.exact_region_limit = std::min(truth.exact_region_limit, truth.second_distance);
  return truth;
}

}  // namespace

bool isNiche(const InstantTruth& truth, const LocalMinimum& minimum) {
  return minimum.outward != Outwardness::ThroughMaterial && (minimum.visible || truth.hidden_count);
}

std::size_t nicheCount(const InstantTruth& truth) {
  return static_cast<std::size_t>(std::count_if(truth.minima.begin(), truth.minima.end(),
                                                [&](const LocalMinimum& m) { return isNiche(truth, m); }));
}

bool isNearest(const InstantTruth& truth, double distance) {
  return distance <= kTie * truth.exact_distance;
}

SceneTruth loadScene(const ExperimentScene& scene, const std::string& folder) {
  SceneTruth truth;
  std::string mesh_a = scene.mesh_a;
  std::string mesh_b = scene.mesh_b;
  std::string poses = scene.poses;
  const bool of_thesis = !scene.thesis_scene.empty();
  if (of_thesis) {
    const auto* const files = std::find_if(std::begin(kScenes), std::end(kScenes), [&](const SceneFiles& f) {
      return scene.thesis_scene.rfind(f.prefix, 0) == 0;
    });
    if (files == std::end(kScenes)) {
      throw Error("scene " + scene.thesis_scene, "is not known",
                  "name one of " + folder +
                      ": boxes_position_1, boxes_position_2, cylinder_position_1, "
                      "cylinder_position_2, battery_static; or give mesh_a, mesh_b and poses");
    }
    mesh_a = folder + "/" + files->a + ".stl";
    mesh_b = folder + "/" + files->b + ".stl";
    poses = folder + "/" + scene.thesis_scene + ".csv";
    truth.tree_a = readConstraintTreeFile(folder + "/trees/" + files->a + ".yaml");
    truth.tree_b = readConstraintTreeFile(folder + "/trees/" + files->b + ".yaml");
  }
  const std::vector<QueryPose> queries = posesOf(scene, poses);
  truth.a = loadBody(mesh_a, scene, 0);
  truth.b = loadBody(mesh_b, scene, 1);
  for (const QueryPose& query : queries) {
    const std::optional<Eigen::Isometry3d> pose = poseOf(query);
    if (!pose) throw Error(poses, "has a pose that is none", "finite numbers and a quaternion of length 1");
    truth.instants.emplace_back();
    truth.instants.back().a_from_b = *pose;
  }
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t i) {
    truth.instants[i] = truthOf(truth, truth.instants[i].a_from_b, of_thesis);
    truth.instants[i].time = queries[i].time;
  });
  return truth;
}

}  // namespace concave_distance::evaluation
