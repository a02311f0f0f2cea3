#include "optimum_basin.h"

#include <cmath>
#include <vector>

#include "search/grid/body_grid.h"
#include "surface_regions.h"
#include "thesis/src/genetic/descent_moves.h"

namespace concave_distance::evaluation {
namespace {

NodeIndex nearestNode(const BodyMesh& body, const Eigen::Vector3d& point) {
  const std::vector<Eigen::Vector3d>& nodes = gridOf(body).nodes().graph.positions;
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if ((nodes[i] - point).squaredNorm() < (nodes[nearest] - point).squaredNorm()) nearest = i;
  }
  return NodeIndex{nearest};
}

}  // namespace

bool leadsToOptimum(const SceneTruth& scene, const TrialPoint& answer) {
  const InstantTruth& truth = scene.first();
  const PairObjective objective(*scene.a, *scene.b, truth.a_from_b);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  const TrialPoint end = descendBy(DescentMoves::BothNodes, objective, answer, nullptr, trail, cost);
  const double distance = std::sqrt(end.squared_distance);
  if (distance < truth.region_limit) return true;
  const SurfaceRegions regions(*scene.a, *scene.b, truth.a_from_b, truth.minima);
  const std::size_t owner =
      regions.ownerOf({gridOf(*scene.a).nodes().originalTriangle(end.node_a),
                       gridOf(*scene.b).nodes().originalTriangle(end.node_b), distance});
  return owner != SurfaceRegions::kNoOwner && isNiche(truth, truth.minima[owner]) &&
         isNearest(truth, truth.minima[owner].distance);
}

bool leadsToOptimum(const SceneTruth& scene, const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b) {
  return leadsToOptimum(scene,
                        TrialPoint{nearestNode(*scene.a, point_a), nearestNode(*scene.b, point_b), 0.0});
}

}  // namespace concave_distance::evaluation
