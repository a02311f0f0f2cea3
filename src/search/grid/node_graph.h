#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/compressed_rows.h"

namespace concave_distance {

/// The search's view of a surface (Carretero, sec. 3.1): nodes and the mesh edges between them.
struct NodeGraph {
  /// Up to eight neighbours of a node as one vector operation reads them: coordinates relative to
  /// `neighbourhood_origin`, rounded to float, empty seats far away (kFarAway). Good for choosing a way, not
  /// for an answer: what was chosen is compared in double.
  struct alignas(16) Neighbourhood {
    static constexpr std::uint32_t kSize = 8;
    static constexpr std::uint32_t kNoMore = 0xffffffffU;
    static constexpr float kFarAway = 1e17F;  ///< its square times 3 is still finite
    std::array<float, kSize> x;
    std::array<float, kSize> y;
    std::array<float, kSize> z;
    std::array<std::uint32_t, kSize> to;
    std::uint32_t count;  ///< seats taken, the first ones
    std::uint32_t more;   ///< index of the neighbourhood with the rest, or kNoMore
  };
  struct Edge {
    NodeIndex to;
    /// Metres; used by the mesh metric only. Rounded up to a float that is a multiple of `length_quantum`,
    /// so never below the straight distance, and sums along any path are exact in double.
    float length;
  };
  std::vector<Eigen::Vector3d> positions;     ///< body frame, metres
  CompressedRows<Edge> edges;                 ///< the adjacency Pi, ascending by node
  std::vector<Neighbourhood> neighbourhoods;  ///< entry i of node i, then the further ones of large nodes
  Eigen::Vector3d neighbourhood_origin = Eigen::Vector3d::Zero();  ///< body frame, metres
  std::vector<std::uint32_t> shell;                                ///< connected component of each node
  std::uint32_t shell_count = 0;
  /// Power of two, metres: at most 2^-50 of the sum of all edge lengths.
  double length_quantum = 0.0;

  std::size_t nodeCount() const { return positions.size(); }
};

/// Nodes that no triangle uses are left without edges and form shells of their own; shells are numbered by
/// their first node. O(n log n).
NodeGraph buildNodeGraph(const SurfaceMesh& grid);

/// The same from nodes and the pairs that are neighbours (either order, repeats allowed).
NodeGraph buildNodeGraph(std::vector<Eigen::Vector3d> positions,
                         const std::vector<std::pair<NodeIndex, NodeIndex>>& neighbours);

}  // namespace concave_distance
