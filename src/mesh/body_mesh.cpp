#include "concave_distance/mesh/body_mesh.h"

#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/geodesic_extent.h"
#include "concave_distance/mesh/thin_graph.h"

namespace concave_distance {
namespace {

// Nodes that the automatic grid aims at when the mesh itself has fewer.
constexpr double kTargetNodeCount = 650.0;
// Nodes along the diameter at the most: edges are divided too, and a needle has next to no area.
constexpr double kMostNodesAlong = kTargetNodeCount / 4.0;

double edgeLengthOf(const std::string& name, const SurfaceMesh& surface, const BodyMeshOptions& options) {
  if (!options.max_edge_length) {
    return automaticEdgeLength(surface);
  }
  const double length = *options.max_edge_length;
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw Error(name, "max_edge_length is " + std::to_string(length),
                "give a positive, finite length in metres or leave it out");
  }
  return length;
}

}  // namespace

double automaticEdgeLength(const SurfaceMesh& surface) {
  double area = 0.0;
  for (const TriangleNodes& t : surface.triangles()) {
    area += 0.5 * (surface.vertex(t[1]) - surface.vertex(t[0]))
                      .cross(surface.vertex(t[2]) - surface.vertex(t[0]))
                      .norm();
  }
  // makeSearchGrid spends 1.3 to 1.5 nodes on a squared edge length of area; a body that is long and thin
  // would get edges longer than it is thick, hence the second term.
  const double length = std::min(std::sqrt(1.5 * area / kTargetNodeCount), surface.diameter() / 8.0);
  return std::max(length, surface.diameter() / kMostNodesAlong);
}

BodyMesh::BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options)
    : name_(std::move(name)),
      surface_(std::move(surface)),
      topology_(buildMeshTopology(surface_)),
      tree_(surface_),
      hierarchy_(surface_, tree_),
      max_edge_length_(edgeLengthOf(name_, surface_, options)),
      grid_(makeSearchGrid(surface_, max_edge_length_)),
      graph_(buildNodeGraph(grid_.mesh)),
      geodesic_extent_(0.0),
      protrusion_spacing_(0.0) {
  if (!options.max_edge_length && graph_.nodeCount() > options.search_node_limit) {
    ThinnedGraph thinned = thinGraph(graph_, options.search_node_limit);
    for (const NodeIndex node : thinned.original_node) {
      original_triangle_of_node_.push_back(grid_.original_triangle_of_node[node.value]);
    }
    thinned.nearest.resize(surface_.vertexCount());  // the grid's first nodes are the surface's vertices
    graph_node_of_vertex_ = std::move(thinned.nearest);
    graph_ = std::move(thinned.graph);
    max_edge_length_ = thinned.longest_edge;
  } else {
    original_triangle_of_node_ = std::move(grid_.original_triangle_of_node);
  }
  metric_ = std::make_unique<MeshMetric>(graph_, options.metric);
  geodesic_extent_ = concave_distance::geodesicExtent(graph_);
  protrusion_spacing_ = concave_distance::protrusionSpacing(*metric_, 0.5 * geodesic_extent_);
}

std::size_t BodyMesh::memoryBytes() const {
  const auto mesh_bytes = [](const SurfaceMesh& mesh) {
    return mesh.vertexCount() * sizeof(Eigen::Vector3d) + mesh.triangleCount() * sizeof(TriangleNodes);
  };
  const std::size_t topology = topology_.triangles_of_vertex.values.size() * sizeof(TriangleIndex) +
                               topology_.neighbours_of_vertex.values.size() * sizeof(NodeIndex) +
                               surface_.triangleCount() * (3 * sizeof(TriangleIndex) + sizeof(std::uint32_t) +
                                                           sizeof(Eigen::Vector3d)) +
                               surface_.vertexCount() * (3 * sizeof(std::uint32_t) + sizeof(Eigen::Vector3d));
  return mesh_bytes(surface_) + mesh_bytes(grid_.mesh) +
         original_triangle_of_node_.size() * sizeof(TriangleIndex) + topology + graph_.memoryBytes() +
         tree_.memoryBytes() + hierarchy_.memoryBytes() + metric_->memoryBytes();
}

}  // namespace concave_distance
