#include "cached_parts.h"

#include <exception>
#include <optional>
#include <utility>

#include "base/array_file.h"
#include "base/content_hash.h"
#include "mesh/surface/mesh_topology.h"
#include "repaired_mesh_cache.h"
#include "search/grid/geodesic_extent.h"

namespace concave_distance {

/// Its box is six coordinates.
template <>
struct IsPlainData<TriangleTree::Node> : std::true_type {};
static_assert(sizeof(TriangleTree::Node) == 6 * sizeof(double) + 2 * sizeof(std::uint32_t));

namespace {

/// What `read` takes from the file of a part when the whole file is sound; else what `make` makes, which
/// `write` then stores.
template <typename Read, typename Make, typename Write>
auto fromCache(PreparationCache* cache, const ContentKey& key, const char* part, Read read, Make make,
               Write write) -> decltype(make()) {
  if (cache == nullptr) return make();
  try {
    ArrayFileReader reader(cache->fileOf(key, part), key);
    decltype(make()) found = read(reader);
    if (reader.finish()) return found;
  } catch (const std::exception&) {
    // A file that passes every check and yet does not fit is no reason to stop either.
  }
  decltype(make()) made = make();
  if (cache->makeFolder()) {
    ArrayFileWriter writer(cache->fileOf(key, part), key);
    write(writer, made);
    if (!writer.finish()) cache->noteProblem(writer.problem());
  }
  return made;
}

template <typename T>
CompressedRows<T> readRows(ArrayFileReader& reader) {
  CompressedRows<T> rows;
  reader.array(rows.offsets);
  reader.array(rows.values);
  return rows;
}

template <typename T>
void writeRows(ArrayFileWriter& writer, const CompressedRows<T>& rows) {
  writer.array(rows.offsets);
  writer.array(rows.values);
}

SurfaceMesh readSurface(ArrayFileReader& reader) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  reader.array(vertices);
  reader.array(triangles);
  if (!reader.ok() || triangles.empty()) return {};
  return {std::move(vertices), std::move(triangles), "preparation cache"};
}

void writeSurface(ArrayFileWriter& writer, const SurfaceMesh& surface) {
  writer.array(surface.vertices());
  writer.array(surface.triangles());
}

NodeGraph readGraph(ArrayFileReader& reader) {
  NodeGraph graph;
  reader.array(graph.positions);
  graph.edges = readRows<NodeGraph::Edge>(reader);
  reader.array(graph.neighbourhoods);
  reader.value(graph.neighbourhood_origin);
  reader.array(graph.shell);
  reader.value(graph.shell_count);
  reader.value(graph.length_quantum);
  return graph;
}

void writeGraph(ArrayFileWriter& writer, const NodeGraph& graph) {
  writer.array(graph.positions);
  writeRows(writer, graph.edges);
  writer.array(graph.neighbourhoods);
  writer.value(graph.neighbourhood_origin);
  writer.array(graph.shell);
  writer.value(graph.shell_count);
  writer.value(graph.length_quantum);
}

NodeLevels readLevels(ArrayFileReader& reader) {
  NodeLevels all;
  std::uint64_t count = 0;
  reader.value(count);
  while (reader.ok() && all.levels.size() < count) {
    NodeLevel level;
    level.graph = readGraph(reader);
    reader.array(level.finer_node);
    reader.array(level.node_of_finer);
    all.levels.push_back(std::move(level));
  }
  return all;
}

void writeLevels(ArrayFileWriter& writer, const NodeLevels& all) {
  writer.value(std::uint64_t{all.levels.size()});
  for (const NodeLevel& level : all.levels) {
    writeGraph(writer, level.graph);
    writer.array(level.finer_node);
    writer.array(level.node_of_finer);
  }
}

}  // namespace

std::optional<RepairedMesh> findRepairedMesh(PreparationCache* cache, const ContentKey& key) {
  if (cache == nullptr) return std::nullopt;
  try {
    ArrayFileReader reader(cache->fileOf(key, "surface"), key);
    RepairedMesh repaired;
    reader.value(repaired.report);
    repaired.mesh = readSurface(reader);
    if (reader.finish()) return repaired;
  } catch (const std::exception&) {
    // As in fromCache().
  }
  return std::nullopt;
}

void storeRepairedMesh(PreparationCache* cache, const ContentKey& key, const RepairedMesh& repaired) {
  if (cache == nullptr || !cache->makeFolder()) return;
  ArrayFileWriter writer(cache->fileOf(key, "surface"), key);
  writer.value(repaired.report);
  writeSurface(writer, repaired.mesh);
  if (!writer.finish()) cache->noteProblem(writer.problem());
}

namespace detail {

ContentKey keyOf(const SurfaceMesh& surface) {
  const auto& vertices = surface.vertices();
  const auto& triangles = surface.triangles();
  return preparationHasher()
      .addBytes(vertices.data(), vertices.size() * sizeof(vertices[0]))
      .addBytes(triangles.data(), triangles.size() * sizeof(triangles[0]))
      .key();
}

ContentKey keyOfNodes(const ContentKey& surface_key, const SearchNodesOptions& options) {
  return preparationHasher()
      .add(surface_key)
      .add(options.max_edge_length.has_value())
      .add(options.max_edge_length.value_or(0.0))
      .add(options.node_limit)
      .key();
}

MeshTopology topologyOf(const SurfaceMesh& surface, PreparationCache* cache, const ContentKey& surface_key) {
  return fromCache(
      cache, surface_key, "topology",
      [](ArrayFileReader& reader) {
        MeshTopology topology;
        topology.triangles_of_vertex = readRows<TriangleIndex>(reader);
        topology.neighbours_of_vertex = readRows<NodeIndex>(reader);
        reader.array(topology.triangle_across_edge);
        reader.array(topology.shell_of_triangle);
        reader.array(topology.triangle_of_shell);
        std::vector<std::uint8_t> closed;
        reader.array(closed);
        topology.shell_is_closed.assign(closed.begin(), closed.end());
        reader.array(topology.triangle_normals);
        reader.array(topology.vertex_normals);
        return topology;
      },
      [&] { return buildMeshTopology(surface); },
      [](ArrayFileWriter& writer, const MeshTopology& topology) {
        writeRows(writer, topology.triangles_of_vertex);
        writeRows(writer, topology.neighbours_of_vertex);
        writer.array(topology.triangle_across_edge);
        writer.array(topology.shell_of_triangle);
        writer.array(topology.triangle_of_shell);
        writer.array(
            std::vector<std::uint8_t>(topology.shell_is_closed.begin(), topology.shell_is_closed.end()));
        writer.array(topology.triangle_normals);
        writer.array(topology.vertex_normals);
      });
}

Trees treesOf(const SurfaceMesh& surface, PreparationCache* cache, const ContentKey& surface_key) {
  return fromCache(
      cache, surface_key, "trees",
      [](ArrayFileReader& reader) {
        std::vector<TriangleTree::Node> tree_nodes;
        std::vector<TriangleIndex> order;
        Eigen::Vector3d origin;
        double reach = 0.0;
        std::vector<BoundingVolumeHierarchy::Node> nodes;
        std::vector<BoundingVolumeHierarchy::Leaf> leaves;
        reader.array(tree_nodes);
        reader.array(order);
        reader.value(origin);
        reader.value(reach);
        reader.array(nodes);
        reader.array(leaves);
        if (!reader.ok()) return Trees();
        return Trees{{std::move(tree_nodes), std::move(order)},
                     {origin, reach, std::move(nodes), std::move(leaves)}};
      },
      [&] {
        Trees trees{TriangleTree(surface), {}};
        trees.hierarchy = BoundingVolumeHierarchy(surface, trees.tree);
        return trees;
      },
      [](ArrayFileWriter& writer, const Trees& trees) {
        writer.array(trees.tree.nodes());
        writer.array(trees.tree.order());
        writer.value(trees.hierarchy.origin());
        writer.value(trees.hierarchy.reach());
        writer.array(trees.hierarchy.nodes());
        writer.array(trees.hierarchy.leaves());
      });
}

SearchNodes nodesOf(const SurfaceMesh& surface, const SearchNodesOptions& options, const std::string& where,
                    PreparationCache* cache, const ContentKey& key) {
  return fromCache(
      cache, key, "nodes",
      [](ArrayFileReader& reader) {
        SearchNodes nodes;
        nodes.grid = readSurface(reader);
        nodes.graph = readGraph(reader);
        nodes.levels = readLevels(reader);
        reader.value(nodes.max_edge_length);
        reader.array(nodes.original_triangle_of_node);
        reader.array(nodes.graph_node_of_vertex);
        return nodes;
      },
      [&] { return makeSearchNodes(surface, options, where); },
      [](ArrayFileWriter& writer, const SearchNodes& nodes) {
        writeSurface(writer, nodes.grid);
        writeGraph(writer, nodes.graph);
        writeLevels(writer, nodes.levels);
        writer.value(nodes.max_edge_length);
        writer.array(nodes.original_triangle_of_node);
        writer.array(nodes.graph_node_of_vertex);
      });
}

Metric metricOf(const NodeGraph& graph, const MeshMetricOptions& options, PreparationCache* cache,
                const ContentKey& nodes_key) {
  const bool matrices = MeshMetric::wantsMatrices(graph.nodeCount(), options);
  return fromCache(
      cache, preparationHasher().add(nodes_key).add(matrices).key(), "metric",
      [&](ArrayFileReader& reader) {
        Metric found;
        std::vector<float> distances;
        std::vector<std::uint16_t> predecessors;
        reader.array(distances);
        reader.array(predecessors);
        reader.value(found.geodesic_extent);
        reader.value(found.protrusion_spacing);
        found.metric = std::make_unique<MeshMetric>(graph, std::move(distances), std::move(predecessors));
        return found;
      },
      [&] {
        Metric made;
        made.metric = std::make_unique<MeshMetric>(graph, options);
        made.geodesic_extent = geodesicExtent(graph);
        made.protrusion_spacing = protrusionSpacing(*made.metric, 0.5 * made.geodesic_extent);
        return made;
      },
      [](ArrayFileWriter& writer, const Metric& made) {
        writer.array(made.metric->distances());
        writer.array(made.metric->predecessors());
        writer.value(made.geodesic_extent);
        writer.value(made.protrusion_spacing);
      });
}

}  // namespace detail
}  // namespace concave_distance
