#include "minima_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "cell_neighbours.h"

namespace concave_distance::detail {
namespace {

using Region = VerdictWorkspace::Region;
using Reached = VerdictWorkspace::Reached;

bool isHigher(const Reached& l, const Reached& r) {
  if (l.squared_level != r.squared_level) return l.squared_level > r.squared_level;
  return l.cell > r.cell;  // any order will do, as long as it is always the same
}

class Verdicts {
 public:
  Verdicts(const MinimaScene& scene, double least_prominence, VerdictWorkspace& workspace)
      : scene_(scene),
        least_prominence_(least_prominence),
        tolerance_(8.0 * scene.rounding),
        table_(workspace.table),
        cells_(workspace.cells),
        reached_(workspace.reached),
        regions_(workspace.regions),
        refinement_(workspace.refinement) {
    table_.clear();
    cells_.clear();
    regions_.clear();
  }

  /// The region of a local minimum, decided; every deeper one has to be decided before.
  std::uint32_t decide(TriangleIndex a, TriangleIndex b, double distance, bool met_by_flood) {
    if (const std::uint32_t known = table_.find(a, b); known != PairTable::kAbsent) {
      noteSeed(rootOf(cells_[known].region), distance, met_by_flood);
      return cells_[known].region;
    }
    const std::uint32_t region = addRegion(a, b, distance, met_by_flood);
    flood(region);
    return region;
  }

  std::uint32_t rootOf(std::uint32_t region) {
    while (regions_[region].parent != region) {
      regions_[region].parent = regions_[regions_[region].parent].parent;
      region = regions_[region].parent;
    }
    return region;
  }

  std::size_t cellCount() const { return cells_.size(); }

 private:
  std::uint32_t addRegion(TriangleIndex a, TriangleIndex b, double distance, bool met_by_flood) {
    const auto region = static_cast<std::uint32_t>(regions_.size());
    const double limit = (1.0 + least_prominence_) * distance + tolerance_;
    regions_.push_back({addCell(a, b, region), region, distance, limit, met_by_flood});
    return region;
  }

  std::uint32_t addCell(TriangleIndex a, TriangleIndex b, std::uint32_t region) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({a, b, region});
    table_.insert(a, b, cell);
    return cell;
  }

  void flood(std::uint32_t region) {
    const double limit = regions_[region].limit;
    double deeper = regions_[region].distance - tolerance_;
    reached_.clear();
    reached_.push_back({0.0, regions_[region].cell});
    while (!reached_.empty()) {
      std::pop_heap(reached_.begin(), reached_.end(), isHigher);
      const std::uint32_t cell = reached_.back().cell;
      reached_.pop_back();
      const TriangleIndex a = cells_[cell].a;
      const TriangleIndex b = cells_[cell].b;
      const TrianglePoints corners_a = scene_.cornersOfA(a);
      const TrianglePoints corners_b = scene_.cornersOfB(b);
      const CellLevels levels = cellLevels(corners_a, corners_b);
      if (deeper > 0.0 && levels.least() < deeper * deeper) {
        if (joinsBelow(region, a, b)) return;
        deeper = regions_[region].distance - tolerance_;
      }
      std::uint32_t met = region;
      forEachNeighbour(scene_, a, b, corners_a, corners_b, levels,
                       [&](TriangleIndex to_a, TriangleIndex to_b, double squared_level) {
                         if (squared_level > limit * limit) return;
                         const std::uint32_t known = table_.find(to_a, to_b);
                         if (known != PairTable::kAbsent) {
                           if (cells_[known].region != region) met = cells_[known].region;
                           return;
                         }
                         reached_.push_back({squared_level, addCell(to_a, to_b, region)});
                         std::push_heap(reached_.begin(), reached_.end(), isHigher);
                       });
      if (met != region) {
        unite(region, met);
        return;
      }
    }
  }

  /// From a cell deeper than the region's start to the minimum under it. False when that is in the region
  /// itself, which has not started at its bottom then.
  bool joinsBelow(std::uint32_t region, TriangleIndex a, TriangleIndex b) {
    const WitnessPair below =
        refineWitness(scene_.a.body(), scene_.b.body(), scene_.a_from_b, a, b, refinement_).witness;
    const double distance = std::sqrt(below.squared_distance);
    const std::uint32_t known = table_.find(below.triangle_a, below.triangle_b);
    if (known != PairTable::kAbsent && cells_[known].region == region) {
      regions_[region].distance = distance;
      regions_[region].cell = known;
      return false;
    }
    if (known != PairTable::kAbsent) {
      unite(region, cells_[known].region);
      return true;
    }
    const std::uint32_t bottom = addRegion(below.triangle_a, below.triangle_b, distance, true);
    unite(region, bottom);
    flood(bottom);
    return true;
  }

  /// A seed that belongs to a region; where it is apart from its bottom by rounding alone, it is the bottom.
  void noteSeed(std::uint32_t root, double distance, bool met_by_flood) {
    if (!met_by_flood && distance <= regions_[root].distance + 2.0 * tolerance_) {
      regions_[root].met_by_flood = false;
    }
  }

  void unite(std::uint32_t region, std::uint32_t with) {
    const std::uint32_t into = rootOf(with);
    if (into == region) return;
    regions_[region].parent = into;
    noteSeed(into, regions_[region].distance, regions_[region].met_by_flood);
  }

  const MinimaScene& scene_;
  double least_prominence_;
  double tolerance_;
  PairTable& table_;
  std::vector<VerdictWorkspace::Cell>& cells_;
  std::vector<Reached>& reached_;
  std::vector<Region>& regions_;
  RefinementWorkspace& refinement_;
};

}  // namespace

void decideMinima(const MinimaScene& scene, double least_prominence, const std::vector<MinimumSeed>& seeds,
                  std::size_t owned, VerdictWorkspace& workspace, FloodResult& result,
                  LocalMinimaCost& cost) {
  Verdicts verdicts(scene, least_prominence, workspace);
  workspace.order.resize(seeds.size());
  std::iota(workspace.order.begin(), workspace.order.end(), 0U);
  std::sort(workspace.order.begin(), workspace.order.end(), [&](std::uint32_t l, std::uint32_t r) {
    return seeds[l].distance != seeds[r].distance ? seeds[l].distance < seeds[r].distance : l < r;
  });
  result.minima.clear();
  result.owners.assign(seeds.size() - owned, LocalMinima::kNoOwner);
  for (const std::uint32_t i : workspace.order) {
    const std::uint32_t region = verdicts.decide(seeds[i].a, seeds[i].b, seeds[i].distance, i >= owned);
    if (i >= owned) result.owners[i - owned] = region;
  }
  std::vector<std::uint32_t>& place = workspace.order;
  place.resize(workspace.regions.size());
  for (std::uint32_t r = 0; r < workspace.regions.size(); ++r) {
    const Region& region = workspace.regions[r];
    if (region.parent != r) continue;
    place[r] = static_cast<std::uint32_t>(result.minima.size());
    const VerdictWorkspace::Cell& cell = workspace.cells[region.cell];
    result.minima.push_back({cell.a, cell.b, region.distance, std::numeric_limits<double>::infinity(),
                             region.limit, region.met_by_flood});
  }
  for (std::size_t& owner : result.owners) {
    owner = place[verdicts.rootOf(static_cast<std::uint32_t>(owner))];
  }
  cost.flooded_pairs += verdicts.cellCount();
}

}  // namespace concave_distance::detail
