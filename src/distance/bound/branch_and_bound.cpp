#include "branch_and_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "leaf_pair.h"

namespace concave_distance::detail {
namespace {

/// Before a cache of so many entries is reopened at another pose, the proof is tried without it.
constexpr std::size_t kWorthTrying = 128;

}  // namespace

BranchAndBound::BranchAndBound(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const CertificateRequest& request, CertificateWorkspace& workspace,
                               BoundCache* cache)
    : a_(a.hierarchy()),
      b_(b.hierarchy()),
      frame_(a, b, a_from_b),
      limit_(request.limit != nullptr ? *request.limit : unlimited_),
      cache_(cache),
      open_(workspace.open, limit_),
      nearest_(frame_, request, workspace.refinement, result_.cost),
      bounds_(frame_, nearest_, workspace, result_.cost) {}

DistanceCertificate BranchAndBound::run(const TrianglePair* starts, std::size_t start_count) {
  for (std::size_t i = 0; i < start_count; ++i) nearest_.begin(starts[i]);
  if (start_count == 0) dive();
  const double start_distance = nearest_.distance();
  if (partsAtRoots()) return conclude();  // a cache can wait
  if (cache_ != nullptr && !cache_->valid() && cache_->wait_ > 0) {
    --cache_->wait_;
    cache_ = nullptr;
  }
  if (cache_ != nullptr && cache_->valid() && isProvenAtOnce()) {
    result_.improved = nearest_.distance() < start_distance - frame_.error;
    return conclude();
  }
  const bool anew = cache_ == nullptr || !cache_->valid();
  if (anew) {
    beginAtRoots();
  } else {
    cache_->clear();  // until decide(): an exception must not leave it half opened
    reopenCache();
  }
  search();
  if (cache_ != nullptr) {
    if (cut_ || nearest_.squaredDistance() == 0.0) {
      cache_->clear();  // not everything is in it
    } else {
      cache_->decide(anew, result_.cost.box_bounds / static_cast<std::uint32_t>(Hierarchy::kWidth) +
                               result_.cost.leaf_pairs + (asked_again_ + 2 * leaves_asked_again_) / 3);
    }
  }
  result_.improved = nearest_.distance() < start_distance - frame_.error;
  return conclude();
}

// One way down to a pair of leaves, always to the nearer box, gives a distance to compare with.
void BranchAndBound::dive() {
  Slot a = Hierarchy::kRoot;
  Slot b = Hierarchy::kRoot;
  while (!isLeaf(a_.child(a)) || !isLeaf(b_.child(b))) {
    const bool opens_b = bounds_.opensB(a, b);
    const std::uint32_t opened = opens_b ? b_.child(b) : a_.child(a);
    (opens_b ? b : a) = slotOf(opened, bounds_.nearestChild(opens_b ? a : b, opened, opens_b));
  }
  nearest_.begin(nearestByCentres(leafOfA(a), leafOfB(b), frame_));
}

void BranchAndBound::beginAtRoots() {
  if (cache_ != nullptr) cache_->begin(b_, frame_.rotation, frame_.offset);
  open_.begin(root_separation_);
}

// Returns whether the direction between the closest points parts the bodies as wholes.
bool BranchAndBound::partsAtRoots() {
  if (nearest_.squaredDistance() == 0.0) return false;
  root_separation_ = bounds_.separationAlongWitnesses(Hierarchy::kRoot, Hierarchy::kRoot);
  if (root_separation_ < nearest_.enough()) return false;
  exclude(root_separation_);
  return true;
}

// Returns whether the boxes below the roots prove it, so that a large cache need not be reopened.
bool BranchAndBound::isProvenAtOnce() {
  if (cache_->size() < kWorthTrying || cache_->isAt(frame_.rotation, frame_.offset)) return false;
  BoundCache* const cache = std::exchange(cache_, nullptr);
  beginAtRoots();
  expand(open_.take());
  cache_ = cache;
  const bool is_proven = open_.isEmpty();
  open_.clear();
  return is_proven;
}

// Looks again at what the last proof excluded, where its bound has run out.
void BranchAndBound::reopenCache() {
  BoundCache& cache = *cache_;
  cache.advance(b_, frame_.rotation, frame_.offset, 0.25 * frame_.scale.slack);
  for (BoundCache::LeafPair& pair : cache.leaf_pairs_) {
    const double moved = cache.moved_distances_[pair.subtree];
    double bound = pair.bound - moved;
    cut_ = cut_ || limit_.isOverNow();
    if (bound < nearest_.enough() && !cut_) {
      bound = reopenLeaves(pair);
      pair.bound = bound + moved;
    }
    exclude(bound);
  }
  for (std::size_t i = 0; i < cache.quads_.size(); ++i) {
    const BoundCache::Quad& quad = cache.quads_[i];
    const double moved = cache.moved_distances_[quad.subtree];
    const double least = Eigen::Map<const Lanes>(quad.bound).minCoeff() - moved;
    cut_ = cut_ || limit_.isOverNow();
    if (least >= nearest_.enough() || cut_) {
      exclude(least);
    } else {
      reopenQuad(i, moved);
    }
  }
}

double BranchAndBound::reopenLeaves(BoundCache::LeafPair& pair) {
  const Hierarchy::Leaf& leaf_a = leafOfA(pair.a);
  const Hierarchy::Leaf& leaf_b = leafOfB(pair.b);
  ++leaves_asked_again_;
  const double bound = separationAlong(leaf_a, leaf_b, pair.direction, frame_);
  return bound < nearest_.enough() ? nearest_.measureLeaves(leaf_a, leaf_b, true, pair.direction) : bound;
}

void BranchAndBound::reopenQuad(std::size_t i, double moved) {
  BoundCache::Quad& quad = cache_->quads_[i];
  if (quad.by_boxes && stillParts(i, moved)) return;
  quad.by_boxes = true;
  const Lanes bounds = bounds_.squaredBounds(quad.kept, quad.opened, quad.opens_b, &cache_->directions_[i]);
  for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
    if (quad.bound[lane] == kInfinity) continue;
    const Slot child = slotOf(quad.opened, lane);
    double squared_bound = bounds[lane];
    if (raiseAlongWitnesses(quad.kept, child, quad.opens_b, squared_bound)) quad.by_boxes = false;
    if (squared_bound >= nearest_.squaredEnough()) {
      const double bound = std::sqrt(squared_bound);
      quad.bound[lane] = bound + moved;
      exclude(bound);
    } else {
      quad.bound[lane] = kInfinity;
      add(quad.kept, child, quad.opens_b, squared_bound);
    }
  }
}

// Returns whether an entry's children are still far enough along the directions that parted them last.
bool BranchAndBound::stillParts(std::size_t i, double moved) {
  BoundCache::Quad& quad = cache_->quads_[i];
  ++asked_again_;
  const Lanes found = bounds_.separationsAlong(cache_->directions_[i], quad.kept, quad.opens_b)
                          .max(lanes(quad.bound) - moved);
  const double least = found.minCoeff();
  if (!(least >= nearest_.enough())) return false;
  Eigen::Map<Lanes>(quad.bound) = found + moved;
  exclude(least);
  return true;
}

void BranchAndBound::search() {
  while (!open_.isEmpty() && nearest_.squaredDistance() > 0.0) {
    if (limit_.isOverNow()) {
      cut_ = true;
      return;
    }
    expand(open_.take());
  }
}

void BranchAndBound::add(Slot kept, Slot child, bool opens_b, double squared_bound) {
  if (open_.add(opens_b ? kept : child, opens_b ? child : kept, squared_bound)) return;
  exclude(std::sqrt(squared_bound));
  cut_ = true;
}

void BranchAndBound::expand(const OpenPairs::OpenPair& pair) {
  const std::uint32_t child_a = a_.child(pair.a);
  const std::uint32_t child_b = b_.child(pair.b);
  if (isLeaf(child_a) && isLeaf(child_b)) {
    openLeaves(pair);
    return;
  }
  const bool opens_b = bounds_.opensB(pair.a, pair.b);
  const std::uint32_t opened = opens_b ? child_b : child_a;
  const Slot kept = opens_b ? pair.a : pair.b;
  const Hierarchy::SingleNode& node = (opens_b ? b_ : a_).singleNodes()[opened];
  LaneDirections directions;
  const Lanes bounds = bounds_.squaredBounds(kept, opened, opens_b, cache_ == nullptr ? nullptr : &directions)
                           .max(pair.squared_bound);
  if (cache_ == nullptr && bounds.minCoeff() >= nearest_.squaredEnough()) {
    excludeSquared(bounds.minCoeff());
    return;
  }
  bool by_boxes = true;
  BoundCache::Quad* quad = nullptr;
  std::uint32_t nearest = Hierarchy::kWidth;
  double nearest_bound = nearest_.squaredEnough();
  for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
    if (node.child[lane] == Hierarchy::kNoChild) break;
    const Slot child = slotOf(opened, lane);
    double squared_bound = bounds[lane];
    if (raiseAlongWitnesses(kept, child, opens_b, squared_bound)) by_boxes = false;
    if (squared_bound >= nearest_.squaredEnough()) {
      excludeSquared(squared_bound);
      if (cache_ == nullptr) continue;
      if (quad == nullptr) quad = keepQuad(kept, opened, opens_b, directions);
      if (quad == nullptr) continue;
      quad->bound[lane] = std::sqrt(squared_bound) + cache_->moved_distances_[quad->subtree];
    } else if (squared_bound < nearest_bound) {
      if (nearest != Hierarchy::kWidth) add(kept, slotOf(opened, nearest), opens_b, nearest_bound);
      nearest = lane;
      nearest_bound = squared_bound;
    } else {
      add(kept, child, opens_b, squared_bound);
    }
  }
  if (quad != nullptr) quad->by_boxes = by_boxes;
  if (nearest != Hierarchy::kWidth) {
    add(kept, slotOf(opened, nearest), opens_b, nearest_bound);  // is taken next
  }
}

// Adds an entry to the cache, none of its children excluded; returns nullptr when there is no room.
BoundCache::Quad* BranchAndBound::keepQuad(Slot kept, std::uint32_t opened, bool opens_b,
                                           const LaneDirections& directions) {
  if (!limit_.admits(cache_->size() + 1)) {
    dropCache();
    return nullptr;
  }
  const std::uint8_t subtree = opens_b ? b_.subtreeOfNode(opened) : subtreeOf(kept);
  cache_->directions_.push_back(directions);
  cache_->quads_.push_back(
      {{kInfinity, kInfinity, kInfinity, kInfinity}, kept, opened, subtree, opens_b, true});
  return &cache_->quads_.back();
}

// Raises the bound of a child that its box does not exclude, where the direction between the witnesses does.
bool BranchAndBound::raiseAlongWitnesses(Slot kept, Slot child, bool opens_b, double& squared_bound) {
  if (squared_bound >= nearest_.squaredEnough()) return false;
  const double separation = bounds_.separationAlongWitnesses(opens_b ? kept : child, opens_b ? child : kept);
  if (separation < nearest_.enough()) return false;
  squared_bound = separation * separation;
  return true;
}

void BranchAndBound::openLeaves(const OpenPairs::OpenPair& pair) {
  Eigen::Vector3d direction = nearest_.direction();
  const double bound =
      std::max(std::sqrt(pair.squared_bound),
               nearest_.measureLeaves(leafOfA(pair.a), leafOfB(pair.b), cache_ != nullptr, direction));
  exclude(bound);
  if (cache_ == nullptr) return;
  if (!limit_.admits(cache_->size() + 1)) {
    dropCache();
    return;
  }
  const std::uint8_t subtree = subtreeOf(pair.b);
  cache_->leaf_pairs_.push_back(
      {bound + cache_->moved_distances_[subtree], pair.a, pair.b, subtree, direction});
}

// Does without the cache when there is no room for it.
void BranchAndBound::dropCache() {
  cache_->clear();
  cache_ = nullptr;
}

DistanceCertificate BranchAndBound::conclude() {
  const double distance = nearest_.distance();
  result_.witness = nearest_.witness();
  result_.distance = distance;
  const double bound = std::min({distance - frame_.error, excluded_, std::sqrt(squared_excluded_),
                                 std::sqrt(open_.leastSquaredBound())});
  result_.lower_bound = bound > 0.0 ? std::nextafter(bound, 0.0) : 0.0;
  if (nearest_.squaredDistance() == 0.0) {
    result_.status = CertificateStatus::Penetrating;
    result_.lower_bound = 0.0;
  } else if (cut_) {
    result_.status = CertificateStatus::Budget;
  } else if (bound < distance - frame_.error) {
    result_.status = CertificateStatus::Tolerance;
  } else {
    result_.status = CertificateStatus::Proven;
  }
  return result_;
}

}  // namespace concave_distance::detail
