#include "body_grid.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "concave_distance/base/error.h"
#include "geodesic_extent.h"
#include "mesh/metric_memory.h"

namespace concave_distance {
namespace {

// The matrices of a body for which there is no room: 98 kB.
constexpr std::size_t kNodesWithoutRoom = 128;

GraphMetric measure(const NodeGraph& graph, std::size_t matrix_node_limit) {
  GraphMetric made;
  made.metric = std::make_unique<MeshMetric>(graph, matrix_node_limit);
  made.geodesic_extent = geodesicExtent(graph);
  made.protrusion_spacing = protrusionSpacing(*made.metric, 0.5 * made.geodesic_extent);
  return made;
}

// The edge lengths have been checked; if the grid still cannot be made, the surface serves as grid.
SearchNodes makeCheckedNodes(const BodyMesh& body) {
  try {
    return makeSearchNodes(body.surface(), body.options(), body.name());
  } catch (const Error&) {
    BodyMeshOptions coarse = body.options();
    coarse.max_edge_length = 2.0 * body.diameter();
    return makeSearchNodes(body.surface(), coarse, body.name());
  }
}

}  // namespace

BodyGrid::BodyGrid(const BodyMesh& body, SearchNodes nodes) : body_(body) {
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
    if (!options.metric_memory) return {};
    const std::size_t wanted =
        MeshMetric::matrixBytes(std::min(graph().nodeCount(), options.matrix_node_limit));
    const bool has_room = options.metric_memory->take(wanted);
    return {has_room, has_room ? wanted : 0};
  };
  return reserved_.get(reserve).has_room;
}

const GraphMetric& BodyGrid::measured() const {
  if (const GraphMetric* made = measured_.ifMade()) return *made;
  const std::size_t allowed = body_.options().matrix_node_limit;
  const std::size_t matrix_node_limit = reserveMatrices() ? allowed : std::min(allowed, kNodesWithoutRoom);
  return measured_.get([&] {
    const NodeGraph& made = graph();
    return tbb::this_task_arena::isolate([&] { return measure(made, matrix_node_limit); });
  });
}

const MeshMetric* BodyGrid::metricIfMade() const {
  const GraphMetric* made = measured_.ifMade();
  return made != nullptr ? made->metric.get() : nullptr;
}

const BodyGrid& gridOf(const BodyMesh& body) {
  const BodyAttachment* kept = body.attachment();
  if (kept == nullptr) kept = &body.attach(std::make_unique<BodyGrid>(body));
  return static_cast<const BodyGrid&>(*kept);
}

}  // namespace concave_distance
