#include "minima_verdicts.h"

#include <algorithm>
#include <cmath>

#include "base/refill.h"
#include "far_pieces.h"
#include "mesh/surface/connected_pieces.h"
#include "niche_properties.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// A flood that has visited this many cells may be replaced by cheaper tests.
constexpr std::size_t kLongFlood = std::size_t{1} << 15U;
/// Around more cells no border is kept.
constexpr std::size_t kLargestRegion = std::size_t{1} << 16U;
/// Steps of a path that are followed: links of different times may lead in a circle.
constexpr int kLongestPath = 256;
/// Cycles that a path is kept without being used.
constexpr std::uint64_t kKeptCycles = 64;
/// Cells that are kept without being looked through.
constexpr std::size_t kSmallTable = 256;
/// A region that has grown to more than twice its size and this many cells is made anew.
constexpr std::size_t kSmallRegion = 64;

}  // namespace

/// One call of judge().
class MinimaVerdicts::Stage {
 public:
  Stage(MinimaVerdicts& memory, const MinimaScene& scene, const Request& request, WorkLimit& limit)
      : memory_(memory), scene_(scene), request_(request), limit_(limit), tolerance_(8.0 * scene.rounding) {}

  /// Every seed with its cell, and every region with the deepest seed in it.
  void enter(const std::vector<MinimumSeed>& seeds) {
    were_long_ = memory_.floods_are_long_;
    memory_.floods_are_long_ = false;
    for (Region& region : memory_.regions_) {
      region.first = kNone;
      region.confirmed = false;
    }
    for (const MinimumSeed& seed : seeds) {
      const auto index = static_cast<std::uint32_t>(memory_.judged_.size());
      memory_.judged_.emplace_back();
      memory_.judged_.back().seed = seed;
      const std::uint32_t number = cellOf(seed.a, seed.b);
      if (number == kNone) continue;
      Cell& cell = memory_.cells_[number];
      if (cell.cycle == memory_.cycle_) continue;
      cell.cycle = memory_.cycle_;
      cell.seed = index;
      for (std::uint32_t m = cell.regions; m != kNone; m = memory_.memberships_[m].next) {
        Region& region = memory_.regions_[memory_.memberships_[m].region];
        if (region.first == kNone) region.first = index;
      }
    }
    seed_count_ = memory_.seed_count_ = static_cast<std::uint32_t>(memory_.judged_.size());
  }

  /// Goes on with what enter() of an earlier stage at this pose has left.
  void resume() {
    seed_count_ = memory_.seed_count_;
    were_long_ = memory_.floods_are_long_;
  }

  std::uint32_t placeAround(const TrianglePair& pair) {
    const std::uint32_t in_cell = seedIn(pair.a, pair.b);
    if (in_cell != kNone) return in_cell;
    return enterPlace(
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, pair.a, pair.b, memory_.refinement_).witness);
  }

  /// The minimum among the judged: the seed at its place, or an entry of its own; kNone through material.
  std::uint32_t enterPlace(const WitnessPair& minimum) {
    const std::uint32_t in_cell = seedIn(minimum.triangle_a, minimum.triangle_b);
    if (in_cell != kNone) return in_cell;
    const MinimumSeed seed = scene_.seedOf(minimum);
    const auto begin = memory_.judged_.begin();
    const auto found = begin + seed_count_;
    const auto is_there = [&](const Judged& other) { return isSamePlace(other.seed, seed); };
    const auto is_nearer = [](const Judged& judged, double distance) {
      return judged.seed.distance < distance;
    };
    const auto nearest = std::lower_bound(begin, found, seed.distance - tolerance_, is_nearer);
    const auto farthest = std::lower_bound(nearest, found, seed.distance + 2.0 * tolerance_, is_nearer);
    auto known = std::find_if(nearest, farthest, is_there);
    if (known == farthest) known = std::find_if(found, memory_.judged_.end(), is_there);
    if (known != memory_.judged_.end()) return static_cast<std::uint32_t>(known - begin);
    if (!request_.through_material &&
        classifyOutwardness(scene_.a, scene_.b, scene_.a_from_b, minimum) == Outwardness::ThroughMaterial) {
      return kNone;
    }
    memory_.judged_.emplace_back();
    memory_.judged_.back().seed = seed;
    memory_.judged_.back().was_found = true;
    return static_cast<std::uint32_t>(memory_.judged_.size() - 1);
  }

  void decideFar() {
    for (std::uint32_t i = 0; i < memory_.judged_.size(); ++i) {
      if (memory_.judged_[i].verdict != Verdict::Open) continue;
      const std::uint32_t deepest = deepestLike(i);
      set(i, deepest == i ? Verdict::Niche : Verdict::Ripple, deepest == i ? kNone : deepest);
    }
  }

  /// The next ones that are known, until there are as many niches as wanted.
  void decideByMemory() {
    std::size_t niches = 0;
    for (std::uint32_t& end = memory_.end_; end < seed_count_ && niches < request_.most_niches; ++end) {
      if (memory_.judged_[end].verdict == Verdict::Open) decideByMemory(end);
      niches += memory_.judged_[end].verdict == Verdict::Niche ? 1 : 0;
    }
  }

  /// Those that it has left open, in ascending order until there are as many niches as wanted.
  void decideByFloods() {
    if (limit_.isTimed()) floodInTurn();
    std::size_t niches = 0;
    for (std::uint32_t& i = memory_.next_; i < memory_.end_ && niches < request_.most_niches; ++i) {
      if (memory_.judged_[i].verdict == Verdict::Open) flood(i);
      niches += memory_.judged_[i].verdict == Verdict::Niche ? 1 : 0;
    }
    memory_.end_ = memory_.next_;
  }

  /// Where time may be short, others come first in every cycle.
  void floodInTurn() {
    const std::uint32_t count = memory_.end_ - memory_.next_;
    if (count == 0) return;
    std::uint32_t done = 0;
    for (; done < count && !limit_.isOver(); ++done) {
      const std::uint32_t i = memory_.next_ + (memory_.turn_ + done) % count;
      if (memory_.judged_[i].verdict == Verdict::Open) flood(i);
    }
    memory_.turn_ = (memory_.turn_ + done) % count;
  }

  void decide(std::uint32_t i) {
    decideByMemory(i);
    if (memory_.judged_[i].verdict == Verdict::Open) flood(i);
  }

  /// The next deeper minimum of a ripple of which only a deeper place is known.
  void resolve(std::uint32_t i) {
    while (i != kNone && memory_.judged_[i].verdict == Verdict::Ripple) {
      if (memory_.judged_[i].into == kNone) descend(i);
      const std::uint32_t into = memory_.judged_[i].into;
      if (into != kNone && memory_.judged_[into].verdict == Verdict::Open) decide(into);
      i = into;
    }
  }

 private:
  /// Leaves open what is not known.
  void decideByMemory(std::uint32_t i) {
    const MinimumSeed seed = memory_.judged_[i].seed;
    deepest_ = deepestLike(i);
    const std::uint32_t number = cellOf(seed.a, seed.b);
    if (number == kNone) return set(i, Verdict::Undecided);
    if (const std::uint32_t other = seedOf(number); other != kNone && other != i && isEarlier(other, i)) {
      return set(i, Verdict::Ripple, other);
    }
    if (i > 0 && i < seed_count_ && isSamePlace(memory_.judged_[i - 1].seed, seed))
      return set(i, Verdict::Ripple, i - 1);
    if (followsDown(i, number)) return;
    if (request_.is_wanted && !request_.is_wanted(seed, memory_.cells_[number].occluder)) {
      return set(i, Verdict::Unwanted);
    }
    const std::uint32_t known = regionOf(number, i);
    if (known == kNone) return;
    Region& region = memory_.regions_[known];
    region.confirmed = isEnclosed(i, known);
    if (region.confirmed) {
      memory_.judged_[i].region = region.id;
      return set(i, Verdict::Niche);
    }
  }

  /// Up to here nothing deeper may be reached.
  double levelOf(double distance) const { return (1.0 + request_.least_prominence) * distance; }

  void set(std::uint32_t i, Verdict verdict, std::uint32_t into = kNone) {
    memory_.judged_[i].verdict = verdict;
    memory_.judged_[i].into = into;
  }

  /// kNone without memory.
  std::uint32_t cellOf(TriangleIndex a, TriangleIndex b) {
    const std::uint32_t known = memory_.table_.find(a, b);
    if (known != PairTable::kAbsent) return known;
    if (!memory_.table_.makeRoom(limit_) || !limit_.makeRoom(memory_.cells_)) return kNone;
    const auto number = static_cast<std::uint32_t>(memory_.cells_.size());
    Cell cell;
    cell.a = a;
    cell.b = b;
    memory_.cells_.push_back(cell);
    memory_.table_.insert(a, b, number);
    return number;
  }

  std::uint32_t seedOf(std::uint32_t number) const {
    const Cell& cell = memory_.cells_[number];
    return cell.cycle == memory_.cycle_ ? cell.seed : kNone;
  }

  /// Seeds are in ascending order; what is no seed belongs to one as deep as itself.
  bool isEarlier(std::uint32_t other, std::uint32_t i) const {
    if (i < seed_count_) return other < i;
    return memory_.judged_[other].seed.distance <= memory_.judged_[i].seed.distance + tolerance_;
  }

  /// Where shells of one body lie on each other, both have the minimum.
  bool isSamePlace(const MinimumSeed& l, const MinimumSeed& r) const {
    return l.is_measured && r.is_measured &&
           (l.point_a - r.point_a).squaredNorm() + (l.point_b - r.point_b).squaredNorm() <=
               tolerance_ * tolerance_;
  }

  std::uint32_t deepestLike(std::uint32_t i) {
    const MinimumSeed& seed = memory_.judged_[i].seed;
    const TriangleIndex piece_a{scene_.pieces_a.piece_of_triangle[seed.a.value]};
    const TriangleIndex piece_b{scene_.pieces_b.piece_of_triangle[seed.b.value]};
    const std::uint32_t known = memory_.deepest_.find(piece_a, piece_b);
    if (known != PairTable::kAbsent) return known;
    memory_.deepest_.insert(piece_a, piece_b, i);
    return i;
  }

  std::uint32_t regionOf(std::uint32_t number, std::uint32_t first) const {
    for (std::uint32_t m = memory_.cells_[number].regions; m != kNone; m = memory_.memberships_[m].next) {
      const std::uint32_t region = memory_.memberships_[m].region;
      if (memory_.regions_[region].first == first) return region;
    }
    return kNone;
  }

  double squaredLevelOf(const Link& link) const {
    return (scene_.frames.rotation * link.point_b + scene_.frames.offset - link.point_a).squaredNorm();
  }

  /// Whether known links lead below the start or to an earlier seed without rising to its level.
  bool followsDown(std::uint32_t i, std::uint32_t number) {
    const double distance = memory_.judged_[i].seed.distance;
    const double level = levelOf(distance);
    const double below = distance - tolerance_;
    const auto settle = [&](std::uint32_t into, std::uint32_t cell) {
      set(i, Verdict::Ripple, into);
      memory_.judged_[i].below = {memory_.cells_[cell].a, memory_.cells_[cell].b};
      ++memory_.counts_.by_path;
      return true;
    };
    for (int step = 0; step < kLongestPath; ++step) {
      const Cell& cell = memory_.cells_[number];
      const std::uint32_t other = step > 0 ? seedOf(number) : kNone;
      if (other != kNone && other != i && isEarlier(other, i)) return settle(other, number);
      if (below > 0.0 && cell.low != kNone && squaredLevelOf(memory_.links_[cell.low]) < below * below) {
        memory_.links_[cell.low].used = memory_.cycle_;
        return settle(kNone, number);
      }
      if (cell.link == kNone) return false;
      Link& link = memory_.links_[cell.link];
      const double squared_level = squaredLevelOf(link);
      if (!(squared_level < level * level)) return false;
      link.used = memory_.cycle_;
      number = link.next;
      if (below > 0.0 && squared_level < below * below) return settle(kNone, number);
    }
    return false;
  }

  CellFlood::Levels levelsOf(double distance) const {
    return {distance - tolerance_, distance + tolerance_, levelOf(distance) + tolerance_};
  }

  /// Whether the border around a region holds, or does so again with the cells beyond where it does not.
  bool isEnclosed(std::uint32_t i, std::uint32_t index) {
    Region& region = memory_.regions_[index];
    const double distance = memory_.judged_[i].seed.distance;
    const CellFlood::Levels levels = levelsOf(distance);
    memory_.counts_.measured += region.border.takeCrossed(memory_.borders_, scene_, levels.highest);
    const std::vector<BorderElement>& crossed = memory_.borders_.crossed;
    if (crossed.empty()) {
      ++memory_.counts_.by_border;
      return true;
    }
    const auto is_inside = [&](TriangleIndex a, TriangleIndex b) { return isIn(a, b, index); };
    CellFlood& flood = memory_.flood_;
    flood.beginBeyond(levels);
    for (const BorderElement& element : crossed) {
      const TrianglePair pair = element.pairBeyond();
      if (!is_inside(pair.a, pair.b) && !flood.enterBeyond(pair.a, pair.b, 0.0, limit_)) return false;
    }
    const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
    const std::size_t largest = 2 * region.cells_at_begin + kSmallRegion;
    const std::size_t most = largest - std::min(region.cells, largest);
    const CellFlood::End end = flood.proceed(scene_, most, meets, is_inside, limit_);
    memory_.counts_.flooded_cells += static_cast<std::uint32_t>(flood.lookedAt());
    if (end == CellFlood::End::Enclosed && extend(index)) {
      ++memory_.counts_.mended;
      return true;
    }
    if (end == CellFlood::End::Cut) {
      for (const BorderElement& element : crossed)
        region.border.add(memory_.borders_, scene_, element, 0.0, limit_);
    }
    return false;
  }

  bool isIn(TriangleIndex a, TriangleIndex b, std::uint32_t region) const {
    const std::uint32_t cell = memory_.table_.find(a, b);
    if (cell == PairTable::kAbsent) return false;
    for (std::uint32_t m = memory_.cells_[cell].regions; m != kNone; m = memory_.memberships_[m].next) {
      if (memory_.memberships_[m].region == region) return true;
    }
    return false;
  }

  std::uint32_t seedIn(TriangleIndex a, TriangleIndex b) const {
    const std::uint32_t cell = memory_.table_.find(a, b);
    return cell != PairTable::kAbsent ? seedOf(cell) : kNone;
  }

  /// Whether a cell is that of a minimum that i would belong to.
  bool isOfEarlier(TriangleIndex a, TriangleIndex b, std::uint32_t i) const {
    const std::uint32_t other = seedIn(a, b);
    return other != kNone && other != i && isEarlier(other, i);
  }

  void flood(std::uint32_t i) {
    const MinimumSeed seed = memory_.judged_[i].seed;
    const std::uint32_t number = cellOf(seed.a, seed.b);
    std::uint64_t id = 0;
    if (const std::uint32_t broken = regionOf(number, i); broken != kNone) {
      // Kept for the next pose when there is no time for a flood.
      memory_.regions_[broken].confirmed = limit_.isOver();
      if (limit_.isOver()) return set(i, Verdict::Undecided);
      id = memory_.regions_[broken].id;
      memory_.drop(broken);
    }
    deepest_ = deepestLike(i);
    // Floods of this pose may have left a path.
    if (followsDown(i, number) || (were_long_ && settlesLong(i))) return;
    ++memory_.counts_.floods;
    CellFlood& flood = memory_.flood_;
    flood.begin(seed.a, seed.b, levelsOf(seed.distance));
    const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
    const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
    CellFlood::End end = flood.proceed(scene_, kLongFlood, meets, is_inside, limit_);
    if (end == CellFlood::End::Long) {
      if (settlesLong(i)) return;
      end = flood.proceed(scene_, std::numeric_limits<std::size_t>::max(), meets, is_inside, limit_);
    }
    memory_.counts_.flooded_cells += static_cast<std::uint32_t>(flood.lookedAt());
    switch (end) {
      case CellFlood::End::Enclosed:
        set(i, Verdict::Niche);
        if (request_.is_tracked && seed.distance > tolerance_) keepRegion(i, id);
        break;
      case CellFlood::End::Below: {
        set(i, Verdict::Ripple);
        const CellFlood::Cell& last = flood.cells()[flood.last()];
        memory_.judged_[i].below = {last.a, last.b};
        if (request_.is_tracked) {
          keepPath(number);
          keepLow(last.a, last.b);
        }
        descend(i);
        break;
      }
      case CellFlood::End::Met:
        set(i, Verdict::Ripple, seedIn(flood.cells()[flood.last()].a, flood.cells()[flood.last()].b));
        if (request_.is_tracked) keepPath(number);
        break;
      default:
        set(i, Verdict::Undecided);
        break;
    }
  }

  /// From the place below a ripple to the minimum under it.
  void descend(std::uint32_t i) {
    const TrianglePair from = memory_.judged_[i].below;
    const WitnessPair bottom =
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, from.a, from.b, memory_.refinement_).witness;
    const std::uint32_t place = enterPlace(bottom);
    if (place != i) memory_.judged_[i].into = place;
  }

  /// Replaces a long flood: the deepest of its pieces is a niche if it is their nearest place; another one is
  /// none if a path leads from it to one that is deeper.
  bool settlesLong(std::uint32_t i) {
    const bool settled = i == deepest_ ? isNearest(i) : hasPathDown(i);
    memory_.floods_are_long_ = memory_.floods_are_long_ || settled;
    return settled;
  }

  /// Seeds may leave out minima through material, so the deepest seed need not be the nearest place.
  bool isNearest(std::uint32_t i) {
    const MinimumSeed seed = memory_.judged_[i].seed;
    const WitnessPair minimum =
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, seed.a, seed.b, memory_.refinement_).witness;
    if (!isNearestOfItsPieces(scene_, minimum)) {
      const TrianglePair pair{seed.a, seed.b};
      CertificateRequest certificate;
      certificate.limit = &limit_;
      if (certifyDistance(scene_.a, scene_.b, scene_.a_from_b, &pair, 1, certificate, proof_).lower_bound <
          seed.distance - tolerance_) {
        return false;
      }
    }
    set(i, Verdict::Niche);
    return true;
  }

  bool hasPathDown(std::uint32_t i) {
    std::uint32_t into = kNone;
    const auto has_arrived = [&](TriangleIndex a, TriangleIndex b) {
      into = seedIn(a, b);
      return into != kNone && into != i && isEarlier(into, i);
    };
    const MinimumSeed& from = memory_.judged_[i].seed;
    const MinimumSeed& to = memory_.judged_[deepest_].seed;
    for (const int first_moves : {0, 1}) {
      if (LevelPath(scene_, memory_.path_, limit_)
              .find({from.a, from.b}, {to.a, to.b}, levelOf(from.distance), first_moves, has_arrived)) {
        set(i, Verdict::Ripple, into != kNone && into != i ? into : deepest_);
        return true;
      }
    }
    return false;
  }

  /// The links of the way from the start of the last flood to its end.
  void keepPath(std::uint32_t start) {
    const std::vector<CellFlood::Cell>& visited = memory_.flood_.cells();
    std::uint32_t at = memory_.flood_.last();
    std::uint32_t next = cellOf(visited[at].a, visited[at].b);
    while (next != kNone && visited[at].parent != CellFlood::kNone) {
      const CellFlood::Cell& here = visited[at];
      const std::uint32_t before =
          here.parent == 0 ? start : cellOf(visited[here.parent].a, visited[here.parent].b);
      if (before == kNone || !keepLink(memory_.cells_[before].link, closestOver(scene_, here.via), next))
        return;
      next = before;
      at = here.parent;
    }
  }

  void keepLow(TriangleIndex a, TriangleIndex b) {
    const std::uint32_t number = cellOf(a, b);
    if (number == kNone) return;
    keepLink(memory_.cells_[number].low, triangleDistance(scene_.cornersOfA(a), scene_.cornersOfB(b)),
             number);
  }

  bool keepLink(std::uint32_t& link, const TrianglePairDistance& closest, std::uint32_t next) {
    if (link == kNone) {
      if (!limit_.makeRoom(memory_.links_)) return false;
      link = static_cast<std::uint32_t>(memory_.links_.size());
      memory_.links_.emplace_back();
    }
    memory_.links_[link] = {closest.point_a, scene_.frames.pointInB(closest.point_b), next, memory_.cycle_};
    return true;
  }

  /// Surfaces in the material of other shells hold minima that no cone leads to: what a region holds may come
  /// nearer there without a seed.
  bool hasJoints() const { return !scene_.a.joints().joints.empty() || !scene_.b.joints().joints.empty(); }

  /// What the last flood has visited.
  void keepRegion(std::uint32_t i, std::uint64_t id) {
    const std::vector<CellFlood::Cell>& visited = memory_.flood_.cells();
    if (visited.size() > kLargestRegion || hasJoints()) return;
    if (memory_.free_regions_.empty()) {
      if (!limit_.makeRoom(memory_.regions_) || !limit_.makeRoom(memory_.free_regions_)) return;
      memory_.free_regions_.push_back(static_cast<std::uint32_t>(memory_.regions_.size()));
      memory_.regions_.emplace_back();
    }
    // The one that was dropped last comes first: an id keeps its place.
    const std::uint32_t index = memory_.free_regions_.back();
    memory_.free_regions_.pop_back();
    Region& region = memory_.regions_[index];
    region.id = id != 0 ? id : (++memory_.regions_made_ << 32U) | index;
    region.confirmed = true;
    region.first = i;
    region.cells_at_begin = visited.size();
    const MinimumSeed& seed = memory_.judged_[i].seed;
    const TrianglePairDistance closest =
        triangleDistance(scene_.cornersOfA(seed.a), scene_.cornersOfB(seed.b));
    region.border.begin(memory_.borders_, closest.point_a, scene_.frames.pointInB(closest.point_b));
    memory_.judged_[i].region = region.id;
    if (!extend(index)) memory_.drop(index);
  }

  /// By what the last flood has visited. False without memory.
  bool extend(std::uint32_t index) {
    Region& region = memory_.regions_[index];
    for (const CellFlood::Cell& cell : memory_.flood_.cells()) {
      const std::uint32_t number = cellOf(cell.a, cell.b);
      if (number == kNone || !join(number, index)) return false;
    }
    bool has_room = true;
    memory_.flood_.forEachBorderStep(
        [&](TriangleIndex a, TriangleIndex b) { return isIn(a, b, index); },
        [&](const CellFlood::BorderStep& step) {
          const TriangleIndex beyond = step.element.side == Side::A ? step.beyond_a : step.beyond_b;
          has_room = has_room && region.border.add(memory_.borders_, scene_, {step.element, beyond},
                                                   std::sqrt(step.squared_level), limit_);
        });
    return has_room;
  }

  bool join(std::uint32_t number, std::uint32_t region) {
    std::uint32_t m = memory_.free_membership_;
    if (m != kNone) {
      memory_.free_membership_ = memory_.memberships_[m].next;
    } else {
      if (!limit_.makeRoom(memory_.memberships_)) return false;
      m = static_cast<std::uint32_t>(memory_.memberships_.size());
      memory_.memberships_.emplace_back();
    }
    Region& owner = memory_.regions_[region];
    memory_.memberships_[m] = {region, number, memory_.cells_[number].regions, owner.members};
    memory_.cells_[number].regions = owner.members = m;
    ++owner.cells;
    return true;
  }

  MinimaVerdicts& memory_;
  const MinimaScene& scene_;
  const Request& request_;
  WorkLimit& limit_;
  CertificateWorkspace proof_;
  double tolerance_;
  bool were_long_ = false;  ///< floods, the last time
  std::uint32_t seed_count_ = 0;
  std::uint32_t deepest_ = kNone;  ///< of the pieces of the one that is decided
};

void MinimaVerdicts::clear() {
  table_.clear();
  cells_.clear();
  links_.clear();
  memberships_.clear();
  free_membership_ = kNone;
  regions_.clear();
  free_regions_.clear();
  borders_.clear();
  live_cells_ = 0;
  turn_ = 0;
  floods_are_long_ = false;
}

void MinimaVerdicts::begin(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
                           WorkLimit& limit) {
  dropUnconfirmed();
  compact();
  if (request.is_tracked) {
    cells_.reserve(kSmallTable);
    links_.reserve(kSmallTable);
  }
  ++cycle_;
  counts_ = {};
  judged_.clear();
  deepest_.clear();
  std::sort(seeds.begin(), seeds.end(), [](const MinimumSeed& l, const MinimumSeed& r) {
    if (l.distance != r.distance) return l.distance < r.distance;
    return l.a != r.a ? l.a < r.a : l.b < r.b;
  });
  Stage stage(*this, scene, request, limit);
  stage.enter(seeds);
  is_far_ = isFar(scene, request.least_prominence);
  next_ = end_ = 0;
  if (!is_far_) return;
  stage.decideFar();
  next_ = end_ = seed_count_;
}

void MinimaVerdicts::judgeByMemory(const MinimaScene& scene, const Request& request, WorkLimit& limit) {
  Stage stage(*this, scene, request, limit);
  stage.resume();
  stage.decideByMemory();
}

void MinimaVerdicts::judgeByFloods(const MinimaScene& scene, const Request& request, WorkLimit& limit) {
  Stage stage(*this, scene, request, limit);
  stage.resume();
  stage.decideByFloods();
}

void MinimaVerdicts::judge(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
                           WorkLimit& limit) {
  begin(scene, seeds, request, limit);
  judgeByMemory(scene, request, limit);
  judgeByFloods(scene, request, limit);
}

void MinimaVerdicts::dropUnconfirmed() {
  for (std::uint32_t i = 0; i < regions_.size(); ++i) {
    if (regions_[i].id != 0 && !regions_[i].confirmed) drop(i);
  }
}

void MinimaVerdicts::drop(std::uint32_t index) {
  Region& region = regions_[index];
  for (std::uint32_t m = region.members; m != kNone;) {
    Membership& membership = memberships_[m];
    std::uint32_t* at = &cells_[membership.cell].regions;
    while (*at != m) at = &memberships_[*at].next;
    *at = membership.next;
    const std::uint32_t next = membership.next_of_region;
    membership.next = free_membership_;
    free_membership_ = m;
    m = next;
  }
  region.members = kNone;
  region.cells = 0;
  region.border.clear(borders_);
  region.id = 0;
  free_regions_.push_back(index);
}

/// Cells of which nothing is known any more go.
void MinimaVerdicts::compact() {
  if (cells_.size() <= 2 * live_cells_ + kSmallTable) return;
  std::vector<char>& live = live_;
  refill(live, cells_.size(), char{0});
  const auto isUsed = [&](std::uint32_t link) {
    return link != kNone && links_[link].used + kKeptCycles > cycle_;
  };
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    const bool is_hidden = cell.cycle == cycle_ && cell.occluder.triangle != kNoTriangle;
    if (is_hidden || cell.regions != kNone || isUsed(cell.low)) live[i] = 1;
    if (isUsed(cell.link)) live[i] = live[links_[cell.link].next] = 1;
  }
  std::vector<std::uint32_t>& places = places_;
  refill(places, cells_.size(), kNone);
  table_.clear();
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (live[i] == 0) continue;
    places[i] = count;
    cells_[count] = cells_[i];
    table_.insert(cells_[count].a, cells_[count].b, count);
    ++count;
  }
  cells_.resize(count);
  live_cells_ = count;
  std::vector<Link>& links = spare_links_;
  links.clear();
  const auto keep = [&](std::uint32_t& link) {
    if (!isUsed(link)) {
      link = kNone;
      return;
    }
    links.push_back(links_[link]);
    links.back().next = places[links.back().next];
    link = static_cast<std::uint32_t>(links.size() - 1);
  };
  for (Cell& cell : cells_) {
    keep(cell.link);
    keep(cell.low);
  }
  links_.swap(links);
  for (const Region& region : regions_) {
    for (std::uint32_t m = region.members; m != kNone; m = memberships_[m].next_of_region) {
      memberships_[m].cell = places[memberships_[m].cell];
    }
  }
}

std::uint32_t MinimaVerdicts::locate(const MinimaScene& scene, const TrianglePair& around,
                                     const Request& request, WorkLimit& limit) {
  Stage stage(*this, scene, request, limit);
  stage.resume();
  const std::uint32_t place = stage.placeAround(around);
  if (place == kNone) return kNone;
  if (judged_[place].verdict == Verdict::Open) {
    if (is_far_) {
      stage.decideFar();
    } else {
      stage.decide(place);
    }
  }
  stage.resolve(place);
  const std::uint32_t end = endOf(place);
  if (end != kNone && judged_[end].verdict == Verdict::Undecided) return kUndecided;
  return nicheOf(place);
}

std::uint32_t MinimaVerdicts::nicheWith(std::uint64_t region) const {
  const auto place = static_cast<std::uint32_t>(region & 0xffffffffU);
  if (region == 0 || place >= regions_.size() || regions_[place].id != region || !regions_[place].confirmed) {
    return kNone;
  }
  return nicheOf(regions_[place].first);
}

std::uint32_t MinimaVerdicts::endOf(std::uint32_t index) const {
  while (index != kNone && judged_[index].verdict == Verdict::Ripple) index = judged_[index].into;
  return index;
}

std::uint32_t MinimaVerdicts::nicheOf(std::uint32_t of) const {
  const std::uint32_t index = endOf(of);
  return index != kNone && judged_[index].verdict == Verdict::Niche ? index : kNone;
}

std::size_t MinimaVerdicts::memoryBytes() const {
  return borders_.memoryBytes() + table_.memoryBytes() + cells_.capacity() * sizeof(Cell) +
         (links_.capacity() + spare_links_.capacity()) * sizeof(Link) +
         memberships_.capacity() * sizeof(Membership) + regions_.capacity() * sizeof(Region) +
         judged_.capacity() * sizeof(Judged) + flood_.memoryBytes() + path_.memoryBytes() + live_.capacity() +
         places_.capacity() * sizeof(std::uint32_t);
}

}  // namespace concave_distance::detail
