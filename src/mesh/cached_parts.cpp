#include "cached_parts.h"

#include <optional>
#include <utility>

#include "cached_part.h"
#include "repaired_mesh_cache.h"

namespace concave_distance {

/// Its box is six coordinates.
template <>
struct IsPlainData<TriangleTree::Node> : std::true_type {};
static_assert(sizeof(TriangleTree::Node) == 6 * sizeof(double) + 2 * sizeof(std::uint32_t));
template <>
struct IsPlainData<ShellContacts::Joint> : std::true_type {};
static_assert(sizeof(ShellContacts::Joint) == 6 * sizeof(double) + 2 * sizeof(std::uint32_t));
template <>
struct IsPlainData<NormalConeTree::Item> : std::true_type {};
static_assert(sizeof(NormalConeTree::Item) == 9 * sizeof(double) + 2 * sizeof(std::uint32_t));
template <>
struct IsPlainData<NormalConeTree::Subtree> : std::true_type {};
static_assert(sizeof(NormalConeTree::Subtree) == 4 * sizeof(double));

namespace detail {
namespace {

constexpr auto kTransferRepaired = [](auto& file, auto& repaired) {
  file.value(repaired.report);
  transferSurface(file, repaired.mesh);
};

void transferFlags(ArrayFileReader& reader, std::vector<bool>& flags) {
  std::vector<std::uint8_t> bytes;
  reader.array(bytes);
  flags.assign(bytes.begin(), bytes.end());
}

void transferFlags(ArrayFileWriter& writer, const std::vector<bool>& flags) {
  writer.array(std::vector<std::uint8_t>(flags.begin(), flags.end()));
}

void transferTrees(ArrayFileReader& reader, Trees& trees) {
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
  if (!reader.ok()) return;
  trees = {{std::move(tree_nodes), std::move(order)}, {origin, reach, std::move(nodes), std::move(leaves)}};
}

void transferTrees(ArrayFileWriter& writer, const Trees& trees) {
  writer.array(trees.tree.nodes());
  writer.array(trees.tree.order());
  writer.value(trees.hierarchy.origin());
  writer.value(trees.hierarchy.reach());
  writer.array(trees.hierarchy.nodes());
  writer.array(trees.hierarchy.leaves());
}

}  // namespace

MeshTopology topologyOf(const SurfaceMesh& surface, const PartCache& cache) {
  return fromCache(
      cache.cache, cache.surface_key, "topology", [&] { return buildMeshTopology(surface); },
      [](auto& file, auto& topology) {
        transferRows(file, topology.triangles_of_vertex);
        transferRows(file, topology.neighbours_of_vertex);
        file.array(topology.triangle_across_edge);
        file.array(topology.shell_of_triangle);
        file.array(topology.triangle_of_shell);
        transferFlags(file, topology.shell_is_closed);
        file.array(topology.triangle_normals);
        file.array(topology.vertex_normals);
      });
}

Trees treesOf(const SurfaceMesh& surface, const PartCache& cache) {
  return fromCache(
      cache.cache, cache.surface_key, "trees",
      [&] {
        Trees trees{TriangleTree(surface), {}};
        trees.hierarchy = BoundingVolumeHierarchy(surface, trees.tree);
        return trees;
      },
      [](auto& file, auto& trees) { transferTrees(file, trees); });
}

ShellContacts shellContactsOf(const SurfaceMesh& surface, const MeshTopology& topology,
                              const TriangleTree& tree, const PartCache& cache) {
  return fromCache(
      cache.cache, cache.surface_key, "contacts", [&] { return findShellContacts(surface, topology, tree); },
      [](auto& file, auto& contacts) {
        file.array(contacts.joints);
        transferFlags(file, contacts.hidden);
      });
}

Facets facetsOf(const SurfaceMesh& surface, const MeshTopology& topology, const std::vector<bool>& hidden,
                const PartCache& cache) {
  return fromCache(
      cache.cache, cache.surface_key, "facets", [&] { return joinFlatTriangles(surface, topology, hidden); },
      [](auto& file, auto& facets) {
        file.array(facets.facet_of_triangle);
        file.array(facets.second);
        file.array(facets.nodes);
      });
}

CompressedRows<AdjacentTriangle> facetAdjacencyOf(const SurfaceMesh& surface, const MeshTopology& topology,
                                                  const ShellContacts& contacts, const Facets& facets,
                                                  const PartCache& cache) {
  const auto make = [&] {
    CompressedRows<AdjacentTriangle> of_triangles = triangleAdjacency(surface, topology);
    if (!contacts.isEmpty()) of_triangles = joinedAdjacency(surface, contacts, of_triangles);
    return facetAdjacency(facets, of_triangles);
  };
  return fromCache(cache.cache, cache.surface_key, "adjacency", make,
                   [](auto& file, auto& rows) { transferRows(file, rows); });
}

NormalConeTree normalConesOf(const SurfaceMesh& surface, const MeshTopology& topology, NormalSides sides,
                             const ShellContacts& contacts, const PartCache& cache) {
  return fromCache(
      cache.cache, cache.surface_key, sides == NormalSides::Outside ? "cones" : "cones_of_both_sides",
      [&] { return NormalConeTree(surface, topology, sides, contacts); },
      [](auto& file, auto& cones) { cones.transfer(file); });
}

}  // namespace detail

std::optional<RepairedMesh> findRepairedMesh(PreparationCache* cache, const ContentKey& key) {
  if (cache == nullptr) return std::nullopt;
  return detail::findPart<RepairedMesh>(*cache, key, "surface", detail::kTransferRepaired);
}

void storeRepairedMesh(PreparationCache* cache, const ContentKey& key, const RepairedMesh& repaired) {
  if (cache != nullptr) detail::storePart(*cache, key, "surface", repaired, detail::kTransferRepaired);
}

}  // namespace concave_distance
