#pragma once

#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "base/array_file.h"
#include "base/content_hash.h"
#include "concave_distance/mesh/preparation_cache.h"
#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/compressed_rows.h"
#include "mesh/surface/facets.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/triangle_adjacency.h"
#include "mesh/trees/bounding_volume_hierarchy.h"
#include "mesh/trees/normal_cone_tree.h"
#include "mesh/trees/shell_contacts.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance::detail {

// How a part of a body is read from the preparation cache and stored there. A `transfer` passes the fields
// of a part to an ArrayFileReader, or those of a constant one to an ArrayFileWriter, in the same order.

/// Reads a part; nothing when its file is not sound.
template <typename Part, typename Transfer>
std::optional<Part> findPart(const PreparationCache& cache, const ContentKey& key, const char* name,
                             Transfer transfer) {
  try {
    ArrayFileReader reader(cache.fileOf(key, name), key);
    Part found;
    transfer(reader, found);
    if (reader.finish()) return found;
  } catch (const std::exception&) {
    // A file that passes every check and yet does not fit is no reason to stop either.
  }
  return std::nullopt;
}

template <typename Part, typename Transfer>
void storePart(PreparationCache& cache, const ContentKey& key, const char* name, const Part& part,
               Transfer transfer) {
  if (!cache.makeFolder()) return;
  ArrayFileWriter writer(cache.fileOf(key, name), key);
  transfer(writer, part);
  if (!writer.finish()) cache.noteProblem(writer.problem());
}

/// Finds a part, or makes and stores it.
template <typename Make, typename Transfer>
auto fromCache(PreparationCache* cache, const ContentKey& key, const char* name, Make make, Transfer transfer)
    -> decltype(make()) {
  using Part = decltype(make());
  if (cache == nullptr) return make();
  if (std::optional<Part> found = findPart<Part>(*cache, key, name, transfer)) return std::move(*found);
  Part made = make();
  storePart(*cache, key, name, std::as_const(made), transfer);
  return made;
}

template <typename File, typename Rows>
void transferRows(File& file, Rows& rows) {
  file.array(rows.offsets);
  file.array(rows.values);
}

inline void transferSurface(ArrayFileReader& reader, SurfaceMesh& surface) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  reader.array(vertices);
  reader.array(triangles);
  if (!reader.ok() || triangles.empty()) return;
  surface = SurfaceMesh(std::move(vertices), std::move(triangles), "preparation cache");
}

inline void transferSurface(ArrayFileWriter& writer, const SurfaceMesh& surface) {
  writer.array(surface.vertices());
  writer.array(surface.triangles());
}

// The parts of a body, from the cache where it has them, else made and stored. Keys hold all that a part is
// made from. Without a cache (nullptr) keys are not read.

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
