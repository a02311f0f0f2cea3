#pragma once

#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "mesh/surface/facets.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/normal_cone_tree.h"
#include "mesh/trees/shell_contacts.h"
#include "mesh/trees/triangle_tree.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"

/// Every number that a body holds, so that two bodies can be compared bit for bit.
namespace concave_distance::test {

using Bytes = std::vector<unsigned char>;

/// Only for what has no padding.
template <typename T>
void appendBytes(const T& value, Bytes& bytes) {
  const std::size_t first = bytes.size();
  bytes.resize(first + sizeof(T));
  std::memcpy(bytes.data() + first, &value, sizeof(T));
}

template <typename... Values>
void appendAll(Bytes& bytes, const Values&... values) {
  (appendBytes(values, bytes), ...);
}

template <typename T>
Bytes bytesOf(const std::vector<T>& values) {
  Bytes bytes;
  for (const T& value : values) appendBytes(value, bytes);
  return bytes;
}

inline Bytes bytesOf(const std::vector<bool>& values) {
  Bytes bytes;
  for (const bool value : values) bytes.push_back(value ? 1 : 0);
  return bytes;
}

inline Bytes bytesOf(const BoundingVolumeHierarchy& hierarchy) {
  Bytes bytes;
  for (const BoundingVolumeHierarchy::Node& node : hierarchy.nodes()) {
    appendAll(bytes, node.centre, node.axes, node.half, node.child);
  }
  for (const BoundingVolumeHierarchy::Leaf& leaf : hierarchy.leaves()) {
    appendAll(bytes, leaf.corner, leaf.triangle, leaf.count);
  }
  appendAll(bytes, hierarchy.origin(), hierarchy.reach());
  for (const auto slot : hierarchy.subtrees()) appendBytes(slot, bytes);
  for (std::uint32_t node = 0; node < hierarchy.nodes().size(); ++node) {
    appendBytes(hierarchy.subtreeOfNode(node), bytes);
  }
  return bytes;
}

inline Bytes bytesOf(const NodeGraph& graph) {
  Bytes bytes = bytesOf(graph.positions);
  for (const std::uint32_t offset : graph.edges.offsets) appendBytes(offset, bytes);
  for (const NodeGraph::Edge& edge : graph.edges.values) {
    appendAll(bytes, edge.to, edge.length);
  }
  for (const NodeGraph::Neighbourhood& part : graph.neighbourhoods) {
    appendAll(bytes, part.x, part.y, part.z, part.to, part.count, part.more);
  }
  for (const std::uint32_t shell : graph.shell) appendBytes(shell, bytes);
  appendAll(bytes, graph.neighbourhood_origin, graph.shell_count, graph.length_quantum);
  return bytes;
}

inline Bytes bytesOf(const MeshMetric& metric) {
  Bytes bytes;
  const std::size_t nodes = metric.graph().nodeCount();
  const std::size_t step = 1 + nodes / 4096;  // all pairs of a large graph do not fit into memory
  for (std::size_t i = 0; i < nodes; i += step) {
    for (std::size_t j = 0; j < nodes; j += step) {
      appendBytes(metric.distance(NodeIndex{i}, NodeIndex{j}), bytes);
    }
  }
  return bytes;
}

/// Part by part, so that a test can say which one differs.
inline std::map<std::string, Bytes> bytesOf(const BodyMesh& body) {
  std::map<std::string, Bytes> parts;
  parts["vertices"] = bytesOf(body.surface().vertices());
  parts["triangles"] = bytesOf(body.surface().triangles());
  const MeshTopology& topology = body.topology();
  parts["triangles of vertices"] = bytesOf(topology.triangles_of_vertex.values);
  parts["first triangles of vertices"] = bytesOf(topology.triangles_of_vertex.offsets);
  parts["neighbours"] = bytesOf(topology.neighbours_of_vertex.values);
  parts["first neighbours"] = bytesOf(topology.neighbours_of_vertex.offsets);
  parts["triangles across edges"] = bytesOf(topology.triangle_across_edge);
  parts["shells of triangles"] = bytesOf(topology.shell_of_triangle);
  parts["closed shells"] = bytesOf(topology.shell_is_closed);
  parts["triangles of shells"] = bytesOf(topology.triangle_of_shell);
  parts["triangle normals"] = bytesOf(topology.triangle_normals);
  parts["vertex normals"] = bytesOf(topology.vertex_normals);
  Bytes& tree = parts["tree"];
  for (const TriangleTree::Node& node : body.tree().nodes()) {
    appendAll(tree, node.box.min(), node.box.max(), node.first, node.count);
  }
  parts["tree's order"] = bytesOf(body.tree().order());
  parts["hierarchy"] = bytesOf(body.hierarchy());
  const BodyGrid& grid = gridOf(body);
  parts["grid vertices"] = bytesOf(grid.nodes().grid.vertices());
  parts["grid triangles"] = bytesOf(grid.nodes().grid.triangles());
  parts["graph"] = bytesOf(grid.graph());
  parts["metric"] = bytesOf(grid.metric());
  Bytes& nodes = parts["nodes"];
  for (std::size_t node = 0; node < grid.graph().nodeCount(); ++node) {
    appendBytes(grid.nodes().originalTriangle(NodeIndex{node}), nodes);
  }
  for (std::size_t vertex = 0; vertex < body.surface().vertexCount(); ++vertex) {
    appendBytes(grid.nodes().graphNode(NodeIndex{vertex}), nodes);
  }
  appendAll(nodes, grid.nodes().max_edge_length, grid.geodesicExtent(), grid.protrusionSpacing());
  parts["hidden"] = bytesOf(body.shellContacts().hidden);
  Bytes& joints = parts["joints"];
  for (const ShellContacts::Joint& joint : body.shellContacts().joints) {
    appendAll(joints, joint.first, joint.second, joint.from, joint.to);
  }
  parts["facets"] = bytesOf(body.facets().nodes);
  parts["facets of triangles"] = bytesOf(body.facets().facet_of_triangle);
  parts["second triangles"] = bytesOf(body.facets().second);
  parts["adjacent facets"] = bytesOf(body.adjacency().values);
  parts["first adjacent facets"] = bytesOf(body.adjacency().offsets);
  const NormalConeTree& cones = body.normalCones(NormalSides::Outside);
  Bytes& items = parts["normal cones"];
  for (const NormalConeTree::Item& item : cones.items()) {
    appendAll(items, item.centre, item.radius, item.cap.axis, item.cap.cosine, item.cap.sine, item.triangle,
              item.kind, item.element);
  }
  parts["groups of cones"] = bytesOf(cones.groups());
  Bytes& subtrees = parts["subtrees of cones"];
  for (const NormalConeTree::Subtree& subtree : cones.subtrees()) {
    appendAll(subtrees, subtree.centre, subtree.arm);
  }
  appendAll(subtrees, cones.origin(), cones.unit());
  return parts;
}

}  // namespace concave_distance::test
