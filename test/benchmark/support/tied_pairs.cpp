#include "benchmark/support/tied_pairs.h"

#include <algorithm>
#include <cmath>

#include "benchmark/support/stopwatch.h"
#include "distance/kernels/triangle_distance.h"

namespace concave_distance::benchmark {
namespace {

TrianglePoints cornersOf(const SurfaceMesh& mesh, TriangleIndex t, const Eigen::Isometry3d& pose) {
  return {pose * mesh.corner(t, 0), pose * mesh.corner(t, 1), pose * mesh.corner(t, 2)};
}

Eigen::AlignedBox3d movedBox(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d centre = pose * box.center();
  const Eigen::Vector3d half = 0.5 * (pose.linear().cwiseAbs() * box.sizes());
  return {centre - half, centre + half};
}

}  // namespace

std::vector<TrianglePair> pairsWithin(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                      double distance) {
  std::vector<TrianglePair> pairs;
  const TriangleTree& tree_a = a.tree();
  const TriangleTree& tree_b = b.tree();
  // Boxes round at the coordinates' size.
  const double reach = distance + 1e-12 * proofScale(a, b, a_from_b);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0U, 0U}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const TriangleTree::Node& node_a = tree_a.nodes()[i];
    const TriangleTree::Node& node_b = tree_b.nodes()[j];
    if (node_a.box.squaredExteriorDistance(movedBox(node_b.box, a_from_b)) > reach * reach) continue;
    if (node_a.count == 0 && (node_b.count > 0 || node_a.box.sizes().sum() >= node_b.box.sizes().sum())) {
      open.emplace_back(i + 1, j);
      open.emplace_back(node_a.first, j);
    } else if (node_b.count == 0) {
      open.emplace_back(i, j + 1);
      open.emplace_back(i, node_b.first);
    } else {
      for (std::uint32_t k = node_a.first; k < node_a.first + node_a.count; ++k) {
        const TrianglePoints of_a = cornersOf(a.surface(), tree_a.order()[k], Eigen::Isometry3d::Identity());
        for (std::uint32_t l = node_b.first; l < node_b.first + node_b.count; ++l) {
          const TrianglePoints of_b = cornersOf(b.surface(), tree_b.order()[l], a_from_b);
          if (triangleDistance(of_a, of_b).squared_distance <= distance * distance) {
            pairs.push_back({tree_a.order()[k], tree_b.order()[l]});
          }
        }
      }
    }
  }
  return pairs;
}

ProofLimit proofLimit(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                      double distance) {
  const double error = kProofError * proofScale(a, b, a_from_b);
  const std::vector<TrianglePair> ties = pairsWithin(a, b, a_from_b, distance + 2.0 * error);
  std::vector<std::pair<TrianglePoints, TrianglePoints>> corners;
  corners.reserve(ties.size());
  for (const TrianglePair& pair : ties) {
    corners.emplace_back(cornersOf(a.surface(), pair.a, Eigen::Isometry3d::Identity()),
                         cornersOf(b.surface(), pair.b, a_from_b));
  }
  if (corners.empty()) return {0.0, 0.0};
  // Often enough for the clock.
  const std::size_t rounds = std::max<std::size_t>(1, 64 / corners.size());
  double sum = 0.0;
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t round = 0; round < rounds; ++round) {
    for (const auto& [of_a, of_b] : corners) sum += triangleDistance(of_a, of_b).squared_distance;
  }
  const double taken = microsecondsSince(start) / static_cast<double>(rounds);
  return {static_cast<double>(corners.size()), std::isfinite(sum) ? taken : std::nan("")};
}

}  // namespace concave_distance::benchmark
