#include "basin_verdict.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cell_neighbours.h"
#include "far_pieces.h"
#include "level_path.h"
#include "mesh/surface/connected_pieces.h"
#include "pair_table.h"

namespace concave_distance {
namespace detail {

struct BasinBuffers {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  struct Cell {
    TriangleIndex a;
    TriangleIndex b;
    std::uint32_t basin;    ///< whose flood has looked at it, or kNone
    std::uint32_t reached;  ///< last basin whose flood has reached it
  };
  /// A triangle pair that can be reached and has not been looked at yet.
  struct Reached {
    double squared_level;
    std::uint32_t cell;
  };
  PairTable table;
  std::vector<Cell> cells;
  std::vector<Reached> reached;
  std::vector<std::uint32_t> order;
  std::vector<Basin> basins;
  std::vector<std::uint32_t> roots;  ///< of each basin, or a basin on the way there
  std::vector<std::uint32_t> basin_of_seed;
  PairTable deepest{4};  ///< first basin of each pair of pieces
  LevelPathBuffers path;
  RefinementWorkspace refinement;
};

namespace {

using Reached = BasinBuffers::Reached;

bool isHigher(const Reached& l, const Reached& r) {
  if (l.squared_level != r.squared_level) return l.squared_level > r.squared_level;
  return l.cell > r.cell;  // any order will do, as long as it is always the same
}

/// Floods without their own limit count as large when they have visited this many triangle pairs.
constexpr std::size_t kLargeFlood = std::size_t{1} << 15U;
constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

class Judge {
 public:
  Judge(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b, BasinBuffers& buffers,
        WorkLimit& limit)
      : scene_(a, b, a_from_b),
        tolerance_(8.0 * scene_.rounding),
        table_(buffers.table),
        cells_(buffers.cells),
        reached_(buffers.reached),
        basins_(buffers.basins),
        roots_(buffers.roots),
        deepest_(buffers.deepest),
        path_(buffers.path),
        refinement_(buffers.refinement),
        limit_(limit) {
    table_.clear();
    cells_.clear();
    basins_.clear();
    roots_.clear();
    deepest_.clear();
  }

  const MinimaScene& scene() const { return scene_; }

  /// The basin of the deepest seed of the same pair of pieces. Seeds come by ascending distance.
  std::uint32_t deepestLike(const BasinSeed& seed, std::uint32_t basin) {
    const TriangleIndex piece_a{scene_.pieces_a.piece_of_triangle[seed.a.value]};
    const TriangleIndex piece_b{scene_.pieces_b.piece_of_triangle[seed.b.value]};
    const std::uint32_t known = deepest_.find(piece_a, piece_b);
    if (known != PairTable::kAbsent) return known;
    deepest_.insert(piece_a, piece_b, basin);
    return basin;
  }

  /// Judges a seed without a flood, when isFar() holds.
  std::uint32_t judgeFar(const BasinSeed& seed) {
    const std::uint32_t basin = enter(seed);
    const std::uint32_t deepest = rootOf(deepestLike(seed, basin));
    if (deepest != basin && basins_[basin].owner == basin) join(basin, deepest, largestDistance(scene_));
    return basin;
  }

  /// A known niche; another seed's basin when that has its triangle pair.
  std::uint32_t enter(const BasinSeed& seed) {
    const std::uint32_t known = table_.find(seed.a, seed.b);
    if (known != PairTable::kAbsent && cells_[known].basin != kNone) return cells_[known].basin;
    return addBasin(seed.a, seed.b, seed.distance, seed.least_prominence);
  }

  std::uint32_t judge(const BasinSeed& seed) {
    const std::size_t before = basins_.size();
    const std::uint32_t basin = enter(seed);
    const std::uint32_t deepest = deepestLike(seed, basin);
    if (basins_.size() == before) return basin;
    const bool all_known = seed.largest_flood == kUnlimited;
    if (!(all_known && floods_are_large_ && isSettledByPath(basin, deepest)))
      floodDown(basin, deepest, seed.largest_flood);
    return basin;
  }

  /// Replaces a large flood when all minima are among the seeds: the deepest of its pieces is a niche;
  /// another one is none if a path leads from it to the deepest.
  bool isSettledByPath(std::uint32_t basin, std::uint32_t deepest) {
    if (basin == deepest) return isNearest(basin);
    const std::uint32_t owner = rootOf(deepest);
    if (owner == basin) return false;
    // A path may end in any basin that is known to belong to the deepest one: shallower than this one, it got
    // there by no higher a pass.
    const auto has_arrived = [&](TriangleIndex a, TriangleIndex b) {
      const std::uint32_t cell = table_.find(a, b);
      return cell != PairTable::kAbsent && rootOfCell(cell) == owner;
    };
    const TrianglePair from{basins_[basin].a, basins_[basin].b};
    const TrianglePair to{basins_[deepest].a, basins_[deepest].b};
    std::optional<double> pass;
    for (const int first_moves : {0, 1}) {
      if (!pass)
        pass =
            LevelPath(scene_, path_, limit_).find(from, to, basins_[basin].flooded, first_moves, has_arrived);
    }
    if (!pass) return false;
    join(basin, owner, std::max(*pass, basins_[basin].distance));
    return true;
  }

  /// Floods a basin, then the deeper one that its flood has met, and so on.
  void floodDown(std::uint32_t basin, std::uint32_t deepest, std::size_t largest_flood) {
    while (basin != kNone) {
      const std::uint32_t below = flood(basin, deepest, largest_flood);
      if (deepest == basin) deepest = below;
      basin = below;
    }
  }

  /// @return a new basin that this one belongs to and that is to be flooded next, or kNone
  std::uint32_t flood(std::uint32_t basin, std::uint32_t deepest, std::size_t largest_flood) {
    const double limit = basins_[basin].flooded;
    double deeper = basins_[basin].distance - tolerance_;
    double pass = basins_[basin].distance;
    std::size_t looked_at = 0;
    reached_.clear();
    reached_.push_back({0.0, table_.find(basins_[basin].a, basins_[basin].b)});
    cells_[reached_.back().cell].reached = basin;
    while (!reached_.empty()) {
      if (limit_.isOverNow()) {
        refuse(basin);
        return kNone;
      }
      std::pop_heap(reached_.begin(), reached_.end(), isHigher);
      const Reached next = reached_.back();
      reached_.pop_back();
      pass = std::max(pass, std::sqrt(next.squared_level));
      const TriangleIndex a = cells_[next.cell].a;
      const TriangleIndex b = cells_[next.cell].b;
      const TrianglePoints corners_a = scene_.cornersOfA(a);
      const TrianglePoints corners_b = scene_.cornersOfB(b);
      const CellLevels levels = cellLevels(corners_a, corners_b);
      if (deeper > 0.0 && levels.least() < deeper * deeper) {
        std::uint32_t below = kNone;
        if (joinsBelow(basin, a, b, pass, below)) return below;
        deeper = basins_[basin].distance - tolerance_;
      }
      if (cells_[next.cell].basin == kNone) cells_[next.cell].basin = basin;
      bool joined = false;
      bool has_room = true;
      forEachNeighbour(scene_, a, b, corners_a, corners_b, levels,
                       [&](TriangleIndex to_a, TriangleIndex to_b, double squared_level, const SharedElement& /*element*/) {
                         if (joined || squared_level > limit * limit) return;
                         has_room = has_room && table_.makeRoom(limit_) && limit_.makeRoom(cells_) &&
                                    limit_.makeRoom(reached_);
                         if (!has_room) return;
                         std::uint32_t cell = table_.find(to_a, to_b);
                         if (cell == PairTable::kAbsent) {
                           cell = addCell(to_a, to_b);
                         } else if (cells_[cell].reached == basin) {
                           return;
                         }
                         // What is shallower is flooded through, whether it becomes a part of this basin or
                         // not.
                         const std::uint32_t other = rootOfCell(cell);
                         joined = other != kNone && other != basin &&
                                  meet(basin, other, std::max(pass, std::sqrt(squared_level)));
                         if (joined) return;
                         cells_[cell].reached = basin;
                         reached_.push_back({squared_level, cell});
                         std::push_heap(reached_.begin(), reached_.end(), isHigher);
                       });
      if (joined) return kNone;
      if (!has_room) {
        refuse(basin);
        return kNone;
      }
      if (++looked_at == kLargeFlood && largest_flood == kUnlimited) {
        floods_are_large_ = true;
        if (isSettledByPath(basin, deepest)) return kNone;
      }
      if (looked_at == largest_flood) {
        basins_[basin].undecided = true;
        return kNone;
      }
    }
    return kNone;
  }

  std::uint32_t rootOf(std::uint32_t basin) {
    while (roots_[basin] != basin) basin = roots_[basin] = roots_[roots_[basin]];
    return basin;
  }

 private:
  /// Seeds may leave out minima through material, so the deepest seed need not be the nearest place.
  bool isNearest(std::uint32_t basin) {
    const Basin& deepest = basins_[basin];
    const WitnessPair minimum =
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, deepest.a, deepest.b, refinement_).witness;
    if (isNearestOfItsPieces(scene_, minimum)) return true;
    const TrianglePair seed{deepest.a, deepest.b};
    CertificateRequest request;
    request.limit = &limit_;
    return certifyDistance(scene_.a, scene_.b, scene_.a_from_b, &seed, 1, request, proof_).lower_bound >=
           deepest.distance - tolerance_;
  }

  std::uint32_t addBasin(TriangleIndex a, TriangleIndex b, double distance, double least_prominence) {
    const auto basin = static_cast<std::uint32_t>(basins_.size());
    Basin added{a, b, distance, least_prominence, basin};
    added.flooded = (1.0 + least_prominence) * distance + tolerance_;
    basins_.push_back(added);
    roots_.push_back(basin);
    const std::uint32_t known = table_.find(a, b);
    cells_[known == PairTable::kAbsent ? addCell(a, b) : known].basin = basin;
    return basin;
  }

  void refuse(std::uint32_t basin) { basins_[basin].undecided = basins_[basin].refused = true; }

  std::uint32_t addCell(TriangleIndex a, TriangleIndex b) {
    const auto cell = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back({a, b, kNone, kNone});
    table_.insert(a, b, cell);
    return cell;
  }

  std::uint32_t rootOfCell(std::uint32_t cell) {
    return cells_[cell].basin == kNone ? kNone : rootOf(cells_[cell].basin);
  }

  /// Two basins that touch at a level. True when the one that is flooded has ended in the other.
  bool meet(std::uint32_t flooded, std::uint32_t other, double level) {
    if (other == flooded) return false;
    if (basins_[other].distance <= basins_[flooded].distance) {
      join(flooded, other, level);
      return true;
    }
    if (level <= basins_[other].flooded) join(other, flooded, level);
    return false;
  }

  /// From a cell deeper than the basin's start to the minimum under it. False when that is in the basin
  /// itself, which has not started at its bottom then.
  bool joinsBelow(std::uint32_t basin, TriangleIndex a, TriangleIndex b, double pass, std::uint32_t& bottom) {
    const WitnessPair below = refineWitness(scene_.a, scene_.b, scene_.a_from_b, a, b, refinement_).witness;
    const double distance = std::sqrt(below.squared_distance);
    const std::uint32_t known = table_.find(below.triangle_a, below.triangle_b);
    const std::uint32_t owner = known == PairTable::kAbsent ? kNone : rootOfCell(known);
    if (owner == basin) {
      basins_[basin].distance = distance;
      basins_[basin].a = below.triangle_a;
      basins_[basin].b = below.triangle_b;
      return false;
    }
    if (owner != kNone) {
      join(basin, owner, pass);
      return true;
    }
    bottom = addBasin(below.triangle_a, below.triangle_b, distance, basins_[basin].least_prominence);
    join(basin, bottom, pass);
    return true;
  }

  void join(std::uint32_t shallow, std::uint32_t deep, double pass) {
    basins_[shallow].owner = roots_[shallow] = deep;
    basins_[shallow].pass = pass;
  }

  static constexpr std::uint32_t kNone = BasinBuffers::kNone;

  MinimaScene scene_;
  double tolerance_;
  PairTable& table_;
  std::vector<BasinBuffers::Cell>& cells_;
  std::vector<Reached>& reached_;
  std::vector<Basin>& basins_;
  std::vector<std::uint32_t>& roots_;
  PairTable& deepest_;
  LevelPathBuffers& path_;
  RefinementWorkspace& refinement_;
  CertificateWorkspace proof_;
  WorkLimit& limit_;
  bool floods_are_large_ = false;
};

}  // namespace
}  // namespace detail

BasinVerdicts::BasinVerdicts() : buffers_(std::make_unique<detail::BasinBuffers>()) {}
BasinVerdicts::~BasinVerdicts() = default;
BasinVerdicts::BasinVerdicts(BasinVerdicts&&) noexcept = default;
BasinVerdicts& BasinVerdicts::operator=(BasinVerdicts&&) noexcept = default;

const std::vector<Basin>& BasinVerdicts::basins() const {
  return buffers_->basins;
}

std::uint32_t BasinVerdicts::basinOf(std::size_t seed) const {
  return buffers_->basin_of_seed[seed];
}

std::uint32_t BasinVerdicts::rootOf(std::uint32_t basin) const {
  while (buffers_->roots[basin] != basin) basin = buffers_->roots[basin];
  return basin;
}

std::uint64_t BasinVerdicts::floodedPairs() const {
  return buffers_->cells.size();
}

std::size_t BasinVerdicts::memoryBytes() const {
  const detail::BasinBuffers& b = *buffers_;
  return b.table.memoryBytes() + b.deepest.memoryBytes() +
         b.cells.capacity() * sizeof(detail::BasinBuffers::Cell) +
         b.reached.capacity() * sizeof(detail::BasinBuffers::Reached) + b.basins.capacity() * sizeof(Basin) +
         (b.order.capacity() + b.basin_of_seed.capacity() + b.roots.capacity()) * sizeof(std::uint32_t) +
         b.path.memoryBytes();
}

void judgeBasins(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const std::vector<BasinSeed>& seeds, BasinVerdicts& verdicts, WorkLimit* limit) {
  detail::BasinBuffers& buffers = verdicts.buffers();
  WorkLimit none;
  detail::Judge judge(a, b, a_from_b, buffers, limit != nullptr ? *limit : none);
  buffers.basin_of_seed.resize(seeds.size());
  buffers.order.resize(seeds.size());
  std::iota(buffers.order.begin(), buffers.order.end(), 0U);
  std::sort(buffers.order.begin(), buffers.order.end(), [&](std::uint32_t l, std::uint32_t r) {
    return seeds[l].distance != seeds[r].distance ? seeds[l].distance < seeds[r].distance : l < r;
  });
  double least_prominence = std::numeric_limits<double>::infinity();
  for (const BasinSeed& seed : seeds) least_prominence = std::min(least_prominence, seed.least_prominence);
  if (!seeds.empty() && detail::isFar(judge.scene(), least_prominence)) {
    for (const std::uint32_t i : buffers.order) buffers.basin_of_seed[i] = judge.judgeFar(seeds[i]);
    return;
  }
  for (const std::uint32_t i : buffers.order) {
    if (!seeds[i].judged) buffers.basin_of_seed[i] = judge.enter(seeds[i]);
  }
  for (const std::uint32_t i : buffers.order) {
    if (seeds[i].judged) buffers.basin_of_seed[i] = judge.judge(seeds[i]);
  }
}

}  // namespace concave_distance
