#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Cell (i, j, k) of a regular grid with cells of edge length h is the cube from h (i, j, k) to
/// h (i + 1, j + 1, k + 1).
using VoxelCell = std::array<std::int32_t, 3>;

/// The occupied cells of a regular grid, each once, in the order in which they came.
class VoxelGrid {
 public:
  /// Cells reach from -kLargestIndex to kLargestIndex - 1 along each axis.
  static constexpr std::int32_t kLargestIndex = (1 << 20) - 1;

  /// @param size edge length of a cell, metres. @throws Error unless it is positive and finite
  explicit VoxelGrid(double size);

  double size() const { return size_; }
  const std::vector<VoxelCell>& cells() const { return cells_; }
  bool contains(const VoxelCell& cell) const { return keys_.count(keyOf(cell)) != 0; }
  /// Returns the cell of a point, metres, which lies in its cube up to the rounding of one division; not
  /// finite or outside of the grid: false, and `cell` is left as it is.
  bool locate(const Eigen::Vector3d& point, VoxelCell& cell) const;
  /// @return whether it was not occupied. @throws Error for a cell outside of the grid
  bool insert(const VoxelCell& cell);

  /// Returns the surface of the union of the occupied cells, metres, outwards, two triangles for each face
  /// between an occupied and a free cell. Every corner is h times its index, rounded once, and one vertex, so
  /// that the surface is closed; cells that share an edge or corner only touch there. O(cells).
  /// @param where named in the error. @throws Error when no cell is occupied
  SurfaceMesh surface(const std::string& where) const;

 private:
  static std::uint64_t keyOf(const VoxelCell& cell);

  double size_;
  std::vector<VoxelCell> cells_;
  std::unordered_set<std::uint64_t> keys_;
};

}  // namespace concave_distance
