#include "minima_flood.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/pair_table.h"
#include "facet_pair_neighbours.h"

namespace concave_distance::detail {
namespace {

/// A pair of facets that the flood has reached.
struct FacetPair {
  TriangleIndex a;
  TriangleIndex b;
  double distance;       ///< the least over the pair
  double reached;        ///< the highest distance on the way here from the basin's start
  std::uint32_t parent;  ///< union-find; the root of a basin is its deepest seed
  std::uint32_t basin;   ///< of a root: its entry in basins_
};

constexpr std::uint32_t kNone = 0xffffffffU;

struct Basin {
  std::uint32_t facet_pair;
  double limit;
  bool met_by_flood;
  double pass = kInfinity;
  std::uint32_t into = kNone;  ///< the deeper basin beyond the pass
};

/// The way from a facet pair to a neighbour that may not be reached yet.
struct Step {
  double level;
  std::uint32_t from;
  TriangleIndex to_a;
  TriangleIndex to_b;
};

bool laterStep(const Step& l, const Step& r) {
  if (l.level != r.level) return l.level > r.level;
  return l.from > r.from;  // any order will do, as long as it is always the same
}

class Flood {
 public:
  Flood(const PairFrame& frame, const LocalMinimaRequest& request, WorkLimit& limit)
      : frame_(frame), request_(request), tolerance_(8.0 * frame.rounding), limit_(limit) {}

  /// The facet pair of a local minimum, as a basin of its own if it is new.
  std::uint32_t startAt(TriangleIndex of_a, TriangleIndex of_b, bool met_by_flood) {
    cut_ = cut_ || limit_.isOverNow();
    const auto [a, b] = frame_.facetPairOf(of_a, of_b);
    if (const std::uint32_t known = table_.find(a, b); known != PairTable::kAbsent) return known;
    const std::uint32_t facet_pair = addFacetPair(a, b);
    facet_pairs_[facet_pair].parent = facet_pair;
    facet_pairs_[facet_pair].basin = static_cast<std::uint32_t>(basins_.size());
    basins_.push_back({facet_pair, limitOf(facet_pairs_[facet_pair].distance), met_by_flood});
    expand(facet_pair);
    return facet_pair;
  }

  void run() {
    while (!steps_.empty() && !cut_) {
      std::pop_heap(steps_.begin(), steps_.end(), laterStep);
      const Step step = steps_.back();
      steps_.pop_back();
      reached_ = step.level;
      if (limit_.isOverNow()) {
        cut_ = true;
      } else {
        take(step);
      }
    }
  }

  bool wasCut() const { return cut_; }
  /// Whether everything that could end a basin has been checked.
  bool isDecided(const Basin& basin) const { return !cut_ || basin.limit < reached_; }

  std::uint32_t rootOf(std::uint32_t facet_pair) {
    while (facet_pairs_[facet_pair].parent != facet_pair) {
      facet_pairs_[facet_pair].parent = facet_pairs_[facet_pairs_[facet_pair].parent].parent;
      facet_pair = facet_pairs_[facet_pair].parent;
    }
    return facet_pair;
  }

  const std::vector<Basin>& basins() const { return basins_; }
  const FacetPair& facet_pair(std::uint32_t i) const { return facet_pairs_[i]; }
  std::size_t cellCount() const { return facet_pairs_.size(); }

  /// Up to here a basin that starts at `distance` has to be flooded to know all that is asked for.
  double limitOf(double distance) const {
    const double decides = (1.0 + request_.least_prominence) * distance;
    const double wanted = std::min((1.0 + request_.prominence_limit) * distance, request_.cutoff);
    return std::max(decides, wanted) + tolerance_;
  }

  /// The basin that a start belongs to: its own or the next deeper one that is prominent.
  std::uint32_t ownerOf(std::uint32_t start) const {
    std::uint32_t basin = facet_pairs_[start].basin;
    while (!isProminent(basins_[basin])) basin = basins_[basin].into;
    return basin;
  }

  bool isProminent(const Basin& basin) const {
    const double distance = facet_pairs_[basin.facet_pair].distance;
    return basin.pass > distance + tolerance_ && basin.pass >= (1.0 + request_.least_prominence) * distance;
  }

 private:
  std::uint32_t addFacetPair(TriangleIndex a, TriangleIndex b) {
    measure(a, b);
    const auto index = static_cast<std::uint32_t>(facet_pairs_.size());
    const double distance = std::sqrt(levels_.least());
    facet_pairs_.push_back({a, b, distance, distance, index, 0});
    table_.insert(a, b, index);
    return index;
  }

  void measure(TriangleIndex a, TriangleIndex b) {
    points_a_ = frame_.facetOfA(a);
    points_b_ = frame_.facetOfB(b);
    levels_ = facetPairLevels(points_a_, points_b_);
  }

  /// Of the facet pair that was measured last.
  void expand(std::uint32_t index) {
    const double limit = basins_[facet_pairs_[rootOf(index)].basin].limit;
    forEachNeighbour(
        frame_, facet_pairs_[index].a, facet_pairs_[index].b, points_a_, points_b_, levels_,
        [&](TriangleIndex to_a, TriangleIndex to_b, double squared_level, const SharedElement& /*element*/) {
          consider(index, to_a, to_b, limit, std::sqrt(squared_level));
        });
  }

  void consider(std::uint32_t from, TriangleIndex to_a, TriangleIndex to_b, double limit, double level) {
    const double above = std::max(level, facet_pairs_[from].reached);
    if (above > limit || cut_) return;
    if (!limit_.makeRoom(steps_) || !limit_.makeRoom(facet_pairs_, 2) || !table_.makeRoom(limit_)) {
      cut_ = true;
      return;
    }
    steps_.push_back({above, from, to_a, to_b});
    std::push_heap(steps_.begin(), steps_.end(), laterStep);
  }

  void take(const Step& step) {
    const std::uint32_t here = rootOf(step.from);
    if (step.level > basins_[facet_pairs_[here].basin].limit) return;
    std::uint32_t there = table_.find(step.to_a, step.to_b);
    if (there == PairTable::kAbsent) {
      there = addFacetPair(step.to_a, step.to_b);
      if (facet_pairs_[there].distance >= facet_pairs_[here].distance - tolerance_) {
        facet_pairs_[there].parent = here;
        facet_pairs_[there].reached = step.level;
        expand(there);
        return;
      }
      goDown(there);
    }
    unite(here, rootOf(there), std::max(step.level, facet_pairs_[there].reached));
  }

  /// From a facet pair deeper than the flood's start to the minimum under it.
  void goDown(std::uint32_t index) {
    const TrianglePair from = frame_.closestIn({facet_pairs_[index].a, facet_pairs_[index].b}).first;
    const WitnessPair witness =
        refineWitness(frame_.a, frame_.b, frame_.a_from_b, from.a, from.b, refinement_).witness;
    const TrianglePair facet_pair = frame_.facetPairOf(witness.triangle_a, witness.triangle_b);
    if (facet_pair.a == facet_pairs_[index].a && facet_pair.b == facet_pairs_[index].b) {
      facet_pairs_[index].basin = static_cast<std::uint32_t>(basins_.size());
      basins_.push_back({index, limitOf(facet_pairs_[index].distance), true});
    } else {
      const std::uint32_t bottom = startAt(facet_pair.a, facet_pair.b, true);
      facet_pairs_[index].parent = rootOf(bottom);
      measure(facet_pairs_[index].a, facet_pairs_[index].b);
    }
    expand(index);
  }

  void unite(std::uint32_t l, std::uint32_t r, double level) {
    if (l == r) return;
    const bool l_deeper = facet_pairs_[l].distance < facet_pairs_[r].distance ||
                          (facet_pairs_[l].distance == facet_pairs_[r].distance &&
                           facet_pairs_[l].basin < facet_pairs_[r].basin);
    const std::uint32_t deep = l_deeper ? l : r;
    const std::uint32_t shallow = l_deeper ? r : l;
    facet_pairs_[shallow].parent = deep;
    Basin& ended = basins_[facet_pairs_[shallow].basin];
    Basin& goes_on = basins_[facet_pairs_[deep].basin];
    ended.pass = std::max(level, facet_pairs_[shallow].distance);
    ended.into = facet_pairs_[deep].basin;
    // One place that both were led to, apart by rounding alone.
    if (ended.pass <= facet_pairs_[deep].distance + tolerance_) {
      goes_on.met_by_flood = goes_on.met_by_flood && ended.met_by_flood;
    }
  }

  const PairFrame& frame_;
  const LocalMinimaRequest& request_;
  double tolerance_;
  WorkLimit& limit_;
  bool cut_ = false;
  double reached_ = 0.0;  ///< metres, the level of the last step
  PairTable table_;
  std::vector<FacetPair> facet_pairs_;
  std::vector<Basin> basins_;
  std::vector<Step> steps_;
  RefinementWorkspace refinement_;
  // Of the facet pair measured last.
  FacetPoints points_a_;
  FacetPoints points_b_;
  FacetPairLevels levels_{};
};

}  // namespace

FloodResult floodMinima(const PairFrame& frame, const LocalMinimaRequest& request,
                        const std::vector<MinimumCandidate>& seeds, std::size_t owned, LocalMinimaCost& cost,
                        WorkLimit& limit) {
  const MemoryScope memory(limit);
  Flood flood(frame, request, limit);
  std::vector<std::uint32_t> starts;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    starts.push_back(flood.startAt(seeds[i].a, seeds[i].b, i >= owned));
  }
  flood.run();
  FloodResult result;
  std::vector<std::size_t> minimum_of_basin(flood.basins().size(), LocalMinima::kNoOwner);
  for (std::size_t i = 0; i < flood.basins().size(); ++i) {
    const Basin& basin = flood.basins()[i];
    if (!flood.isProminent(basin) || !flood.isDecided(basin)) continue;
    const FacetPair& facet_pair = flood.facet_pair(basin.facet_pair);
    minimum_of_basin[i] = result.minima.size();
    const TrianglePair closest = frame.closestIn({facet_pair.a, facet_pair.b}).first;
    result.minima.push_back(
        {seedOn(closest.a, closest.b, facet_pair.distance), basin.pass, basin.limit, basin.met_by_flood});
  }
  // A start belongs to the deepest basin that it is joined to by passes of less than the least prominence.
  for (std::size_t i = owned; i < starts.size(); ++i) {
    result.owners.push_back(minimum_of_basin[flood.ownerOf(starts[i])]);
  }
  cost.flooded_pairs += flood.cellCount();
  result.cut = flood.wasCut();
  return result;
}

}  // namespace concave_distance::detail
