#pragma once

#include "base/content_hash.h"
#include "concave_distance/mesh/preparation_cache.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/triangle_tree.h"

/// The parts of a body, from the cache where it has them, else made and stored. Keys hold all that a part is
/// made from. Without a cache (nullptr) keys are not read.
namespace concave_distance::detail {

struct Trees {
  TriangleTree tree;
  BoundingVolumeHierarchy hierarchy;
};

MeshTopology topologyOf(const SurfaceMesh& surface, PreparationCache* cache, const ContentKey& surface_key);
Trees treesOf(const SurfaceMesh& surface, PreparationCache* cache, const ContentKey& surface_key);

}  // namespace concave_distance::detail
