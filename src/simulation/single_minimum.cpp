#include "single_minimum.h"

#include <cmath>
#include <utility>

#include "distance/bound/round_certificate.h"

namespace concave_distance {

SingleMinimum::SingleMinimum(std::shared_ptr<const BodyMesh> a, std::shared_ptr<const BodyMesh> b)
    : a_(std::move(a)), b_(std::move(b)) {}

void SingleMinimum::start(TriangleIndex triangle_a, TriangleIndex triangle_b) {
  witness_.triangle_a = triangle_a;
  witness_.triangle_b = triangle_b;
  started_ = true;
  updated_ = false;
}

const WitnessPair& SingleMinimum::update(const Eigen::Isometry3d& a_from_b) {
  const TrianglePair last{witness_.triangle_a, witness_.triangle_b};
  witness_ = hasRound(*a_, *b_) ? refineRoundWitness(*a_, *b_, a_from_b, last)
                                : refineWitness(*a_, *b_, a_from_b, last.a, last.b, workspace_).witness;
  updated_ = true;
  return witness_;
}

double SingleMinimum::distance() const {
  return updated_ ? std::sqrt(witness_.squared_distance) : kNotComputed;
}

bool SingleMinimum::wrong(const PairSolution& proven) const {
  // Far above the kernels' rounding, far below what a user could call another place.
  const double tolerance = 1e-9 * (a_->diameter() + b_->diameter());
  return updated_ && distance() > proven.distance + tolerance;
}

}  // namespace concave_distance
