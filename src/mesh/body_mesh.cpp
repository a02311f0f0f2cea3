#include "concave_distance/mesh/body_mesh.h"

#include <tbb/parallel_invoke.h>

#include <utility>

#include "concave_distance/mesh/geodesic_extent.h"

namespace concave_distance {

BodyMeshParts makeBodyMeshParts(std::string name, SurfaceMesh surface, const BodyMeshOptions& options) {
  BodyMeshParts parts;
  parts.name = std::move(name);
  parts.surface = std::move(surface);
  tbb::parallel_invoke([&] { parts.topology = buildMeshTopology(parts.surface); },
                       [&] {
                         parts.tree = TriangleTree(parts.surface);
                         parts.hierarchy = BoundingVolumeHierarchy(parts.surface, parts.tree);
                       },
                       [&] {
                         parts.nodes = makeSearchNodes(
                             parts.surface, {options.max_edge_length, options.search_node_limit}, parts.name);
                       });
  return parts;
}

BodyMesh::BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options)
    : BodyMesh(makeBodyMeshParts(std::move(name), std::move(surface), options), options.metric) {}

BodyMesh::BodyMesh(BodyMeshParts parts, const MeshMetricOptions& metric)
    : parts_(std::move(parts)),
      metric_(std::make_unique<MeshMetric>(parts_.nodes.graph, metric)),
      geodesic_extent_(concave_distance::geodesicExtent(parts_.nodes.graph)),
      protrusion_spacing_(concave_distance::protrusionSpacing(*metric_, 0.5 * geodesic_extent_)) {}

std::size_t BodyMesh::memoryBytes() const {
  const auto mesh_bytes = [](const SurfaceMesh& mesh) {
    return mesh.vertexCount() * sizeof(Eigen::Vector3d) + mesh.triangleCount() * sizeof(TriangleNodes);
  };
  const MeshTopology& topology = parts_.topology;
  const SearchNodes& nodes = parts_.nodes;
  const std::size_t topology_bytes =
      topology.triangles_of_vertex.values.size() * sizeof(TriangleIndex) +
      topology.neighbours_of_vertex.values.size() * sizeof(NodeIndex) +
      surface().triangleCount() *
          (3 * sizeof(TriangleIndex) + sizeof(std::uint32_t) + sizeof(Eigen::Vector3d)) +
      surface().vertexCount() * (3 * sizeof(std::uint32_t) + sizeof(Eigen::Vector3d));
  return mesh_bytes(surface()) + mesh_bytes(nodes.grid) +
         nodes.original_triangle_of_node.size() * sizeof(TriangleIndex) +
         nodes.graph_node_of_vertex.size() * sizeof(NodeIndex) + topology_bytes + nodes.graph.memoryBytes() +
         parts_.tree.memoryBytes() + parts_.hierarchy.memoryBytes() + metric_->memoryBytes();
}

}  // namespace concave_distance
