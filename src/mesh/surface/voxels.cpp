#include "concave_distance/mesh/surface/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>
#include <unordered_map>
#include <utility>

#include "base/number_text.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

constexpr unsigned kBitsOfIndex = 21;
constexpr std::uint32_t kUnknown = 0xffffffffU;

// Corners reach one further than cells.
std::uint64_t packed(const VoxelCell& cell) {
  std::uint64_t key = 0;
  for (const std::int32_t index : cell)
    key = key << kBitsOfIndex | static_cast<std::uint64_t>(index + VoxelGrid::kLargestIndex);
  return key;
}

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const VoxelGrid& grid) : grid_(grid) { numbers_.reserve(4 * grid.cells().size()); }

  SurfaceMesh build(const std::string& where) {
    for (const VoxelCell& cell : grid_.cells()) {
      of_cell_.fill(kUnknown);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        addFace(cell, axis, false);
        addFace(cell, axis, true);
      }
    }
    return SurfaceMesh(std::move(vertices_), std::move(triangles_), where);
  }

 private:
  void addFace(const VoxelCell& cell, std::size_t axis, bool above) {
    VoxelCell neighbour = cell;
    neighbour[axis] += above ? 1 : -1;
    if (isInGrid(neighbour) && grid_.contains(neighbour)) return;
    VoxelCell corner = cell;
    corner[axis] += above ? 1 : 0;
    const std::size_t second = (axis + 1) % 3;
    const std::size_t third = (axis + 2) % 3;
    std::array<NodeIndex, 4> nodes;  // around the face, counterclockwise seen from along the axis
    nodes[0] = vertex(cell, corner);
    ++corner[second];
    nodes[1] = vertex(cell, corner);
    ++corner[third];
    nodes[2] = vertex(cell, corner);
    --corner[second];
    nodes[3] = vertex(cell, corner);
    if (!above) std::swap(nodes[1], nodes[3]);
    triangles_.push_back({nodes[0], nodes[1], nodes[2]});
    triangles_.push_back({nodes[0], nodes[2], nodes[3]});
  }

  static bool isInGrid(const VoxelCell& cell) {
    return std::all_of(cell.begin(), cell.end(), [](std::int32_t index) {
      return index >= -VoxelGrid::kLargestIndex && index < VoxelGrid::kLargestIndex;
    });
  }

  /// Returns the number of a corner of the cell whose faces are being added.
  NodeIndex vertex(const VoxelCell& cell, const VoxelCell& corner) {
    std::size_t place = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) place = 2 * place + (corner[axis] > cell[axis] ? 1 : 0);
    std::uint32_t& number = of_cell_[place];
    if (number == kUnknown) number = findOrAdd(corner);
    return NodeIndex{number};
  }

  std::uint32_t findOrAdd(const VoxelCell& corner) {
    const auto [place, is_new] =
        numbers_.emplace(packed(corner), static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.emplace_back(grid_.size() * Eigen::Vector3d(corner[0], corner[1], corner[2]));
    return place->second;
  }

  const VoxelGrid& grid_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<TriangleNodes> triangles_;
  std::array<std::uint32_t, 8> of_cell_{};  ///< vertices at the corners of one cell
  std::pmr::monotonic_buffer_resource memory_;
  std::pmr::unordered_map<std::uint64_t, std::uint32_t> numbers_{&memory_};
};

}  // namespace

VoxelGrid::VoxelGrid(double size) : size_(size) {
  if (size > 0.0 && std::isfinite(size)) return;
  TextStream seen;
  seen << "a voxel size of " << size << " m";
  throw Error("voxels", seen.str(), "give a positive length");
}

std::uint64_t VoxelGrid::keyOf(const VoxelCell& cell) {
  return packed(cell);
}

bool VoxelGrid::locate(const Eigen::Vector3d& point, VoxelCell& cell) const {
  const Eigen::Array3d index = (point / size_).array().floor();
  const double largest = kLargestIndex;
  if (!((index >= -largest).all() && (index < largest).all())) return false;  // also where it is not finite
  for (int k = 0; k < 3; ++k) cell[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(index[k]);
  return true;
}

bool VoxelGrid::insert(const VoxelCell& cell) {
  for (const std::int32_t index : cell) {
    if (index >= -kLargestIndex && index < kLargestIndex) continue;
    throw Error("voxels", "cell index " + std::to_string(index),
                "the grid has " + std::to_string(kLargestIndex) +
                    " cells on either side of the origin: use larger ones");
  }
  if (!keys_.insert(keyOf(cell)).second) return false;
  cells_.push_back(cell);
  return true;
}

SurfaceMesh VoxelGrid::surface(const std::string& where) const {
  if (cells_.empty()) throw Error(where, "no cell is occupied", "there is no surface to make");
  return SurfaceBuilder(*this).build(where);
}

}  // namespace concave_distance
