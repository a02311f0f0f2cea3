#pragma once

#include "base/content_hash.h"
#include "concave_distance/mesh/preparation_cache.h"
#include "mesh/surface/facets.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/normal_cone_tree.h"
#include "mesh/trees/shell_contacts.h"
#include "mesh/trees/triangle_tree.h"

/// The parts of a body, from the cache where it has them, else made and stored. Keys hold all that a part is
/// made from. Without a cache (nullptr) keys are not read.
namespace concave_distance::detail {

/// Where the parts of one surface are kept.
struct PartCache {
  PreparationCache* cache = nullptr;
  ContentKey surface_key;
};

struct Trees {
  TriangleTree tree;
  BoundingVolumeHierarchy hierarchy;
};

MeshTopology topologyOf(const SurfaceMesh& surface, const PartCache& cache);
Trees treesOf(const SurfaceMesh& surface, const PartCache& cache);
/// As findShellContacts(), joinFlatTriangles() and the constructor of NormalConeTree make them.
ShellContacts shellContactsOf(const SurfaceMesh& surface, const MeshTopology& topology,
                              const TriangleTree& tree, const PartCache& cache);
Facets facetsOf(const SurfaceMesh& surface, const MeshTopology& topology, const std::vector<bool>& hidden,
                const PartCache& cache);
NormalConeTree normalConesOf(const SurfaceMesh& surface, const MeshTopology& topology, NormalSides sides,
                             const ShellContacts& contacts, const PartCache& cache);
/// Returns which facets hang together, over the joints too.
CompressedRows<AdjacentTriangle> facetAdjacencyOf(const SurfaceMesh& surface, const MeshTopology& topology,
                                                  const ShellContacts& contacts, const Facets& facets,
                                                  const PartCache& cache);

}  // namespace concave_distance::detail
