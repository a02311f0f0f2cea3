#include "branch_and_bound.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;
using Clock = std::chrono::steady_clock;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of the rounding of one bound: see kProofError.
constexpr double kBoundError = 0x1.0p-48;  // 16 machine epsilons
/// Box pairs opened between two looks at the clock.
constexpr std::uint32_t kClockInterval = 16;

bool isLeaf(std::uint32_t child) {
  return (child & Hierarchy::kLeafFlag) != 0;
}

const Hierarchy::Leaf& leafOf(const Hierarchy& hierarchy, std::uint32_t child) {
  return hierarchy.leaves()[child & ~Hierarchy::kLeafFlag];
}

double squaredSize(const Hierarchy& hierarchy, Hierarchy::Slot slot) {
  const Hierarchy::Node& node = hierarchy.nodes()[slot / Hierarchy::kWidth];
  const std::size_t lane = slot % Hierarchy::kWidth;
  return node.half[0][lane] * node.half[0][lane] + node.half[1][lane] * node.half[1][lane] +
         node.half[2][lane] * node.half[2][lane];
}

Hierarchy::Slot slotOf(std::uint32_t node, std::uint32_t lane) {
  return node * static_cast<Hierarchy::Slot>(Hierarchy::kWidth) + lane;
}

bool isFarther(const CertificateWorkspace::OpenPair& l, const CertificateWorkspace::OpenPair& r) {
  return l.squared_bound > r.squared_bound;
}

}  // namespace

BranchAndBound::BranchAndBound(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const CertificateRequest& request, CertificateWorkspace& workspace,
                               ProofFront* front)
    : body_a_(a),
      body_b_(b),
      a_(a.hierarchy()),
      b_(b.hierarchy()),
      a_from_b_(a_from_b),
      frames_(a.hierarchy().origin(), b.hierarchy().origin(), a_from_b),
      turned_(frames_.rotation.transpose()),
      request_(request),
      timed_(std::isfinite(request.time_budget)),
      open_(workspace.open),
      refinement_(workspace.refinement),
      front_(front),
      support_a_(a.hierarchy(), workspace.support_a),
      support_b_(b.hierarchy(), workspace.support_b),
      scale_(a.hierarchy().reach() + b.hierarchy().reach() + frames_.offset.norm(), kBoundError),
      error_(kProofError * proofScale(a, b, a_from_b)) {}

DistanceCertificate BranchAndBound::run(const TrianglePair* seeds, std::size_t seed_count) {
  seed(seeds, seed_count);
  const double seeded = distance_;
  if (front_ != nullptr && !front_->valid() && front_->wait_ > 0) {
    --front_->wait_;
    front_ = nullptr;
  }
  const bool anew = front_ == nullptr || !front_->valid();
  if (anew) {
    beginAtRoots();
  } else {
    reopenFront();
  }
  const bool out_of_time = search();
  if (front_ != nullptr) {
    if (out_of_time || squared_distance_ == 0.0) {
      front_->clear();  // not everything is in it
    } else {
      front_->decide(anew, result_.cost.box_bounds / static_cast<std::uint32_t>(Hierarchy::kWidth) +
                               result_.cost.leaf_pairs);
    }
  }
  result_.improved = distance_ < seeded - error_;
  return conclude(out_of_time);
}

void BranchAndBound::seed(const TrianglePair* seeds, std::size_t seed_count) {
  for (std::size_t i = 0; i < seed_count; ++i) descend(seeds[i]);
  if (seed_count == 0) dive();
}

void BranchAndBound::descend(const TrianglePair& seed) {
  const WitnessRefinement refined = refineWitness(body_a_, body_b_, a_from_b_, seed.a, seed.b, refinement_);
  result_.cost.triangle_pairs += refined.iterations;
  // Once more in the frame that everything else here is measured in.
  const TriangleIndex a = refined.witness.triangle_a;
  const TriangleIndex b = refined.witness.triangle_b;
  measure(frames_.cornersOfA(body_a_, a), frames_.cornersOfB(body_b_, b), a, b);
}

// One way down to a pair of leaves, always to the nearer box, to have something to compare with.
void BranchAndBound::dive() {
  Slot a = Hierarchy::kRoot;
  Slot b = Hierarchy::kRoot;
  while (!isLeaf(a_.child(a)) || !isLeaf(b_.child(b))) {
    const bool opens_b = opensB(a, b);
    Slot& slot = opens_b ? b : a;
    const std::uint32_t opened = opens_b ? b_.child(b) : a_.child(a);
    const Lanes bounds = childBounds(opens_b ? a : b, opened, opens_b);
    const Hierarchy::Node& node = (opens_b ? b_ : a_).nodes()[opened];
    std::uint32_t nearest = 0;
    for (std::uint32_t lane = 1; lane < Hierarchy::kWidth; ++lane) {
      if (node.child[lane] != Hierarchy::kNoChild && bounds[lane] < bounds[nearest]) nearest = lane;
    }
    slot = slotOf(opened, nearest);
  }
  descend({leafOf(a_, a_.child(a)).triangle[0], leafOf(b_, b_.child(b)).triangle[0]});
}

TrianglePairDistance BranchAndBound::measure(const TrianglePoints& a, const TrianglePoints& b,
                                             TriangleIndex triangle_a, TriangleIndex triangle_b) {
  const TrianglePairDistance found = triangleDistance(a, b);
  ++result_.cost.triangle_pairs;
  if (!(found.squared_distance < squared_distance_)) return found;
  closest_ = found;
  triangle_a_ = triangle_a;
  triangle_b_ = triangle_b;
  squared_distance_ = found.squared_distance;
  distance_ = std::sqrt(squared_distance_);
  if (distance_ > 0.0) {
    direction_ = (found.point_b - found.point_a) / distance_;
    direction_in_b_ = turned_ * direction_;
    supports_are_new_ = true;
  }
  const double tolerance = std::max(request_.absolute_tolerance, request_.relative_tolerance * distance_);
  enough_ = std::max(0.0, distance_ - std::max(tolerance, error_));
  squared_enough_ = enough_ * enough_;
  return found;
}

void BranchAndBound::beginAtRoots() {
  if (front_ != nullptr) front_->begin(b_, frames_.rotation, frames_.offset);
  if (open_.empty()) open_.resize(Hierarchy::kWidth);
  open_[0] = {Hierarchy::kRoot, Hierarchy::kRoot, 0.0};
  open_count_ = 1;
  if (front_ != nullptr || squared_distance_ == 0.0) return;  // a front wants pairs whose bounds last
  const double separation = separationAlongWitnesses(Hierarchy::kRoot, Hierarchy::kRoot);
  if (separation >= enough_) {
    exclude(separation);
    open_count_ = 0;
  }
}

// What the last proof excluded is looked at again where its bound has run out.
void BranchAndBound::reopenFront() {
  ProofFront& front = *front_;
  front.advance(b_, frames_.rotation, frames_.offset, 0.25 * scale_.slack);
  for (std::size_t i = 0; i < front.leaf_pairs_.size(); ++i) {
    ProofFront::LeafPair& pair = front.leaf_pairs_[i];
    const double gone = front.odometers_[pair.region];
    double bound = pair.bound - gone;
    if (bound < enough_) {
      bound = measureLeaves(leafOf(a_, a_.child(pair.a)), leafOf(b_, b_.child(pair.b)));
      pair.bound = bound + gone;
    }
    exclude(bound);
  }
  const std::size_t count = front.quads_.size();
  for (std::size_t i = 0; i < count; ++i) {
    ProofFront::Quad& quad = front.quads_[i];
    const double gone = front.odometers_[quad.region];
    const double least = *std::min_element(quad.bound, quad.bound + Hierarchy::kWidth) - gone;
    if (least >= enough_) {
      exclude(least);
      continue;
    }
    const Lanes bounds = childBounds(quad.kept, quad.opened, quad.opens_b);
    for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
      if (quad.bound[lane] == kInfinity) continue;
      const double squared_bound =
          squaredBoundOfChild(quad.kept, slotOf(quad.opened, lane), quad.opens_b, bounds[lane]);
      if (squared_bound >= squared_enough_) {
        const double bound = std::sqrt(squared_bound);
        quad.bound[lane] = bound + gone;
        exclude(bound);
      } else {
        quad.bound[lane] = kInfinity;
        add(quad.kept, quad.opened, lane, quad.opens_b, squared_bound);
      }
    }
  }
}

// True when the time was up first.
bool BranchAndBound::search() {
  const Clock::time_point start = timed_ ? Clock::now() : Clock::time_point();
  std::uint32_t until_look = kClockInterval;
  while (open_count_ > 0 && squared_distance_ > 0.0) {
    if (timed_ && --until_look == 0) {
      until_look = kClockInterval;
      if (std::chrono::duration<double>(Clock::now() - start).count() >= request_.time_budget) return true;
    }
    expand(take());
  }
  return false;
}

// With a budget the least bound comes first, so that the proven bound rises as fast as it can; without one a
// stack does, which costs less.
BranchAndBound::OpenPair BranchAndBound::take() {
  if (timed_) std::pop_heap(open_.begin(), open_.begin() + openCount(), isFarther);
  return open_[--open_count_];
}

void BranchAndBound::add(Slot kept, std::uint32_t opened, std::uint32_t lane, bool opens_b,
                         double squared_bound) {
  if (open_.size() == open_count_) open_.resize(2 * open_.size() + 256);
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
  const Hierarchy::Node& node = (opens_b ? b_ : a_).nodes()[opened];
  const Lanes bounds = childBounds(kept, opened, opens_b).max(pair.squared_bound);
  ProofFront::Quad* quad = nullptr;
  std::uint32_t nearest = Hierarchy::kWidth;
  double nearest_bound = squared_enough_;
  for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
    if (node.child[lane] == Hierarchy::kNoChild) break;
    const double squared_bound = squaredBoundOfChild(kept, slotOf(opened, lane), opens_b, bounds[lane]);
    if (squared_bound >= squared_enough_) {
      const double bound = std::sqrt(squared_bound);
      exclude(bound);
      if (front_ == nullptr) continue;
      if (quad == nullptr) {
        const std::uint8_t region = opens_b ? b_.regionOfNode(opened) : regionOf(kept);
        front_->quads_.push_back(
            {{kInfinity, kInfinity, kInfinity, kInfinity}, kept, opened, region, opens_b});
        quad = &front_->quads_.back();
      }
      quad->bound[lane] = bound + front_->odometers_[quad->region];
    } else if (squared_bound < nearest_bound) {
      if (nearest != Hierarchy::kWidth) add(kept, opened, nearest, opens_b, nearest_bound);
      nearest = lane;
      nearest_bound = squared_bound;
    } else {
      add(kept, opened, lane, opens_b, squared_bound);
    }
  }
  if (nearest != Hierarchy::kWidth) add(kept, opened, nearest, opens_b, nearest_bound);  // is taken next
}

void BranchAndBound::openLeaves(const OpenPair& pair) {
  const double bound = std::max(std::sqrt(pair.squared_bound),
                                measureLeaves(leafOf(a_, a_.child(pair.a)), leafOf(b_, b_.child(pair.b))));
  exclude(bound);
  if (front_ == nullptr) return;
  const std::uint8_t region = regionOf(pair.b);
  front_->leaf_pairs_.push_back({bound + front_->odometers_[region], pair.a, pair.b, region});
}

bool BranchAndBound::opensB(Slot a, Slot b) const {
  if (isLeaf(a_.child(a))) return true;
  return !isLeaf(b_.child(b)) && squaredSize(b_, b) >= squaredSize(a_, a);
}

// Along the direction between the witnesses, with what the boxes hold and not what they could hold.
double BranchAndBound::separationAlongWitnesses(Slot a, Slot b) {
  if (supports_are_new_) {
    supports_are_new_ = false;
    offset_along_ = direction_.dot(frames_.offset);
    // Boxes of flat pieces may reach this far beyond their plane.
    const double tie = 0.375 * error_;
    support_a_.setDirection(direction_, direction_.dot(closest_.point_a) + tie);
    support_b_.setDirection(-direction_in_b_, offset_along_ - direction_.dot(closest_.point_b) + tie);
  }
  return offset_along_ - support_a_.of(a) - support_b_.of(b) - scale_.slack;
}

double BranchAndBound::squaredBoundOfChild(Slot kept, Slot child, bool opens_b, double squared_bound) {
  if (squared_bound >= squared_enough_) return squared_bound;
  const double separation = separationAlongWitnesses(opens_b ? kept : child, opens_b ? child : kept);
  return separation >= enough_ ? separation * separation : squared_bound;
}

// Squared bounds of one box against the children of the other one.
Lanes BranchAndBound::childBounds(Slot kept, std::uint32_t opened, bool opens_b) {
  result_.cost.box_bounds += static_cast<std::uint32_t>(Hierarchy::kWidth);
  // What is kept for later is to be as far as it can.
  const double enough = front_ == nullptr ? enough_ : kInfinity;
  if (opens_b) {
    if (kept != compared_slot_a_) {
      OrientedBox box = a_.box(kept);
      box.centre = turned_ * (box.centre - frames_.offset);
      box.axes = turned_ * box.axes;
      compared_a_ = ComparedBox(box, scale_.inverse_scale);
      compared_slot_a_ = kept;
    }
    return squaredBounds(b_.nodes()[opened], compared_a_, direction_in_b_, scale_, enough);
  }
  if (kept != compared_slot_b_) {
    OrientedBox box = b_.box(kept);
    box.centre = frames_.rotation * box.centre + frames_.offset;
    box.axes = frames_.rotation * box.axes;
    compared_b_ = ComparedBox(box, scale_.inverse_scale);
    compared_slot_b_ = kept;
  }
  return squaredBounds(a_.nodes()[opened], compared_b_, -direction_, scale_, enough);
}

// Returns a bound of the distance between the two leaves' triangles; measures those it cannot exclude.
double BranchAndBound::measureLeaves(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b) {
  ++result_.cost.leaf_pairs;
  LeafLanes b(leaf_b, frames_.rotation, frames_.offset);
  const Lanes least = leastAlong(b, direction_);
  const Lanes most = mostAlong(leaf_a, direction_) + scale_.slack;
  const double together = least.minCoeff() - most.maxCoeff();
  if (together >= enough_) return together;
  b.computeNormals();
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

void BranchAndBound::exclude(double bound) {
  excluded_ = std::min(excluded_, bound);
}

DistanceCertificate BranchAndBound::conclude(bool out_of_time) {
  result_.witness = frames_.toWitness(closest_, triangle_a_, triangle_b_);
  result_.distance = distance_;
  double bound = std::min(distance_ - error_, excluded_);
  for (std::size_t i = 0; i < open_count_; ++i) bound = std::min(bound, std::sqrt(open_[i].squared_bound));
  result_.lower_bound = bound > 0.0 ? std::nextafter(bound, 0.0) : 0.0;
  if (squared_distance_ == 0.0) {
    result_.status = CertificateStatus::Penetrating;
    result_.lower_bound = 0.0;
  } else if (out_of_time) {
    result_.status = CertificateStatus::Budget;
  } else if (bound < distance_ - error_) {
    result_.status = CertificateStatus::Tolerance;
  } else {
    result_.status = CertificateStatus::Proven;
  }
  return result_;
}

}  // namespace concave_distance::detail
