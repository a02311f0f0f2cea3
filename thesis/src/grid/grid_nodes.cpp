#include "grid_nodes.h"

#include <utility>

#include "mesh/surface/grid_size.h"
#include "search_grid.h"

namespace concave_distance {

SearchNodes makeGridNodes(const SurfaceMesh& surface, const BodyMeshOptions& options,
                          const std::string& where) {
  SearchNodes nodes;
  checkEdgeLength(surface, options.max_edge_length, where);
  nodes.max_edge_length = options.max_edge_length.value_or(automaticEdgeLength(surface));
  SearchGrid grid = makeSearchGrid(surface, nodes.max_edge_length);
  nodes.grid = std::move(grid.mesh);
  nodes.graph = buildNodeGraph(nodes.grid);
  nodes.original_triangle_of_node = std::move(grid.original_triangle_of_node);
  if (!options.max_edge_length) thinNodes(nodes, options.search_node_limit, surface.vertexCount());
  return nodes;
}

}  // namespace concave_distance
