#pragma once

#include <string>

#include "base/content_hash.h"
#include "concave_distance/mesh/body_mesh.h"
#include "mesh/surface/connected_pieces.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/normal_cone_tree.h"
#include "mesh/trees/triangle_tree.h"
#include "search/grid/mesh_metric.h"
#include "mesh/metric_memory.h"
#include "search/grid/node_graph.h"
#include "search/grid/search_nodes.h"

namespace concave_distance {

/// Everything of a body except its mesh metric, for a search on other nodes than the grid's.
struct BodyMeshParts {
  std::string name;
  SurfaceMesh surface;
  MeshTopology topology;
  TriangleTree tree;
  BoundingVolumeHierarchy hierarchy;
  SearchNodes nodes;
  PreparationCachePointer cache;  ///< for the metric
  ContentKey nodes_key;           ///< in the cache
};

/// Makes the parts, those that do not need each other in parallel; the same whatever the number of threads.
/// @param surface repaired, original triangles, body frame, metres
/// @throws Error (naming the body) for options out of range
BodyMeshParts makeBodyMeshParts(std::string name, SurfaceMesh surface, const BodyMeshOptions& options);

/// Bodies with the same key differ only in their names.
ContentKey bodyKey(const SurfaceMesh& surface, const BodyMeshOptions& options);

}  // namespace concave_distance
