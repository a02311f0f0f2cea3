#pragma once

#include <vector>

#include "minima_flood.h"
#include "pair_table.h"

namespace concave_distance::detail {

/// Buffers that are kept from query to query.
struct VerdictWorkspace {
  struct Cell {
    TriangleIndex a;
    TriangleIndex b;
    std::uint32_t region;
  };
  /// A triangle pair that can be reached and has not been looked at yet.
  struct Reached {
    double squared_level;
    std::uint32_t cell;
  };
  struct Region {
    std::uint32_t cell;    ///< where it starts
    std::uint32_t parent;  ///< union-find; a root is prominent
    double distance;
    double limit;  ///< metres, up to here it was flooded
    bool met_by_flood;
  };
  PairTable table;
  std::vector<Cell> cells;
  std::vector<Reached> reached;
  std::vector<Region> regions;
  std::vector<std::uint32_t> order;
  RefinementWorkspace refinement;
};

/// Which seeds are niches of the least prominence, and no more than that: as floodMinima(), but no pass is
/// measured. Deeper seeds are flooded first, each up to (1 + least prominence) times its own distance; a
/// flood ends as soon as it comes upon a deeper cell or into the flood of a deeper seed.
void decideMinima(const MinimaScene& scene, double least_prominence, const std::vector<MinimumSeed>& seeds,
                  std::size_t owned, VerdictWorkspace& workspace, FloodResult& result, LocalMinimaCost& cost);

}  // namespace concave_distance::detail
