#include "benchmark/support/sphere_tree.h"

#include <algorithm>
#include <numeric>

namespace concave_distance::benchmark {

SphereTree::SphereTree(const SurfaceMesh& surface) {
  std::vector<std::uint32_t> order(surface.triangleCount());
  std::iota(order.begin(), order.end(), 0U);
  for (const TriangleNodes& t : surface.triangles()) {
    centroids_.push_back((surface.vertex(t[0]) + surface.vertex(t[1]) + surface.vertex(t[2])) / 3.0);
  }
  nodes_.reserve(2 * order.size());
  build(surface, order.data(), order.data() + order.size());
}

void SphereTree::build(const SurfaceMesh& surface, std::uint32_t* begin, std::uint32_t* end) {
  const std::size_t self = nodes_.size();
  nodes_.emplace_back();
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centroid_box;
  for (const std::uint32_t* t = begin; t != end; ++t) {
    for (int k = 0; k < 3; ++k) box.extend(surface.corner(TriangleIndex{*t}, k));
    centroid_box.extend(centroids_[*t]);
  }
  Node node;
  node.centre = box.center();
  for (const std::uint32_t* t = begin; t != end; ++t) {
    for (int k = 0; k < 3; ++k) {
      node.radius = std::max(node.radius, (surface.corner(TriangleIndex{*t}, k) - node.centre).norm());
    }
  }
  node.radius *= 1.0 + 1e-12;
  if (end - begin == 1) {
    node.triangle = *begin;
    nodes_[self] = node;
    return;
  }
  Eigen::Index axis = 0;
  centroid_box.sizes().maxCoeff(&axis);
  std::uint32_t* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](std::uint32_t l, std::uint32_t r) {
    return centroids_[l][axis] < centroids_[r][axis];
  });
  build(surface, begin, middle);
  node.second = static_cast<std::uint32_t>(nodes_.size());
  build(surface, middle, end);
  nodes_[self] = node;
}

void SphereTree::forEachPairWithin(const SphereTree& a, const SphereTree& b,
                                   const Eigen::Isometry3d& a_from_b, double limit,
                                   const std::function<double(std::uint32_t, std::uint32_t)>& visit) {
  std::vector<Eigen::Vector3d> centres_b;
  centres_b.reserve(b.nodes_.size());
  for (const Node& node : b.nodes_) centres_b.push_back(a_from_b * node.centre);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open = {{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const Node& node_a = a.nodes_[i];
    const Node& node_b = b.nodes_[j];
    if ((centres_b[j] - node_a.centre).norm() * (1.0 + 1e-12) - node_a.radius - node_b.radius > limit)
      continue;
    if (node_a.second == 0 && node_b.second == 0) {
      limit = visit(node_a.triangle, node_b.triangle);
    } else if (node_b.second == 0 || (node_a.second != 0 && node_a.radius > node_b.radius)) {
      open.emplace_back(i + 1, j);
      open.emplace_back(node_a.second, j);
    } else {
      open.emplace_back(i, j + 1);
      open.emplace_back(i, node_b.second);
    }
  }
}

}  // namespace concave_distance::benchmark
