#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "concave_distance/mesh/surface/round_shape.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

class BoundingVolumeHierarchy;
class MetricMemory;
class NormalConeTree;
class TriangleTree;
enum class NormalSides : std::uint8_t;
struct AdjacentTriangle;
struct ConnectedPieces;
struct ConvexShells;
struct Facets;
struct HullGap;
struct MeshTopology;
struct ShellContacts;
template <typename Value>
struct CompressedRows;

struct BodyMeshOptions {
  /// Grid size of the search, metres: the longest edge between nodes. Empty: a fraction of the diameter.
  std::optional<double> max_edge_length;
  /// An automatic grid has at most this many nodes in the search graph: a finer mesh is thinned to evenly
  /// spread nodes. An explicit grid size is taken as it is.
  std::size_t search_node_limit = 800;
  /// Largest number of nodes of the grid, compared with an estimate before it is made.
  std::size_t largest_node_count = 20'000'000;
  /// The matrices of the mesh metric hold at most this many nodes (at most 65535), 6 bytes an entry; of a
  /// larger graph, evenly spread ones.
  std::size_t matrix_node_limit = 4096;
  /// Limit for these matrices, shared by bodies; without room in it they hold 128 nodes. nullptr: no limit.
  std::shared_ptr<MetricMemory> metric_memory;
  /// The solid that the surface is the inscribed mesh of: answers are for that solid. Empty: the surface is
  /// what it is.
  std::optional<RoundShape> shape;
};

class BodyMesh;

/// A body as it is solved where it was modelled far from the origin of its frame.
struct RecentredBody {
  std::shared_ptr<const BodyMesh> mesh;              ///< nullptr: the body itself is near enough
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the frame of `mesh`, body frame, metres
};

/// Holds the centre of a sphere or the segment of a capsule's axis, which the solid is a ball swept along, as
/// a thin closed mesh around it: no point of the mesh is farther than `thickness` from that.
struct RoundCore {
  std::shared_ptr<const BodyMesh> mesh;  ///< frame of the shape; nullptr: the body is no such solid
  double radius = 0.0;                   ///< metres, of the ball
  double thickness = 0.0;                ///< metres
};

/// Holds what the search keeps with a body. It is made at its first use and freed with the body.
class BodyAttachment {
 public:
  virtual ~BodyAttachment() = default;
};

/// One body, ready for queries: the original surface with its topology and trees, and a place where the
/// search keeps its grid. Immutable to its users; shared between pairs and threads. What is declared here
/// only is defined in headers that are not installed.
class BodyMesh {
 public:
  /// @param surface repaired, original triangles, body frame, metres
  /// @throws Error (naming the body) for a surface without triangles, options out of range (a shape among
  ///         them), or a grid of more nodes than they allow
  BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options = {});
  ~BodyMesh();
  BodyMesh(const BodyMesh&) = delete;
  BodyMesh& operator=(const BodyMesh&) = delete;

  /// Name of the body that it was made for; others of the same content may share it.
  const std::string& name() const { return name_; }
  const SurfaceMesh& surface() const { return surface_; }
  double diameter() const { return surface_.diameter(); }
  const BodyMeshOptions& options() const { return options_; }
  /// The solid that the surface is the inscribed mesh of; nullptr: none.
  const RoundShape* shape() const { return options_.shape ? &*options_.shape : nullptr; }
  /// Holds the surface and the shape, body frame.
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  /// The body with the origin of its frame moved to its centre along every axis on which that is more than 16
  /// diameters away; each vertex is subtracted without rounding. Built at the first call, for all threads.
  const RecentredBody& recentred() const;
  /// The mesh of recentred(), or this one.
  const BodyMesh& asSolved() const { return recentred().mesh ? *recentred().mesh : *this; }
  /// The core of shape(). Built at the first call, for all threads.
  const RoundCore& core() const;

  const MeshTopology& topology() const { return *topology_; }
  const TriangleTree& tree() const { return *tree_; }
  const BoundingVolumeHierarchy& hierarchy() const { return *hierarchy_; }
  /// Returns where shells meet and what lies inside others. Built at the first call, for all threads.
  const ShellContacts& shellContacts() const;
  /// Triangles and flat quadrangles. Built at the first call, for all threads; 24 bytes a triangle.
  const Facets& facets() const;
  /// Which facets hang together, over the joints too; hidden ones with none. Built at the first call, for
  /// all threads; 40 bytes a triangle.
  const CompressedRows<AdjacentTriangle>& adjacency() const;
  /// Returns what hangs together as a whole. Built at the first call, for all threads; 4 bytes a triangle.
  const ConnectedPieces& pieces() const;
  /// Returns how far the surface lies below its convex hull. Measured at the first call, for all threads.
  const HullGap& hullGap() const;
  /// Marks the groups of normalCones(NormalSides::Outside) that hold a feature beside a dent of a nearly
  /// convex surface, by slot; empty for other surfaces. Made at the first call, for all threads.
  const std::vector<bool>& dentedGroups() const;
  /// Returns the convex solids that the body is the union of, if it is. Made at the first call, for all
  /// threads.
  const ConvexShells& convexShells() const;
  /// Returns the cones that level `certified` finds niches by. They are built at the first call for each of
  /// the two, for all threads; about 450 bytes a triangle.
  const NormalConeTree& normalCones(NormalSides sides) const;
  /// Makes what the niches of level `certified` need, in parallel: normalCones(sides), adjacency(), pieces(),
  /// hullGap() and dentedGroups(). Afterwards none of them is waited for.
  void prepareNiches(NormalSides sides) const;

  /// The grid of the search (BodyGrid); nullptr before its first use.
  const BodyAttachment* attachment() const { return attachment_.load(std::memory_order_acquire); }
  /// Keeps `made` unless another thread was faster; returns what is kept.
  const BodyAttachment& attach(std::unique_ptr<const BodyAttachment> made) const;

 private:
  struct State;

  std::string name_;
  SurfaceMesh surface_;
  BodyMeshOptions options_;
  Eigen::AlignedBox3d bounds_;
  std::unique_ptr<State> state_;
  // These point into state_.
  const MeshTopology* topology_;
  const TriangleTree* tree_;
  const BoundingVolumeHierarchy* hierarchy_;
  mutable std::atomic<const BodyAttachment*> attachment_{nullptr};  ///< owned, set once
};

}  // namespace concave_distance
