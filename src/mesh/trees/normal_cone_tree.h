#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "shell_contacts.h"

namespace concave_distance {

/// All unit vectors within an angle of `axis`. An angle of pi is every direction.
struct DirectionCap {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double cosine = -1.0;  ///< of the angle
  double sine = 0.0;     ///< of the angle; both for angles in [0, pi]

  bool isFull() const { return cosine <= -1.0; }
};

/// Says which part of a surface's local normal cones counts: where they leave the body, or all of them. On
/// shells that are open both sides count as outside.
enum class NormalSides : std::uint8_t { Outside, Both };

/// A hierarchy over a surface's vertices, edges and faces with a bounding sphere and the local normal cones
/// of each (Johnson and Cohen 2001): the directions u with u . (x - p) <= 0 for every point x of the surface
/// near a point p of the feature. Only towards such a direction can p be the closest point of its
/// surroundings. A reflex edge seen from outside has none and is left out; the edge of an open border has a
/// half disc. Conservative: cones are widened by 1e-9 and by what the normals of thin triangles are
/// uncertain. Body frame, metres; built in O(n log n), about 3 n items of 88 bytes and 4 n groups of 48 bytes
/// for n triangles.
class NormalConeTree {
 public:
  enum class Kind : std::uint8_t { Vertex, Edge, Face };
  struct Item {
    Eigen::Vector3d centre;
    double radius;  ///< of a sphere around the closed feature
    DirectionCap cap;
    TriangleIndex triangle;  ///< one that carries the feature
    Kind kind;
    std::uint8_t element;  ///< vertex: corner of the triangle; edge: from corner `element` to the next
    std::uint16_t unused = 0;
  };
  static constexpr std::size_t kWidth = 4;
  static constexpr std::uint32_t kNoChild = 0xffffffffU;
  static constexpr std::uint32_t kItemFlag = 0x80000000U;
  /// A slot says where a group stands.
  using Slot = std::uint32_t;
  /// The sphere and the cap around some items, or one, in single precision: widened by its rounding, lengths
  /// in units of unit() from origin().
  struct alignas(16) Group {
    float centre[3];
    float radius;
    float axis[3];
    float angle;  ///< radians
    float cosine;
    float sine;
    /// The slot of the first of its kWidth parts, or an item with kItemFlag. Parts that are left over repeat
    /// the one before and have kNoChild.
    std::uint32_t child;
    std::uint32_t subtree;  ///< of subtrees()
  };
  static constexpr Slot kRoot = 0;  ///< all items
  /// A part of the tree. The centres of all its groups, and the points of items without a radius,
  /// lie within `arm` of `centre`, so that no centre moves farther than `centre` plus the turn
  /// (radians) times `arm`.
  struct Subtree {
    Eigen::Vector3d centre;  ///< metres from origin()
    double arm;              ///< metres
  };
  static constexpr std::size_t kMostSubtrees = 16;

  NormalConeTree() = default;
  /// @param joints of its shells
  NormalConeTree(const SurfaceMesh& mesh, const MeshTopology& topology, NormalSides sides,
                 const ShellContacts& joints = {});
  bool empty() const { return items_.empty(); }
  const std::vector<Group>& groups() const { return groups_; }
  const std::vector<Item>& items() const { return items_; }
  const Eigen::Vector3d& origin() const { return origin_; }  ///< centre of the surface's bounding box
  double unit() const { return unit_; }                      ///< metres, a power of two near the diameter
  std::uint32_t child(Slot slot) const { return groups_[slot].child; }
  const std::vector<Subtree>& subtrees() const { return subtrees_; }
  std::uint32_t subtreeOf(Slot slot) const { return groups_[slot].subtree; }

 private:
  void chooseSubtrees();
  Eigen::Vector3d centreOf(Slot slot) const;

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double unit_ = 1.0;
  std::vector<Group> groups_;
  std::vector<Item> items_;
  std::vector<Subtree> subtrees_;
};

}  // namespace concave_distance
