#include "concave_distance/mesh/body_mesh.h"

#include <array>
#include <atomic>
#include <mutex>
#include <utility>

#include "cached_parts.h"
#include "concave_distance/base/run_together.h"

namespace concave_distance {

struct BodyMesh::OnDemand {
  template <typename T>
  struct Part {
    std::once_flag once;
    T value;
    std::atomic<std::size_t> bytes{0};
  };
  Part<CompressedRows<AdjacentTriangle>> adjacency;
  std::array<Part<NormalConeTree>, 2> cones;  ///< by NormalSides
};

BodyMeshParts makeBodyMeshParts(std::string name, SurfaceMesh surface, const BodyMeshOptions& options) {
  BodyMeshParts parts;
  parts.name = std::move(name);
  parts.surface = std::move(surface);
  parts.cache = options.cache;
  PreparationCache* cache = options.cache.get();
  const SearchNodesOptions nodes_options{options.max_edge_length, options.search_node_limit, options.levels};
  ContentKey surface_key;
  if (cache != nullptr) {
    surface_key = detail::keyOf(parts.surface);
    parts.nodes_key = detail::keyOfNodes(surface_key, nodes_options);
  }
  runTogether({[&] { parts.topology = detail::topologyOf(parts.surface, cache, surface_key); },
               [&] {
                 detail::Trees trees = detail::treesOf(parts.surface, cache, surface_key);
                 parts.tree = std::move(trees.tree);
                 parts.hierarchy = std::move(trees.hierarchy);
               },
               [&] {
                 parts.nodes =
                     detail::nodesOf(parts.surface, nodes_options, parts.name, cache, parts.nodes_key);
               }});
  return parts;
}

BodyMesh::BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options)
    : BodyMesh(makeBodyMeshParts(std::move(name), std::move(surface), options), options.metric) {}

BodyMesh::BodyMesh(BodyMeshParts parts, const MeshMetricOptions& metric)
    : parts_(std::move(parts)), on_demand_(std::make_unique<OnDemand>()) {
  detail::Metric measured =
      detail::metricOf(parts_.nodes.graph, metric, parts_.cache.get(), parts_.nodes_key);
  metric_ = std::move(measured.metric);
  geodesic_extent_ = measured.geodesic_extent;
  protrusion_spacing_ = measured.protrusion_spacing;
}

BodyMesh::~BodyMesh() = default;

const CompressedRows<AdjacentTriangle>& BodyMesh::adjacency() const {
  auto& part = on_demand_->adjacency;
  std::call_once(part.once, [&] {
    part.value = triangleAdjacency(surface(), topology());
    part.bytes = part.value.offsets.capacity() * sizeof(std::uint32_t) +
                 part.value.values.capacity() * sizeof(AdjacentTriangle);
  });
  return part.value;
}

const NormalConeTree& BodyMesh::normalCones(NormalSides sides) const {
  auto& part = on_demand_->cones.at(static_cast<std::size_t>(sides));
  std::call_once(part.once, [&] {
    part.value = NormalConeTree(surface(), topology(), sides);
    part.bytes = part.value.memoryBytes();
  });
  return part.value;
}

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
         nodes.levels.memoryBytes() + parts_.tree.memoryBytes() + parts_.hierarchy.memoryBytes() +
         metric_->memoryBytes() + on_demand_->adjacency.bytes + on_demand_->cones[0].bytes +
         on_demand_->cones[1].bytes;
}

}  // namespace concave_distance
