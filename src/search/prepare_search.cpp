#include "concave_distance/search/prepare_search.h"

#include <tbb/parallel_for.h>

#include "mesh/surface/grid_size.h"
#include "search/grid/body_grid.h"

namespace concave_distance {
namespace {

// Nodes of a grid that takes so long that it is made while loading, not at the first search.
constexpr double kLargeGrid = 5000.0;

}  // namespace

void prepareSearch(const std::vector<const BodyMesh*>& bodies) {
  std::vector<const BodyGrid*> open;
  for (const BodyMesh* body : bodies) {
    if (gridOf(*body).metricIfMade() == nullptr) open.push_back(&gridOf(*body));
  }
  if (open.empty()) return;
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) { open[i]->nodes(); });
  for (const BodyGrid* grid : open) grid->reserveMatrices();
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) { open[i]->metric(); });
}

void prepareLargeGrid(const BodyMesh& body) {
  const double edge = body.options().max_edge_length.value_or(automaticEdgeLength(body.surface()));
  if (estimatedNodeCount(body.surface(), edge) > kLargeGrid) gridOf(body).nodes();
}

SearchPreparation searchPreparationOf(const BodyMesh& body) {
  SearchPreparation found;
  if (body.attachment() == nullptr) return found;
  const BodyGrid& grid = gridOf(body);
  if (const SearchNodes* nodes = grid.nodesIfMade()) {
    found.grid_nodes = nodes->grid.vertexCount();
    found.max_edge_length = nodes->max_edge_length;
  }
  if (const MeshMetric* metric = grid.metricIfMade()) {
    found.is_complete = true;
    found.is_metric_thinned = metric->isThinned();
  }
  return found;
}

}  // namespace concave_distance
