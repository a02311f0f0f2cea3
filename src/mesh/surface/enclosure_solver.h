#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "surface_cells.h"

namespace concave_distance::detail {

/// The role of a unit's faces in the solid it bounds.
enum class FaceRole : std::uint8_t {
  Skin,  ///< material on one side: `coefficient` triangles of it bound the solid
  Wall,  ///< between two solids that share it: not on the surface of their union
  Sheet  ///< no material on either side, or a single one within material: counts as an open surface
};

struct FaceDecision {
  FaceRole role = FaceRole::Sheet;
  /// Skin: how often the face bounds the solid; positive where its front looks out of the material.
  int coefficient = 0;
  bool both_windings = false;  ///< Sheet: between different cells; one triangle to each side stays
};

/// Decides what a unit encloses, by the first of these rules without a contradiction:
/// 1. The file's windings number the cells: 0 outside, one more for each face entered. Cells with a number
///    other than 0 are material.
/// 2. The file's windings balance along every edge, but cells merge where the surface passes through itself:
///    all faces keep their winding.
/// 3. As 1, but the majority of the faces between two cells decides. A cell is void only if most of its faces
///    agree.
/// 4. As 2, with each face counted once.
/// 5. Every cell except the outer one is material.
/// Returns the decision of each face, and whether most of the boundary was wound inside out.
class EnclosureSolver {
 public:
  EnclosureSolver(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                  const EdgeTable& edges, const SurfaceUnits& units, const std::vector<FaceSide>& cells);

  /// `faces` of one unit, in ascending order. O(n log n).
  bool solve(const std::vector<std::uint32_t>& faces, std::vector<FaceDecision>& decisions);

 private:
  struct Crossing {
    std::uint32_t front;  ///< numbers of cells within the unit
    std::uint32_t back;
    int jump;
  };

  /// Says what lies between two cells.
  struct Boundary {
    std::uint32_t low;
    std::uint32_t high;
    int jump;                 ///< from `low` to `high`
    std::ptrdiff_t agreeing;  ///< faces
  };
  /// Each cell lists the cells beyond its faces, with the change of the winding number.
  using CellSteps = std::vector<std::vector<std::pair<std::uint32_t, int>>>;

  void numberCells(const std::vector<std::uint32_t>& faces);
  void measureCells(const std::vector<std::uint32_t>& faces);
  bool cellsAgree();
  bool cellsVote();
  std::vector<Boundary> boundariesOfCells() const;
  bool numberFromOuter(const CellSteps& next);
  bool edgesBalance(const std::vector<std::uint32_t>& faces, const std::vector<int>& coefficients) const;
  void takeCells(const std::vector<std::uint32_t>& faces, std::vector<FaceDecision>& decisions) const;
  void takeWindings(const std::vector<std::uint32_t>& faces, const std::vector<int>& coefficients,
                    std::vector<FaceDecision>& decisions) const;
  double volumeUnder(std::uint32_t face) const;

  const std::vector<Eigen::Vector3d>& vertices_;
  const FaceTable& table_;
  const EdgeTable& edges_;
  const SurfaceUnits& units_;
  const std::vector<FaceSide>& cells_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Crossing> crossings_;  ///< of the unit's faces
  std::vector<int> windings_;        ///< of the unit's cells
  std::uint32_t cell_count_ = 0;
  std::uint32_t outer_ = 0;
};

}  // namespace concave_distance::detail
