#pragma once

#include <memory>
#include <string>

#include "concave_distance/mesh/preparation_cache.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/triangle_tree.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/search_nodes.h"

/// The parts of a body, from the cache where it has them, else made and stored. Keys hold all that a part is
/// made from. Without a cache (nullptr) keys are not read.
namespace concave_distance::detail {

ContentKey keyOf(const SurfaceMesh& surface);
ContentKey keyOfNodes(const ContentKey& surface_key, const SearchNodesOptions& options);

struct Trees {
  TriangleTree tree;
  BoundingVolumeHierarchy hierarchy;
};

/// The mesh metric and what is measured with it (mesh/geodesic_extent.h).
struct Metric {
  std::unique_ptr<MeshMetric> metric;
  double geodesic_extent = 0.0;
  double protrusion_spacing = 0.0;
};

MeshTopology topologyOf(const SurfaceMesh& surface, PreparationCache* cache, const ContentKey& surface_key);
Trees treesOf(const SurfaceMesh& surface, PreparationCache* cache, const ContentKey& surface_key);
/// @throws Error (naming `where`) as makeSearchNodes()
SearchNodes nodesOf(const SurfaceMesh& surface, const SearchNodesOptions& options, const std::string& where,
                    PreparationCache* cache, const ContentKey& key);
Metric metricOf(const NodeGraph& graph, const MeshMetricOptions& options, PreparationCache* cache,
                const ContentKey& nodes_key);

}  // namespace concave_distance::detail
