#include "branch_and_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hierarchy_access.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;

/// Of the rounding of one bound: see kProofError.
constexpr double kBoundError = 0x1.0p-48;  // 16 machine epsilons

/// In a dive, of the squared distance of two boxes' centres beside their squared bound.
constexpr double kWeightOfCentres = 0.1;

/// Before a cache of so many entries is reopened at another pose, it is tried without.
constexpr std::size_t kWorthTrying = 128;

}  // namespace

BranchAndBound::BranchAndBound(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                               const CertificateRequest& request, CertificateWorkspace& workspace,
                               BoundCache* cache)
    : a_(a.hierarchy()),
      b_(b.hierarchy()),
      frame_(a, b, a_from_b, a.hierarchy().origin(), b.hierarchy().origin()),
      turned_(frame_.rotation.transpose()),
      request_(request),
      limit_(request.limit != nullptr ? *request.limit : unlimited_),
      timed_(limit_.isTimed()),
      open_(workspace.open),
      refinement_(workspace.refinement),
      cache_(cache),
      support_a_(a.hierarchy(), workspace.support_a),
      support_b_(b.hierarchy(), workspace.support_b),
      scale_(a.hierarchy().reach() + b.hierarchy().reach() + frame_.offset.norm(), kBoundError),
      unit_a_(static_cast<float>(a.hierarchy().reach() * scale_.inverse_scale)),
      unit_b_(static_cast<float>(b.hierarchy().reach() * scale_.inverse_scale)),
      single_a_from_b_(frame_.rotation, frame_.offset * scale_.inverse_scale),
      single_b_from_a_(turned_, turned_ * frame_.offset * -scale_.inverse_scale),
      error_(kProofError * proofScale(a, b, a_from_b)) {}

DistanceCertificate BranchAndBound::run(const TrianglePair* starts, std::size_t start_count) {
  for (std::size_t i = 0; i < start_count; ++i) descend(starts[i]);
  if (start_count == 0) dive();
  const double start_distance = distance_;
  if (partsAtRoots()) return conclude();  // a cache can wait
  if (cache_ != nullptr && !cache_->valid() && cache_->wait_ > 0) {
    --cache_->wait_;
    cache_ = nullptr;
  }
  if (cache_ != nullptr && cache_->valid() && isProvenAtOnce()) {
    result_.improved = distance_ < start_distance - error_;
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
    if (cut_ || squared_distance_ == 0.0) {
      cache_->clear();  // not everything is in it
    } else {
      cache_->decide(anew, result_.cost.box_bounds / static_cast<std::uint32_t>(Hierarchy::kWidth) +
                               result_.cost.leaf_pairs + (asked_again_ + 2 * leaves_asked_again_) / 3);
    }
  }
  result_.improved = distance_ < start_distance - error_;
  return conclude();
}

void BranchAndBound::descend(const TrianglePair& start) {
  const WitnessRefinement refined = frame_.refine(start.a, start.b, refinement_);
  result_.cost.triangle_pairs += refined.iterations;
  // Once more in the frame that everything else here is measured in.
  const TriangleIndex a = refined.witness.triangle_a;
  const TriangleIndex b = refined.witness.triangle_b;
  measure(frame_.cornersOfA(a), frame_.cornersOfB(b), a, b);
}

// One way down to a pair of leaves, always to the nearer box, to have something to compare with. Where boxes
// overlap or tie, the nearer centre decides.
void BranchAndBound::dive() {
  Slot a = Hierarchy::kRoot;
  Slot b = Hierarchy::kRoot;
  while (!isLeaf(a_.child(a)) || !isLeaf(b_.child(b))) {
    const bool opens_b = opensB(a, b);
    Slot& slot = opens_b ? b : a;
    const std::uint32_t opened = opens_b ? b_.child(b) : a_.child(a);
    const Lanes bounds = childBounds(opens_b ? a : b, opened, opens_b, nullptr);
    const Hierarchy::SingleNode& node = (opens_b ? b_ : a_).singleNodes()[opened];
    const FloatLanes gaps =
        squaredGaps(node, opens_b ? compared_a_ : compared_b_, opens_b ? unit_b_ : unit_a_);
    const Lanes keys = bounds + kWeightOfCentres * scale_.squared_scale * gaps.cast<double>();
    std::uint32_t nearest = 0;
    for (std::uint32_t lane = 1; lane < Hierarchy::kWidth; ++lane) {
      if (node.child[lane] != Hierarchy::kNoChild && keys[lane] < keys[nearest]) nearest = lane;
    }
    slot = slotOf(opened, nearest);
  }
  descend(nearestTriangles(leafOf(a_, a_.child(a)), leafOf(b_, b_.child(b))));
}

// The pair whose centres are nearest to each other.
TrianglePair BranchAndBound::nearestTriangles(const Hierarchy::Leaf& leaf_a,
                                              const Hierarchy::Leaf& leaf_b) const {
  const LeafLanes b(leaf_b, frame_.rotation, frame_.offset);
  TrianglePair nearest{};
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < leaf_a.count; ++i) {
    const TrianglePoints a = triangleOf(leaf_a, i);
    const Vector3d sum = a[0] + a[1] + a[2];
    Lanes squared = Lanes::Zero();
    for (int c = 0; c < 3; ++c) {
      squared += (b.corner[0][c] + b.corner[1][c] + b.corner[2][c] - sum[c]).square();
    }
    for (std::uint32_t lane = 0; lane < leaf_b.count; ++lane) {
      if (squared[lane] < least) {
        least = squared[lane];
        nearest = {leaf_a.triangle[i], leaf_b.triangle[lane]};
      }
    }
  }
  return nearest;
}

TrianglePairDistance BranchAndBound::measure(const TrianglePoints& a, const TrianglePoints& b,
                                             TriangleIndex triangle_a, TriangleIndex triangle_b) {
  TrianglePairDistance found = triangleDistance(a, b);
  ++result_.cost.triangle_pairs;
  if (!(found.squared_distance < squared_distance_)) return found;
  closest_ = found;
  triangle_a_ = triangle_a;
  triangle_b_ = triangle_b;
  distance_ = std::sqrt(found.squared_distance);
  if (distance_ <=
      kTriangleDistanceError * scale_.scale) {  // nearer than the kernel can separate from touching
    closest_.point_b = closest_.point_a;
    closest_.squared_distance = distance_ = 0.0;
  }
  squared_distance_ = closest_.squared_distance;
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
  if (cache_ != nullptr) cache_->begin(b_, frame_.rotation, frame_.offset);
  if (open_.empty()) open_.resize(Hierarchy::kWidth);
  // If the proof may be cut short, this bound is certain at once.
  const double certain = timed_ ? std::max(0.0, root_separation_) : 0.0;
  open_[0] = {Hierarchy::kRoot, Hierarchy::kRoot, certain * certain};
  open_count_ = 1;
}

// Whether the direction between the closest points parts the bodies as wholes.
bool BranchAndBound::partsAtRoots() {
  if (squared_distance_ == 0.0) return false;
  root_separation_ = separationAlongWitnesses(Hierarchy::kRoot, Hierarchy::kRoot);
  if (root_separation_ < enough_) return false;
  exclude(root_separation_);
  return true;
}

// Whether the boxes below the roots prove it, so that what a large cache holds need not be asked.
bool BranchAndBound::isProvenAtOnce() {
  if (cache_->size() < kWorthTrying || cache_->isAt(frame_.rotation, frame_.offset)) return false;
  BoundCache* const cache = std::exchange(cache_, nullptr);
  beginAtRoots();
  expand(take());
  cache_ = cache;
  return std::exchange(open_count_, 0) == 0;
}

void BranchAndBound::search() {
  while (open_count_ > 0 && squared_distance_ > 0.0) {
    if (limit_.isOverNow()) {
      cut_ = true;
      return;
    }
    expand(take());
  }
}

// Without room, it is not kept for the next proof.
void BranchAndBound::dropCache() {
  cache_->clear();
  cache_ = nullptr;
}

// With a budget the least bound comes first, so that the proven bound rises as fast as it can; without one a
// stack does, which costs less.
BranchAndBound::OpenPair BranchAndBound::take() {
  if (timed_) std::pop_heap(open_.begin(), open_.begin() + openCount(), isFarther);
  return open_[--open_count_];
}

DistanceCertificate BranchAndBound::conclude() {
  result_.witness = frame_.toWitness(closest_, triangle_a_, triangle_b_);
  result_.distance = distance_;
  double bound = std::min({distance_ - error_, excluded_, std::sqrt(squared_excluded_)});
  for (std::size_t i = 0; i < open_count_; ++i) bound = std::min(bound, std::sqrt(open_[i].squared_bound));
  result_.lower_bound = bound > 0.0 ? std::nextafter(bound, 0.0) : 0.0;
  if (squared_distance_ == 0.0) {
    result_.status = CertificateStatus::Penetrating;
    result_.lower_bound = 0.0;
  } else if (cut_) {
    result_.status = CertificateStatus::Budget;
  } else if (bound < distance_ - error_) {
    result_.status = CertificateStatus::Tolerance;
  } else {
    result_.status = CertificateStatus::Proven;
  }
  return result_;
}

}  // namespace concave_distance::detail
