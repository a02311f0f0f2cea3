#include "body_grid.h"

#include <tbb/task_arena.h>

#include <utility>
#include <vector>

#include "concave_distance/base/error.h"
#include "geodesic_extent.h"
#include "mesh/cached_parts.h"
#include "mesh/metric_memory.h"
#include "mesh/repaired_mesh_cache.h"

namespace concave_distance {
namespace {

using detail::transferRows;
using detail::transferSurface;

template <typename File, typename Graph>
void transferGraph(File& file, Graph& graph) {
  file.array(graph.positions);
  transferRows(file, graph.edges);
  file.array(graph.neighbourhoods);
  file.value(graph.neighbourhood_origin);
  file.array(graph.shell);
  file.value(graph.shell_count);
  file.value(graph.length_quantum);
}

template <typename File, typename Level>
void transferLevel(File& file, Level& level) {
  transferGraph(file, level.graph);
  file.array(level.finer_node);
  file.array(level.node_of_finer);
}

void transferLevels(ArrayFileReader& reader, std::vector<NodeLevel>& levels) {
  std::uint64_t count = 0;
  reader.value(count);
  while (reader.ok() && levels.size() < count) transferLevel(reader, levels.emplace_back());
}

void transferLevels(ArrayFileWriter& writer, const std::vector<NodeLevel>& levels) {
  writer.value(std::uint64_t{levels.size()});
  for (const NodeLevel& level : levels) transferLevel(writer, level);
}

void transferMetric(ArrayFileReader& reader, const NodeGraph& graph, GraphMetric& metric) {
  std::vector<float> distances;
  std::vector<std::uint16_t> predecessors;
  reader.array(distances);
  reader.array(predecessors);
  metric.metric = std::make_unique<MeshMetric>(graph, std::move(distances), std::move(predecessors));
}

void transferMetric(ArrayFileWriter& writer, const NodeGraph& /*graph*/, const GraphMetric& metric) {
  writer.array(metric.metric->distances());
  writer.array(metric.metric->predecessors());
}

SearchNodes cachedNodes(const BodyMesh& body) {
  return detail::fromCache(
      body.options().cache.get(), body.key(), "nodes",
      [&] { return makeSearchNodes(body.surface(), body.options(), body.name()); },
      [](auto& file, auto& nodes) {
        transferSurface(file, nodes.grid);
        transferGraph(file, nodes.graph);
        transferLevels(file, nodes.levels.levels);
        file.value(nodes.max_edge_length);
        file.array(nodes.original_triangle_of_node);
        file.array(nodes.graph_node_of_vertex);
      });
}

GraphMetric cachedMetric(const NodeGraph& graph, std::size_t matrix_node_limit, PreparationCache* cache,
                         const ContentKey& body_key) {
  const bool matrices = MeshMetric::wantsMatrices(graph.nodeCount(), matrix_node_limit);
  return detail::fromCache(
      cache, preparationHasher().add(body_key).add(matrices).key(), "metric",
      [&] {
        GraphMetric made;
        made.metric = std::make_unique<MeshMetric>(graph, matrix_node_limit);
        made.geodesic_extent = geodesicExtent(graph);
        made.protrusion_spacing = protrusionSpacing(*made.metric, 0.5 * made.geodesic_extent);
        return made;
      },
      [&](auto& file, auto& made) {
        transferMetric(file, graph, made);
        file.value(made.geodesic_extent);
        file.value(made.protrusion_spacing);
      });
}

// The edge lengths have been checked; if the grid still cannot be made, the surface serves as grid.
SearchNodes makeCheckedNodes(const BodyMesh& body) {
  try {
    return cachedNodes(body);
  } catch (const Error&) {
    BodyMeshOptions coarse = body.options();
    coarse.max_edge_length = 2.0 * body.diameter();
    return makeSearchNodes(body.surface(), coarse, body.name());
  }
}

}  // namespace

BodyGrid::BodyGrid(const BodyMesh& body, SearchNodes nodes) : body_(body), cache_(nullptr) {
  nodes_.get([&] { return std::move(nodes); });
}

BodyGrid::~BodyGrid() {
  const Reserved* reserved = reserved_.ifMade();
  if (reserved != nullptr && reserved->bytes > 0) body_.options().metric_memory->giveBack(reserved->bytes);
}

// While a thread waits for its parallel parts it must not start another task, which might wait for
// the same body.
const SearchNodes& BodyGrid::makeNodes() const {
  return nodes_.get([&] { return tbb::this_task_arena::isolate([&] { return makeCheckedNodes(body_); }); });
}

bool BodyGrid::reserveMatrices() const {
  const auto reserve = [&]() -> Reserved {
    const BodyMeshOptions& options = body_.options();
    const std::size_t nodes = graph().nodeCount();
    if (!options.metric_memory || !MeshMetric::wantsMatrices(nodes, options.matrix_node_limit)) return {};
    const std::size_t wanted = MeshMetric::matrixBytes(nodes);
    const bool has_room = options.metric_memory->take(wanted);
    return {has_room, has_room ? wanted : 0};
  };
  return reserved_.get(reserve).has_room;
}

const GraphMetric& BodyGrid::measured() const {
  if (const GraphMetric* made = measured_.ifMade()) return *made;
  const std::size_t matrix_node_limit = reserveMatrices() ? body_.options().matrix_node_limit : 0;
  return measured_.get([&] {
    const NodeGraph& made = graph();
    return tbb::this_task_arena::isolate(
        [&] { return cachedMetric(made, matrix_node_limit, cache_, body_.key()); });
  });
}

const MeshMetric* BodyGrid::metricIfMade() const {
  const GraphMetric* made = measured_.ifMade();
  return made != nullptr ? made->metric.get() : nullptr;
}

std::size_t BodyGrid::memoryBytes() const {
  return sizeof(BodyGrid) + nodes_.memoryBytes() + measured_.memoryBytes();
}

const BodyGrid& gridOf(const BodyMesh& body) {
  const BodyAttachment* kept = body.attachment();
  if (kept == nullptr) kept = &body.attach(std::make_unique<BodyGrid>(body));
  return static_cast<const BodyGrid&>(*kept);
}

}  // namespace concave_distance
