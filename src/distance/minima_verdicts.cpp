#include "minima_verdicts.h"

#include <algorithm>
#include <cmath>

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
/// A region that has grown to more than twice its size and this many cells is made anew.
constexpr std::size_t kSmallRegion = 64;

}  // namespace

/// One call of judge().
class MinimaVerdicts::Stage {
 public:
  Stage(MinimaVerdicts& verdicts, const MinimaScene& scene, const Request& request, WorkLimit& limit)
      : verdicts_(verdicts),
        memory_(verdicts.memory_),
        scene_(scene),
        request_(request),
        limit_(limit),
        tolerance_(8.0 * scene.rounding) {}

  /// Every seed with its cell, and every region with the deepest seed in it.
  void enter(const std::vector<MinimumSeed>& seeds) {
    were_long_ = verdicts_.floods_are_long_;
    verdicts_.floods_are_long_ = false;
    for (const MinimumSeed& seed : seeds) {
      const auto index = static_cast<std::uint32_t>(verdicts_.judged_.size());
      verdicts_.judged_.emplace_back();
      verdicts_.judged_.back().seed = seed;
      const std::uint32_t number = numberOf(seed);
      if (number == kNone) continue;
      memory_.enterSeed(number, index);
    }
    seed_count_ = verdicts_.seed_count_ = static_cast<std::uint32_t>(verdicts_.judged_.size());
  }

  /// Goes on with what enter() of an earlier stage at this pose has left.
  void resume() {
    seed_count_ = verdicts_.seed_count_;
    were_long_ = verdicts_.floods_are_long_;
  }

  std::uint32_t placeAround(const TrianglePair& pair) {
    const std::uint32_t in_cell = seedAround(pair.a, pair.b);
    if (in_cell != kNone) return in_cell;
    return enterPlace(
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, pair.a, pair.b, verdicts_.refinement_).witness);
  }

  /// The minimum among the judged: the seed at its place, or an entry of its own; kNone through material.
  std::uint32_t enterPlace(const WitnessPair& minimum) {
    const std::uint32_t in_cell = seedAround(minimum.triangle_a, minimum.triangle_b);
    if (in_cell != kNone) return in_cell;
    const MinimumSeed seed = scene_.seedOf(minimum);
    const auto begin = verdicts_.judged_.begin();
    const auto found = begin + seed_count_;
    const auto is_there = [&](const Judged& other) { return isSamePlace(other.seed, seed); };
    const auto is_nearer = [](const Judged& judged, double distance) {
      return judged.seed.distance < distance;
    };
    const auto nearest = std::lower_bound(begin, found, seed.distance - tolerance_, is_nearer);
    const auto farthest = std::lower_bound(nearest, found, seed.distance + 2.0 * tolerance_, is_nearer);
    auto known = std::find_if(nearest, farthest, is_there);
    if (known == farthest) known = std::find_if(found, verdicts_.judged_.end(), is_there);
    if (known != verdicts_.judged_.end()) return static_cast<std::uint32_t>(known - begin);
    if (!request_.through_material && isThroughMaterial(minimum)) return kNone;
    verdicts_.judged_.emplace_back();
    verdicts_.judged_.back().seed = seed;
    verdicts_.judged_.back().was_found = true;
    return static_cast<std::uint32_t>(verdicts_.judged_.size() - 1);
  }

  void decideFar() {
    for (std::uint32_t i = 0; i < verdicts_.judged_.size(); ++i) {
      if (verdicts_.judged_[i].verdict != Verdict::Open) continue;
      const std::uint32_t deepest = deepestLike(i);
      set(i, deepest == i ? Verdict::Niche : Verdict::Ripple, deepest == i ? kNone : deepest);
    }
  }

  /// The next ones that are known, until there are as many niches as wanted.
  void decideByMemory() {
    std::size_t niches = 0;
    for (std::uint32_t& end = verdicts_.end_; end < seed_count_ && niches < request_.most_niches; ++end) {
      if (verdicts_.judged_[end].verdict == Verdict::Open) decideByMemory(end);
      niches += verdicts_.judged_[end].verdict == Verdict::Niche ? 1 : 0;
    }
  }

  /// Those that it has left open, in ascending order until there are as many niches as wanted.
  void decideByFloods() {
    if (limit_.isTimed()) floodInTurn();
    std::size_t niches = 0;
    for (std::uint32_t& i = verdicts_.next_; i < verdicts_.end_ && niches < request_.most_niches; ++i) {
      if (verdicts_.judged_[i].verdict == Verdict::Open) flood(i);
      niches += verdicts_.judged_[i].verdict == Verdict::Niche ? 1 : 0;
    }
    verdicts_.end_ = verdicts_.next_;
  }

  /// Where time may be short, others come first in every cycle.
  void floodInTurn() {
    const std::uint32_t count = verdicts_.end_ - verdicts_.next_;
    if (count == 0) return;
    std::uint32_t done = 0;
    for (; done < count && !limit_.isOver(); ++done) {
      const std::uint32_t i = verdicts_.next_ + (verdicts_.turn_ + done) % count;
      if (verdicts_.judged_[i].verdict == Verdict::Open) flood(i);
    }
    verdicts_.turn_ = (verdicts_.turn_ + done) % count;
  }

  void decide(std::uint32_t i) {
    decideByMemory(i);
    if (verdicts_.judged_[i].verdict == Verdict::Open) flood(i);
  }

  /// The next deeper minimum of a ripple of which only a deeper place is known.
  void resolve(std::uint32_t i) {
    while (i != kNone && verdicts_.judged_[i].verdict == Verdict::Ripple) {
      if (verdicts_.judged_[i].into == kNone) descend(i);
      const std::uint32_t into = verdicts_.judged_[i].into;
      if (into != kNone && verdicts_.judged_[into].verdict == Verdict::Open) decide(into);
      i = into;
    }
  }

 private:
  /// Leaves open what is not known.
  void decideByMemory(std::uint32_t i) {
    const MinimumSeed seed = verdicts_.judged_[i].seed;
    deepest_ = deepestLike(i);
    const std::uint32_t number = numberOf(seed);
    if (number == kNone) return set(i, Verdict::Undecided);
    if (const std::uint32_t other = memory_.seedOf(number);
        other != kNone && other != i && isEarlier(other, i)) {
      return set(i, Verdict::Ripple, other);
    }
    if (i > 0 && i < seed_count_ && isSamePlace(verdicts_.judged_[i - 1].seed, seed))
      return set(i, Verdict::Ripple, i - 1);
    if (followsDown(i, number)) return;
    if (request_.is_wanted && !request_.is_wanted(seed, memory_.cell(number).occluder)) {
      return set(i, Verdict::Unwanted);
    }
    if (!request_.through_material && hasJoints() && isThroughMaterial(scene_.witnessOf(seed))) {
      return set(i, Verdict::Unwanted);
    }
    const std::uint32_t known = memory_.regionOf(number, i);
    if (known == kNone) return;
    VerdictMemory::Region& region = memory_.region(known);
    region.confirmed = isEnclosed(i, known);
    if (region.confirmed) {
      verdicts_.judged_[i].region = region.id;
      return set(i, Verdict::Niche);
    }
  }

  bool isThroughMaterial(const WitnessPair& minimum) const {
    return classifyOutwardness(scene_.a, scene_.b, scene_.a_from_b, minimum) == Outwardness::ThroughMaterial;
  }

  /// Only then do seeds lie on both sides of a closed shell (collectConeItems()).
  bool hasJoints() const { return !scene_.a.joints().joints.empty() || !scene_.b.joints().joints.empty(); }

  /// Of the seed's cell; kNone without memory.
  std::uint32_t numberOf(const MinimumSeed& seed) {
    const TrianglePair cell = scene_.cellOf(seed.a, seed.b);
    return memory_.cellOf(cell.a, cell.b, limit_);
  }

  /// The seed in the cell of a triangle pair.
  std::uint32_t seedAround(TriangleIndex a, TriangleIndex b) const {
    const TrianglePair cell = scene_.cellOf(a, b);
    return memory_.seedIn(cell.a, cell.b);
  }

  /// Up to here nothing deeper may be reached.
  double levelOf(double distance) const { return (1.0 + request_.least_prominence) * distance; }

  void set(std::uint32_t i, Verdict verdict, std::uint32_t into = kNone) {
    verdicts_.judged_[i].verdict = verdict;
    verdicts_.judged_[i].into = into;
  }

  /// Seeds are in ascending order; what is no seed belongs to one as deep as itself.
  bool isEarlier(std::uint32_t other, std::uint32_t i) const {
    if (i < seed_count_) return other < i;
    return verdicts_.judged_[other].seed.distance <= verdicts_.judged_[i].seed.distance + tolerance_;
  }

  /// Where shells of one body lie on each other, both have the minimum.
  bool isSamePlace(const MinimumSeed& l, const MinimumSeed& r) const {
    return l.is_measured && r.is_measured &&
           (l.point_a - r.point_a).squaredNorm() + (l.point_b - r.point_b).squaredNorm() <=
               tolerance_ * tolerance_;
  }

  std::uint32_t deepestLike(std::uint32_t i) {
    const MinimumSeed& seed = verdicts_.judged_[i].seed;
    const TriangleIndex piece_a{scene_.pieces_a.piece_of_triangle[seed.a.value]};
    const TriangleIndex piece_b{scene_.pieces_b.piece_of_triangle[seed.b.value]};
    const std::uint32_t known = verdicts_.deepest_.find(piece_a, piece_b);
    if (known != PairTable::kAbsent) return known;
    verdicts_.deepest_.insert(piece_a, piece_b, i);
    return i;
  }

  double squaredLevelOf(const VerdictMemory::Link& link) const {
    return (scene_.frames.rotation * link.point_b + scene_.frames.offset - link.point_a).squaredNorm();
  }

  /// Whether known links lead below the start or to an earlier seed without rising to its level.
  bool followsDown(std::uint32_t i, std::uint32_t number) {
    const double distance = verdicts_.judged_[i].seed.distance;
    const double level = levelOf(distance);
    const double below = distance - tolerance_;
    const auto settle = [&](std::uint32_t into, std::uint32_t cell) {
      set(i, Verdict::Ripple, into);
      verdicts_.judged_[i].below = {memory_.cell(cell).a, memory_.cell(cell).b};
      ++verdicts_.counts_.by_path;
      return true;
    };
    for (int step = 0; step < kLongestPath; ++step) {
      const VerdictMemory::Cell& cell = memory_.cell(number);
      const std::uint32_t other = step > 0 ? memory_.seedOf(number) : kNone;
      if (other != kNone && other != i && isEarlier(other, i)) return settle(other, number);
      if (below > 0.0 && cell.low != kNone &&
          (squaredLevelOf(memory_.link(cell.low)) < below * below ||
           (cell.link == kNone && aimLow(number) < below * below))) {
        memory_.use(cell.low);
        return settle(kNone, number);
      }
      if (cell.link == kNone) return false;
      double squared_level = squaredLevelOf(memory_.link(cell.link));
      if (!(squared_level < level * level)) squared_level = aim(cell.link);
      if (!(squared_level < level * level)) return false;
      memory_.use(cell.link);
      number = memory_.link(cell.link).next;
      if (below > 0.0 && squared_level < below * below) return settle(kNone, number);
    }
    return false;
  }

  /// Gives a link the points at which the cells are closest over what they have in common, and their squared
  /// distance.
  double aim(std::uint32_t link) { return aim(link, closestOver(scene_, memory_.link(link).via)); }

  /// The same for the points in a cell.
  double aimLow(std::uint32_t number) {
    const VerdictMemory::Cell& cell = memory_.cell(number);
    return aim(cell.low, scene_.closestIn({cell.a, cell.b}).second);
  }

  double aim(std::uint32_t link, const TrianglePairDistance& closest) {
    ++verdicts_.counts_.aimed;
    memory_.aim(link, closest.point_a, scene_.frames.pointInB(closest.point_b));
    return closest.squared_distance;
  }

  CellFlood::Levels levelsOf(double distance) const {
    return {distance - tolerance_, distance + tolerance_, levelOf(distance) + tolerance_};
  }

  /// Whether the border around a region holds, or does so again with the cells beyond where it does not.
  bool isEnclosed(std::uint32_t i, std::uint32_t index) {
    VerdictMemory::Region& region = memory_.region(index);
    const double distance = verdicts_.judged_[i].seed.distance;
    const CellFlood::Levels levels = levelsOf(distance);
    verdicts_.counts_.measured += region.border.takeCrossed(memory_.borders(), scene_, levels.highest);
    const std::vector<BorderElement>& crossed = memory_.borders().crossed;
    if (crossed.empty()) {
      ++verdicts_.counts_.by_border;
      return true;
    }
    const auto is_inside = [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); };
    CellFlood& flood = verdicts_.flood_;
    flood.beginBeyond(levels);
    for (const BorderElement& element : crossed) {
      const TrianglePair pair = element.pairBeyond();
      if (!is_inside(pair.a, pair.b) && !flood.enterBeyond(pair.a, pair.b, 0.0, limit_)) return false;
    }
    const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
    const std::size_t largest = 2 * region.cells_at_begin + kSmallRegion;
    const std::size_t most = largest - std::min(region.cells, largest);
    const CellFlood::End end = flood.proceed(scene_, most, meets, is_inside, limit_);
    verdicts_.counts_.flooded_cells += static_cast<std::uint32_t>(flood.lookedAt());
    if (end == CellFlood::End::Enclosed && extend(index)) {
      ++verdicts_.counts_.mended;
      return true;
    }
    if (end == CellFlood::End::Cut) {
      for (const BorderElement& element : crossed)
        region.border.add(memory_.borders(), scene_, element, 0.0, limit_);
    }
    return false;
  }

  /// Whether a cell is that of a minimum that i would belong to.
  bool isOfEarlier(TriangleIndex a, TriangleIndex b, std::uint32_t i) const {
    const std::uint32_t other = memory_.seedIn(a, b);
    return other != kNone && other != i && isEarlier(other, i);
  }

  void flood(std::uint32_t i) {
    const MinimumSeed seed = verdicts_.judged_[i].seed;
    const std::uint32_t number = numberOf(seed);
    std::uint64_t id = 0;
    if (const std::uint32_t broken = memory_.regionOf(number, i); broken != kNone) {
      // Kept for the next pose when there is no time for a flood.
      memory_.region(broken).confirmed = limit_.isOver();
      if (limit_.isOver()) return set(i, Verdict::Undecided);
      id = memory_.region(broken).id;
      memory_.drop(broken);
    }
    deepest_ = deepestLike(i);
    // Floods of this pose may have left a path.
    if (followsDown(i, number) || (were_long_ && settlesLong(i))) return;
    ++verdicts_.counts_.floods;
    CellFlood& flood = verdicts_.flood_;
    const TrianglePair start = scene_.cellOf(seed.a, seed.b);
    flood.begin(start.a, start.b, levelsOf(seed.distance));
    const auto meets = [&](TriangleIndex a, TriangleIndex b) { return isOfEarlier(a, b, i); };
    const auto is_inside = [](TriangleIndex, TriangleIndex) { return false; };
    CellFlood::End end = flood.proceed(scene_, kLongFlood, meets, is_inside, limit_);
    if (end == CellFlood::End::Long) {
      if (settlesLong(i)) return;
      end = flood.proceed(scene_, std::numeric_limits<std::size_t>::max(), meets, is_inside, limit_);
    }
    verdicts_.counts_.flooded_cells += static_cast<std::uint32_t>(flood.lookedAt());
    switch (end) {
      case CellFlood::End::Enclosed:
        set(i, Verdict::Niche);
        if (request_.is_tracked && seed.distance > tolerance_) keepRegion(i, id);
        break;
      case CellFlood::End::Below: {
        set(i, Verdict::Ripple);
        const CellFlood::Cell& last = flood.cells()[flood.last()];
        verdicts_.judged_[i].below = {last.a, last.b};
        if (request_.is_tracked) {
          keepPath(number);
          keepLow(last.a, last.b);
        }
        descend(i);
        break;
      }
      case CellFlood::End::Met:
        set(i, Verdict::Ripple, memory_.seedIn(flood.cells()[flood.last()].a, flood.cells()[flood.last()].b));
        if (request_.is_tracked) keepPath(number);
        break;
      default:
        set(i, Verdict::Undecided);
        break;
    }
  }

  /// From the place below a ripple to the minimum under it.
  void descend(std::uint32_t i) {
    const TrianglePair from = scene_.closestIn(verdicts_.judged_[i].below).first;
    const WitnessPair bottom =
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, from.a, from.b, verdicts_.refinement_).witness;
    const std::uint32_t place = enterPlace(bottom);
    if (place != i) verdicts_.judged_[i].into = place;
  }

  /// Replaces a long flood: the deepest of its pieces is a niche if it is their nearest place; another one is
  /// none if a path leads from it to one that is deeper.
  bool settlesLong(std::uint32_t i) {
    const bool settled = i == deepest_ ? isNearest(i) : hasPathDown(i);
    verdicts_.floods_are_long_ = verdicts_.floods_are_long_ || settled;
    return settled;
  }

  /// Seeds may leave out minima through material, so the deepest seed need not be the nearest place.
  bool isNearest(std::uint32_t i) {
    const MinimumSeed seed = verdicts_.judged_[i].seed;
    const WitnessPair minimum =
        refineWitness(scene_.a, scene_.b, scene_.a_from_b, seed.a, seed.b, verdicts_.refinement_).witness;
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
      into = memory_.seedIn(a, b);
      return into != kNone && into != i && isEarlier(into, i);
    };
    const MinimumSeed& from = verdicts_.judged_[i].seed;
    const MinimumSeed& to = verdicts_.judged_[deepest_].seed;
    for (const int first_moves : {0, 1}) {
      if (LevelPath(scene_, verdicts_.path_, limit_)
              .find(scene_.cellOf(from.a, from.b), scene_.cellOf(to.a, to.b), levelOf(from.distance),
                    first_moves, has_arrived)) {
        set(i, Verdict::Ripple, into != kNone && into != i ? into : deepest_);
        return true;
      }
    }
    return false;
  }

  /// The links of the way from the start of the last flood to its end.
  void keepPath(std::uint32_t start) {
    const std::vector<CellFlood::Cell>& visited = verdicts_.flood_.cells();
    std::uint32_t at = verdicts_.flood_.last();
    std::uint32_t next = memory_.cellOf(visited[at].a, visited[at].b, limit_);
    while (next != kNone && visited[at].parent != CellFlood::kNone) {
      const CellFlood::Cell& here = visited[at];
      const std::uint32_t before =
          here.parent == 0 ? start : memory_.cellOf(visited[here.parent].a, visited[here.parent].b, limit_);
      if (before == kNone ||
          !keepLink(memory_.cell(before).link, closestOver(scene_, here.via), next, here.via))
        return;
      next = before;
      at = here.parent;
    }
  }

  void keepLow(TriangleIndex a, TriangleIndex b) {
    const std::uint32_t number = memory_.cellOf(a, b, limit_);
    if (number == kNone) return;
    keepLink(memory_.cell(number).low, scene_.closestIn({a, b}).second, number, {});
  }

  bool keepLink(std::uint32_t& link, const TrianglePairDistance& closest, std::uint32_t next,
                const SharedElement& via) {
    return memory_.keepLink(link, {closest.point_a, scene_.frames.pointInB(closest.point_b), next, via},
                            limit_);
  }

  /// What the last flood has visited.
  void keepRegion(std::uint32_t i, std::uint64_t id) {
    const std::vector<CellFlood::Cell>& visited = verdicts_.flood_.cells();
    if (visited.size() > kLargestRegion) return;
    const std::uint32_t index = memory_.takeRegion(id, limit_);
    if (index == kNone) return;
    VerdictMemory::Region& region = memory_.region(index);
    region.confirmed = true;
    region.first = i;
    region.cells_at_begin = visited.size();
    const MinimumSeed& seed = verdicts_.judged_[i].seed;
    const TrianglePairDistance closest =
        triangleDistance(scene_.cornersOfA(seed.a), scene_.cornersOfB(seed.b));
    region.border.begin(memory_.borders(), closest.point_a, scene_.frames.pointInB(closest.point_b));
    verdicts_.judged_[i].region = region.id;
    if (!extend(index)) memory_.drop(index);
  }

  /// By what the last flood has visited. False without memory.
  bool extend(std::uint32_t index) {
    VerdictMemory::Region& region = memory_.region(index);
    for (const CellFlood::Cell& cell : verdicts_.flood_.cells()) {
      const std::uint32_t number = memory_.cellOf(cell.a, cell.b, limit_);
      if (number == kNone || !memory_.join(number, index, limit_)) return false;
    }
    bool has_room = true;
    verdicts_.flood_.forEachBorderStep(
        [&](TriangleIndex a, TriangleIndex b) { return memory_.isIn(a, b, index); },
        [&](const CellFlood::BorderStep& step) {
          const TriangleIndex beyond = step.element.side == Side::A ? step.beyond_a : step.beyond_b;
          has_room = has_room && region.border.add(memory_.borders(), scene_, {step.element, beyond},
                                                   std::sqrt(step.squared_level), limit_);
        });
    return has_room;
  }

  MinimaVerdicts& verdicts_;
  VerdictMemory& memory_;
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
  memory_.clear();
  turn_ = 0;
  floods_are_long_ = false;
}

void MinimaVerdicts::begin(const MinimaScene& scene, std::vector<MinimumSeed>& seeds, const Request& request,
                           WorkLimit& limit) {
  memory_.beginCycle(request.is_tracked);
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
  return nicheOf(end);
}

std::uint32_t MinimaVerdicts::nicheWith(std::uint64_t region) const {
  const std::uint32_t index = memory_.regionWith(region);
  return index != kNone && memory_.region(index).confirmed ? nicheOf(memory_.region(index).first) : kNone;
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
  return memory_.memoryBytes() + judged_.capacity() * sizeof(Judged) + flood_.memoryBytes() +
         path_.memoryBytes();
}

}  // namespace concave_distance::detail
