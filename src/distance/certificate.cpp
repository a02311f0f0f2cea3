#include "concave_distance/distance/certificate.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "box_pair_bounds.h"
#include "leaf_pair.h"
#include "local_frames.h"

namespace concave_distance {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Hierarchy = BoundingVolumeHierarchy;
using Slot = Hierarchy::Slot;
using OpenPair = CertificateWorkspace::OpenPair;
using detail::Lanes;
using Clock = std::chrono::steady_clock;

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

double size(const Hierarchy& hierarchy, Slot slot) {
  const Hierarchy::Node& node = hierarchy.nodes()[slot / Hierarchy::kWidth];
  const std::size_t lane = slot % Hierarchy::kWidth;
  return node.half[0][lane] * node.half[0][lane] + node.half[1][lane] * node.half[1][lane] +
         node.half[2][lane] * node.half[2][lane];
}

detail::BoundScale boundScale(double scale) {
  return {scale, 1.0 / scale, kBoundError * scale};
}

class BranchAndBound {
 public:
  BranchAndBound(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const CertificateRequest& request, CertificateWorkspace& workspace)
      : body_a_(a),
        body_b_(b),
        a_(a.hierarchy()),
        b_(b.hierarchy()),
        a_from_b_(a_from_b),
        frames_(a.hierarchy().origin(), b.hierarchy().origin(), a_from_b),
        turned_(frames_.rotation.transpose()),
        request_(request),
        open_(workspace.open),
        refinement_(workspace.refinement),
        scale_(boundScale(a.hierarchy().reach() + b.hierarchy().reach() + frames_.offset.norm())),
        slack_(scale_.slack),
        error_(kProofError * scale_.scale) {}

  DistanceCertificate run(const TrianglePair* seeds, std::size_t seed_count) {
    const bool timed = std::isfinite(request_.time_budget);
    const Clock::time_point start = timed ? Clock::now() : Clock::time_point();
    for (std::size_t i = 0; i < seed_count; ++i) descend(seeds[i]);
    if (seed_count == 0) dive();
    const double seeded = distance_;
    if (open_.empty()) open_.resize(Hierarchy::kWidth);
    open_[0] = {Hierarchy::kRoot, Hierarchy::kRoot, 0.0};
    open_count_ = 1;
    std::uint32_t until_look = kClockInterval;
    bool out_of_time = false;
    while (open_count_ > 0 && squared_distance_ > 0.0) {
      if (timed && --until_look == 0) {
        until_look = kClockInterval;
        if (std::chrono::duration<double>(Clock::now() - start).count() >= request_.time_budget) {
          out_of_time = true;
          break;
        }
      }
      const OpenPair next = take(timed);
      if (next.squared_bound >= squared_enough_) {
        exclude(next.squared_bound);
      } else {
        expand(next, timed);
      }
    }
    result_.improved = distance_ < seeded - error_;
    conclude(out_of_time);
    return result_;
  }

 private:
  // With a budget the least bound comes first, so that the proven bound rises as fast as it can; without one
  // a stack does, which costs less.
  OpenPair take(bool best_first) {
    if (best_first) std::pop_heap(open_.begin(), open_.begin() + openCount(), isFarther);
    return open_[--open_count_];
  }

  static bool isFarther(const OpenPair& l, const OpenPair& r) { return l.squared_bound > r.squared_bound; }

  void exclude(double squared_bound) { squared_excluded_ = std::min(squared_excluded_, squared_bound); }

  void descend(const TrianglePair& seed) {
    const WitnessRefinement refined = refineWitness(body_a_, body_b_, a_from_b_, seed.a, seed.b, refinement_);
    result_.cost.triangle_pairs += refined.iterations;
    consider(refined.witness.triangle_a, refined.witness.triangle_b);
  }

  /// The pair once more in the frame that everything else here is measured in.
  void consider(TriangleIndex triangle_a, TriangleIndex triangle_b) {
    measure(frames_.cornersOfA(body_a_, triangle_a), frames_.cornersOfB(body_b_, triangle_b), triangle_a,
            triangle_b);
  }

  TrianglePairDistance measure(const TrianglePoints& a, const TrianglePoints& b, TriangleIndex triangle_a,
                               TriangleIndex triangle_b) {
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
    }
    const double tolerance = std::max(request_.absolute_tolerance, request_.relative_tolerance * distance_);
    enough_ = std::max(0.0, distance_ - std::max(tolerance, error_));
    squared_enough_ = enough_ * enough_;
    return found;
  }

  /// One way down to a pair of leaves, always to the nearer box, to have something to compare with.
  void dive() {
    Slot a = Hierarchy::kRoot;
    Slot b = Hierarchy::kRoot;
    while (!isLeaf(a_.child(a)) || !isLeaf(b_.child(b))) {
      const bool opens_b = opensB(a, b);
      Slot& opened = opens_b ? b : a;
      const Lanes bounds = childBounds(a, b, opens_b);
      const Hierarchy& tree = opens_b ? b_ : a_;
      const std::uint32_t child = tree.child(opened);
      const Hierarchy::Node& node = tree.nodes()[child];
      Eigen::Index best = 0;
      for (Eigen::Index lane = 1; lane < bounds.size(); ++lane) {
        if (node.child[lane] != Hierarchy::kNoChild && bounds[lane] < bounds[best]) best = lane;
      }
      opened = child * static_cast<std::uint32_t>(Hierarchy::kWidth) + static_cast<std::uint32_t>(best);
    }
    descend({leafOf(a_, a_.child(a)).triangle[0], leafOf(b_, b_.child(b)).triangle[0]});
  }

  bool opensB(Slot a, Slot b) const {
    if (isLeaf(a_.child(a))) return true;
    return !isLeaf(b_.child(b)) && size(b_, b) >= size(a_, a);
  }

  /// Bounds of one box against the children of the other one.
  Lanes childBounds(Slot a, Slot b, bool opens_b) {
    result_.cost.box_bounds += static_cast<std::uint32_t>(Hierarchy::kWidth);
    if (opens_b) {
      if (a != compared_slot_a_) {
        OrientedBox box = a_.box(a);
        box.centre = turned_ * (box.centre - frames_.offset);
        box.axes = turned_ * box.axes;
        compared_a_ = detail::ComparedBox(box, scale_.inverse_scale);
        compared_slot_a_ = a;
      }
      return detail::squaredBounds(b_.nodes()[b_.child(b)], compared_a_, direction_in_b_, scale_, enough_);
    }
    if (b != compared_slot_b_) {
      OrientedBox box = b_.box(b);
      box.centre = frames_.rotation * box.centre + frames_.offset;
      box.axes = frames_.rotation * box.axes;
      compared_b_ = detail::ComparedBox(box, scale_.inverse_scale);
      compared_slot_b_ = b;
    }
    return detail::squaredBounds(a_.nodes()[a_.child(a)], compared_b_, -direction_, scale_, enough_);
  }

  void expand(const OpenPair& pair, bool best_first) {
    const std::uint32_t child_a = a_.child(pair.a);
    const std::uint32_t child_b = b_.child(pair.b);
    if (isLeaf(child_a) && isLeaf(child_b)) {
      measureLeaves(leafOf(a_, child_a), leafOf(b_, child_b));
      return;
    }
    const bool opens_b = opensB(pair.a, pair.b);
    const std::uint32_t opened = opens_b ? child_b : child_a;
    const Hierarchy::Node& node = (opens_b ? b_ : a_).nodes()[opened];
    const Lanes bounds = childBounds(pair.a, pair.b, opens_b);
    if (open_.size() < open_count_ + Hierarchy::kWidth) open_.resize(2 * open_.size() + 256);
    std::uint32_t nearest = Hierarchy::kWidth;
    double nearest_bound = squared_enough_;
    const auto add = [&](std::uint32_t lane, double bound) {
      // Field by field: a pair put together on the stack first would stall the store buffer.
      const Slot slot = opened * static_cast<std::uint32_t>(Hierarchy::kWidth) + lane;
      OpenPair& child = open_[open_count_++];
      child.a = opens_b ? pair.a : slot;
      child.b = opens_b ? slot : pair.b;
      child.squared_bound = bound;
      if (best_first) std::push_heap(open_.begin(), open_.begin() + openCount(), isFarther);
    };
    for (std::uint32_t lane = 0; lane < Hierarchy::kWidth; ++lane) {
      if (node.child[lane] == Hierarchy::kNoChild) break;
      const double bound = std::max(bounds[lane], pair.squared_bound);
      if (bound >= squared_enough_) {
        exclude(bound);
      } else if (bound < nearest_bound) {
        if (nearest != Hierarchy::kWidth) add(nearest, nearest_bound);
        nearest = lane;
        nearest_bound = bound;
      } else {
        add(lane, bound);
      }
    }
    if (nearest != Hierarchy::kWidth) add(nearest, nearest_bound);  // is taken next
  }

  std::ptrdiff_t openCount() const { return static_cast<std::ptrdiff_t>(open_count_); }

  void measureLeaves(const Hierarchy::Leaf& leaf_a, const Hierarchy::Leaf& leaf_b) {
    ++result_.cost.leaf_pairs;
    detail::LeafLanes b(leaf_b, frames_.rotation, frames_.offset);
    const Lanes least = detail::leastAlong(b, direction_);
    const Lanes most = detail::mostAlong(leaf_a, direction_) + slack_;
    if (least.minCoeff() - most.maxCoeff() >= enough_) return;
    b.computeNormals();
    const unsigned all = (1U << leaf_b.count) - 1U;
    // The direction between the last pair measured here parts its neighbours as well, as a rule.
    Vector3d near_direction = Vector3d::Zero();
    Lanes near_least = Lanes::Zero();
    Lanes near_most = Lanes::Zero();
    for (std::size_t i = 0; i < leaf_a.count; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      unsigned left = all & detail::lanesBelow(least, most[row] + enough_) &
                      detail::lanesBelow(near_least, near_most[row] + enough_);
      if (left == 0) continue;
      const TrianglePoints a = detail::triangleOf(leaf_a, i);
      left = detail::closerThanByPlanes(a, b, enough_, slack_, left);
      while (left != 0) {
        unsigned lane = 0;
        while ((left >> lane & 1U) == 0) ++lane;
        left &= ~(1U << lane);
        const TrianglePairDistance found =
            measure(a, b.triangle(lane), leaf_a.triangle[i], leaf_b.triangle[lane]);
        if (left == 0 && i + 1 == leaf_a.count) break;
        near_direction = found.point_b - found.point_a;
        const double length = near_direction.norm();
        if (!(length > 0.0)) return;
        near_direction /= length;
        near_least = detail::leastAlong(b, near_direction);
        near_most = detail::mostAlong(leaf_a, near_direction) + slack_;
        left &= detail::lanesBelow(near_least, near_most[row] + enough_);
      }
    }
  }

  void conclude(bool out_of_time) {
    result_.witness = frames_.toWitness(closest_, triangle_a_, triangle_b_);
    result_.distance = distance_;
    double bound = std::min(distance_ - error_, std::sqrt(squared_excluded_));
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
  }

  const BodyMesh& body_a_;
  const BodyMesh& body_b_;
  const Hierarchy& a_;
  const Hierarchy& b_;
  const Eigen::Isometry3d& a_from_b_;
  const detail::LocalFrames frames_;
  const Matrix3d turned_;  ///< from A's axes to B's
  const CertificateRequest& request_;
  std::vector<OpenPair>& open_;  ///< the first open_count_ of it
  std::size_t open_count_ = 0;
  RefinementWorkspace& refinement_;
  const detail::BoundScale scale_;
  const double slack_;
  const double error_;
  DistanceCertificate result_;

  TrianglePairDistance closest_{};
  TriangleIndex triangle_a_;
  TriangleIndex triangle_b_;
  double squared_distance_ = std::numeric_limits<double>::infinity();
  double distance_ = std::numeric_limits<double>::infinity();
  Vector3d direction_ = Vector3d::Zero();  ///< from A's witness to B's, unit
  Vector3d direction_in_b_ = Vector3d::Zero();
  double enough_ = std::numeric_limits<double>::infinity();  ///< farther than this need not be opened
  double squared_enough_ = std::numeric_limits<double>::infinity();
  double squared_excluded_ = std::numeric_limits<double>::infinity();

  // Boxes are compared several times in a row.
  Slot compared_slot_a_ = Hierarchy::kNoChild;
  Slot compared_slot_b_ = Hierarchy::kNoChild;
  detail::ComparedBox compared_a_;
  detail::ComparedBox compared_b_;
};

}  // namespace

std::string_view toString(CertificateStatus status) {
  switch (status) {
    case CertificateStatus::Proven:
      return "proven";
    case CertificateStatus::Tolerance:
      return "tolerance";
    case CertificateStatus::Budget:
      return "budget";
    case CertificateStatus::Penetrating:
      return "penetrating";
  }
  return "unknown";
}

double proofScale(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const Vector3d offset = a_from_b * b.hierarchy().origin() - a.hierarchy().origin();
  return a.hierarchy().reach() + b.hierarchy().reach() + offset.norm();
}

DistanceCertificate certifyDistance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                    const TrianglePair* seeds, std::size_t seed_count,
                                    const CertificateRequest& request, CertificateWorkspace& workspace) {
  return BranchAndBound(a, b, a_from_b, request, workspace).run(seeds, seed_count);
}

}  // namespace concave_distance
