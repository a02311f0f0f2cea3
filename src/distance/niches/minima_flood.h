#pragma once

#include <vector>

#include "distance/minima/minima_candidates.h"
#include "local_minima.h"

namespace concave_distance::detail {

/// A basin that no deeper one was found to join below its pass.
struct FloodedMinimum {
  MinimumCandidate seed;
  double pass;     ///< metres; infinite when none was reached
  double flooded;  ///< up to here passes were looked for
  bool met_by_flood;
  std::uint64_t region = 0;  ///< NicheDecider::Judged::region
};

struct FloodResult {
  std::vector<FloodedMinimum> minima;  ///< of the least prominence, in no order
  bool cut = false;                    ///< the limit was reached: `minima` are those decided before
  std::vector<std::size_t> owners;     ///< of each of the starts asked for: index in `minima` or npos
};

/// Prominences by 0-dimensional persistence on the graph of triangle pairs. The distance is convex on every
/// product of two triangles, and two of them with an edge of one body in common meet at the least distance
/// over (edge x triangle): weights with which the graph has the very basins and passes of the surfaces. All
/// seeds are flooded at once, in order of distance, each as far as request says; a flood that comes upon a
/// triangle pair deeper than its own start goes down from there and joins what it finds.
/// @param owned first seed of those whose owner is asked for; they are the last of the list
FloodResult floodMinima(const PairFrame& frame, const LocalMinimaRequest& request,
                        const std::vector<MinimumCandidate>& seeds, std::size_t owned, LocalMinimaCost& cost,
                        WorkLimit& limit);

}  // namespace concave_distance::detail
