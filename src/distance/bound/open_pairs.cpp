#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "branch_and_bound.h"
#include "distance/kernels/prepared_triangle.h"
#include "hierarchy_access.h"

// What a proof does with a pair of boxes or leaves: bounds what lies below, excludes it or opens it further.

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;

}  // namespace

// What the last proof excluded is looked at again where its bound has run out.
void BranchAndBound::reopenCache() {
  BoundCache& cache = *cache_;
  cache.advance(b_, frame_.rotation, frame_.offset, 0.25 * scale_.slack);
  for (std::size_t i = 0; i < cache.leaf_pairs_.size(); ++i) {
    BoundCache::LeafPair& pair = cache.leaf_pairs_[i];
    const double moved = cache.moved_distances_[pair.subtree];
    double bound = pair.bound - moved;
    cut_ = cut_ || limit_.isOverNow();
    if (bound < enough_ && !cut_) {
      const Hierarchy::Leaf& leaf_a = leafOf(a_, a_.child(pair.a));
      const Hierarchy::Leaf& leaf_b = leafOf(b_, b_.child(pair.b));
      bound = leafSeparation(leaf_a, leaf_b, pair.direction);
      ++leaves_asked_again_;
      if (bound < enough_) bound = measureLeaves(leaf_a, leaf_b, pair.direction);
      pair.bound = bound + moved;
    }
    exclude(bound);
  }
  const std::size_t count = cache.quads_.size();
  for (std::size_t i = 0; i < count; ++i) {
    BoundCache::Quad& quad = cache.quads_[i];
    const double moved = cache.moved_distances_[quad.subtree];
    const double least = Eigen::Map<const Lanes>(quad.bound).minCoeff() - moved;
    cut_ = cut_ || limit_.isOverNow();
    if (least >= enough_ || cut_) {
      exclude(least);
      continue;
    }
    if (quad.by_boxes && stillParts(i, moved)) continue;
    quad.by_boxes = true;
    const Lanes bounds = childBounds(quad.kept, quad.opened, quad.opens_b, &cache.directions_[i]);
    for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
      if (quad.bound[lane] == kInfinity) continue;
      double squared_bound = bounds[lane];
      if (raiseAlongWitnesses(quad.kept, slotOf(quad.opened, lane), quad.opens_b, squared_bound)) {
        quad.by_boxes = false;
      }
      if (squared_bound >= squared_enough_) {
        const double bound = std::sqrt(squared_bound);
        quad.bound[lane] = bound + moved;
        exclude(bound);
      } else {
        quad.bound[lane] = kInfinity;
        add(quad.kept, quad.opened, lane, quad.opens_b, squared_bound);
      }
    }
  }
}

// Whether an entry's children are still far enough along the directions that parted them last.
bool BranchAndBound::stillParts(std::size_t i, double moved) {
  BoundCache& cache = *cache_;
  BoundCache::Quad& quad = cache.quads_[i];
  ++asked_again_;
  const LaneDirections& d = cache.directions_[i];
  const std::uint32_t node = quad.kept / Hierarchy::kWidth;
  const std::uint32_t lane = quad.kept % Hierarchy::kWidth;
  const FloatLanes now =
      quad.opens_b ? separations(d, unit_b_, a_.singleNodes()[node], lane, unit_a_, single_b_from_a_)
                   : separations(d, unit_a_, b_.singleNodes()[node], lane, unit_b_, single_a_from_b_);
  const Lanes found = (now.cast<double>() * scale_.scale).max(lanes(quad.bound) - moved);
  const double least = found.minCoeff();
  if (!(least >= enough_)) return false;
  Eigen::Map<Lanes>(quad.bound) = found + moved;
  exclude(least);
  return true;
}

void BranchAndBound::add(Slot kept, std::uint32_t opened, std::uint32_t lane, bool opens_b,
                         double squared_bound) {
  if (open_.size() == open_count_) {
    const std::size_t more = open_.size() + 256;
    if (!limit_.makeRoom(open_, more)) {
      exclude(std::sqrt(squared_bound));
      cut_ = true;
      return;
    }
    open_.resize(open_.size() + more);
  }
  // Field by field: a pair put together on the stack first would stall the store buffer.
  const Slot slot = slotOf(opened, lane);
  OpenPair& child = open_[open_count_++];
  child.a = opens_b ? kept : slot;
  child.b = opens_b ? slot : kept;
  child.squared_bound = squared_bound;
  if (timed_) std::push_heap(open_.begin(), open_.begin() + openCount(), isFarther);
}

void BranchAndBound::expand(const OpenPair& pair) {
  const std::uint32_t child_a = a_.child(pair.a);
  const std::uint32_t child_b = b_.child(pair.b);
  if (isLeaf(child_a) && isLeaf(child_b)) {
    openLeaves(pair);
    return;
  }
  const bool opens_b = opensB(pair.a, pair.b);
  const std::uint32_t opened = opens_b ? child_b : child_a;
  const Slot kept = opens_b ? pair.a : pair.b;
  const Hierarchy::SingleNode& node = (opens_b ? b_ : a_).singleNodes()[opened];
  LaneDirections directions;
  const Lanes bounds =
      childBounds(kept, opened, opens_b, cache_ == nullptr ? nullptr : &directions).max(pair.squared_bound);
  if (cache_ == nullptr && bounds.minCoeff() >= squared_enough_) {
    excludeSquared(bounds.minCoeff());
    return;
  }
  bool by_boxes = true;
  BoundCache::Quad* quad = nullptr;
  std::uint32_t nearest = Hierarchy::kWidth;
  double nearest_bound = squared_enough_;
  for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
    if (node.child[lane] == Hierarchy::kNoChild) break;
    double squared_bound = bounds[lane];
    if (raiseAlongWitnesses(kept, slotOf(opened, lane), opens_b, squared_bound)) by_boxes = false;
    if (squared_bound >= squared_enough_) {
      excludeSquared(squared_bound);
      if (cache_ == nullptr) continue;
      if (quad == nullptr) {
        if (!limit_.makeRoom(cache_->quads_) || !limit_.makeRoom(cache_->directions_)) {
          dropCache();
          continue;
        }
        const std::uint8_t subtree = opens_b ? b_.subtreeOfNode(opened) : subtreeOf(kept);
        cache_->quads_.push_back(
            {{kInfinity, kInfinity, kInfinity, kInfinity}, kept, opened, subtree, opens_b, true});
        quad = &cache_->quads_.back();
        cache_->directions_.push_back(directions);
      }
      quad->bound[lane] = std::sqrt(squared_bound) + cache_->moved_distances_[quad->subtree];
    } else if (squared_bound < nearest_bound) {
      if (nearest != Hierarchy::kWidth) add(kept, opened, nearest, opens_b, nearest_bound);
      nearest = lane;
      nearest_bound = squared_bound;
    } else {
      add(kept, opened, lane, opens_b, squared_bound);
    }
  }
  if (quad != nullptr) quad->by_boxes = by_boxes;
  if (nearest != Hierarchy::kWidth) add(kept, opened, nearest, opens_b, nearest_bound);  // is taken next
}

void BranchAndBound::openLeaves(const OpenPair& pair) {
  Vector3d direction = direction_;
  const double bound =
      std::max(std::sqrt(pair.squared_bound),
               measureLeaves(leafOf(a_, a_.child(pair.a)), leafOf(b_, b_.child(pair.b)), direction));
  exclude(bound);
  if (cache_ == nullptr) return;
  if (!limit_.makeRoom(cache_->leaf_pairs_)) {
    dropCache();
    return;
  }
  const std::uint8_t subtree = subtreeOf(pair.b);
  cache_->leaf_pairs_.push_back(
      {bound + cache_->moved_distances_[subtree], pair.a, pair.b, subtree, direction});
}

// Along the direction between the witnesses, with what the boxes hold and not what they could hold.
double BranchAndBound::separationAlongWitnesses(Slot a, Slot b) {
  if (supports_are_new_) {
    supports_are_new_ = false;
    offset_along_ = direction_.dot(frame_.offset);
    // Boxes of flat pieces may reach this far beyond their plane.
    const double tie = 0.375 * error_;
    support_a_.setDirection(direction_, direction_.dot(closest_.point_a) + tie);
    support_b_.setDirection(-direction_in_b_, offset_along_ - direction_.dot(closest_.point_b) + tie);
  }
  return offset_along_ - support_a_.of(a) - support_b_.of(b) - scale_.slack;
}

// For a child that its box does not exclude: whether the witness direction does.
bool BranchAndBound::raiseAlongWitnesses(Slot kept, Slot child, bool opens_b, double& squared_bound) {
  if (squared_bound >= squared_enough_) return false;
  const double separation = separationAlongWitnesses(opens_b ? kept : child, opens_b ? child : kept);
  if (separation < enough_) return false;
  squared_bound = separation * separation;
  return true;
}

// Squared bounds of one box against the children of the other one.
Lanes BranchAndBound::childBounds(Slot kept, std::uint32_t opened, bool opens_b, LaneDirections* directions) {
  result_.cost.box_bounds += static_cast<std::uint32_t>(Hierarchy::kWidth);
  const std::uint32_t node = kept / Hierarchy::kWidth;
  const std::uint32_t lane = kept % Hierarchy::kWidth;
  if (opens_b) {
    if (kept != compared_slot_a_) {
      compared_a_ = ComparedBox(a_.singleNodes()[node], lane, unit_a_, single_b_from_a_);
      compared_slot_a_ = kept;
    }
    return squaredBounds(b_.singleNodes()[opened], compared_a_, unit_b_, directions).cast<double>() *
           scale_.squared_scale;
  }
  if (kept != compared_slot_b_) {
    compared_b_ = ComparedBox(b_.singleNodes()[node], lane, unit_b_, single_a_from_b_);
    compared_slot_b_ = kept;
  }
  return squaredBounds(a_.singleNodes()[opened], compared_b_, unit_a_, directions).cast<double>() *
         scale_.squared_scale;
}

double BranchAndBound::leafSeparation(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b,
                                      const Vector3d& direction) const {
  return direction.dot(frame_.offset) - mostAlong(leaf_a, direction).maxCoeff() -
         mostAlong(leaf_b, -(turned_ * direction)).maxCoeff() - scale_.slack;
}

// Along the mean of either leaf's normals, which parts leaves that bend little; 0 where neither does.
double BranchAndBound::separationAlongNormals(const Hierarchy::Leaf& leaf_a, const LeafLanes& b,
                                              Vector3d& parting) const {
  const Vector3d apart = b.triangle(0)[0] - triangleOf(leaf_a, 0)[0];
  for (const Vector3d& sum : {sumOfNormals(leaf_a), sumOfNormals(b)}) {
    if (!(sum.squaredNorm() > kLeastSquare)) continue;
    const Vector3d normal = sum / (sum.dot(apart) < 0.0 ? -sum.norm() : sum.norm());
    const double separation =
        leastAlong(b, normal).minCoeff() - mostAlong(leaf_a, normal).maxCoeff() - scale_.slack;
    if (separation < enough_) continue;
    parting = normal;
    return separation;
  }
  return 0.0;
}

// Returns a bound of the distance between the two leaves' triangles; measures those it cannot exclude.
// `parting`: the direction most likely to part all of them at the next pose.
double BranchAndBound::measureLeaves(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b,
                                     Vector3d& parting) {
  ++result_.cost.leaf_pairs;
  LeafLanes b(leaf_b, frame_.rotation, frame_.offset);
  const Lanes least = leastAlong(b, direction_);
  const Lanes most = mostAlong(leaf_a, direction_) + scale_.slack;
  const double together = least.minCoeff() - most.maxCoeff();
  parting = direction_;
  double parting_distance = kInfinity;
  if (together >= enough_) return together;
  b.computeNormals();
  if (cache_ != nullptr) {  // a fresh proof gains nothing from it
    const double along_normals = separationAlongNormals(leaf_a, b, parting);
    if (along_normals >= enough_) return along_normals;
  }
  // The direction between the last pair measured here parts its neighbours as well, as a rule.
  Lanes near_least = Lanes::Zero();
  Lanes near_most = Lanes::Zero();
  double bound = kInfinity;
  for (std::size_t i = 0; i < leaf_a.count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    Lanes separation = (least - most[row]).max(near_least - near_most[row]);
    if (separation.minCoeff() >= enough_) {
      bound = std::min(bound, separation.minCoeff());
      continue;
    }
    const TrianglePoints a = triangleOf(leaf_a, i);
    separation = separation.max(planeSeparation(a, b) - scale_.slack);
    for (std::uint32_t lane = 0; lane < leaf_b.count; ++lane) {
      if (separation[lane] < enough_) {
        const TrianglePairDistance found =
            measure(a, b.triangle(lane), leaf_a.triangle[i], leaf_b.triangle[lane]);
        const double distance = std::sqrt(found.squared_distance);
        if (!(distance > 0.0)) return 0.0;
        const Vector3d direction = (found.point_b - found.point_a) / distance;
        if (distance < parting_distance) {
          parting_distance = distance;
          parting = direction;
        }
        near_least = leastAlong(b, direction);
        near_most = mostAlong(leaf_a, direction) + scale_.slack;
        separation = separation.max(near_least - near_most[row]);
        separation[lane] = distance;
      }
      bound = std::min(bound, separation[lane]);
    }
  }
  return bound;
}

}  // namespace concave_distance::detail
