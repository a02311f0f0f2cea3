#include "constraint_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

constexpr double kUnitTolerance = 1e-9;

void checkConstraint(const LinearConstraint& constraint, const std::string& where) {
  const double length = constraint.normal.norm();
  if (!std::isfinite(constraint.offset) || !(std::abs(length - 1.0) <= kUnitTolerance)) {
    throw Error(where,
                "a constraint has a normal of length " + std::to_string(length) + " and the offset " +
                    std::to_string(constraint.offset),
                "divide a . p + b by the length of a, so that its value is a distance");
  }
}

}  // namespace

ConstraintTree::ConstraintTree(const PieceDescription& root, const Eigen::AlignedBox3d& bounding_box,
                               double tolerance, const std::string& where)
    : bounding_box_(bounding_box), tolerance_(tolerance) {
  if (bounding_box.isEmpty() || !bounding_box.min().allFinite() || !bounding_box.max().allFinite()) {
    throw Error(where, "the bounding box is empty or not finite", "give the corners of the body's box");
  }
  if (!(tolerance >= 0.0) || !std::isfinite(tolerance)) {
    throw Error(where, "the tolerance is " + std::to_string(tolerance), "give a length of at least 0");
  }
  std::vector<const PieceDescription*> queue{&root};
  pieces_.emplace_back();
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const PieceDescription& described = *queue[i];
    if (described.constraints.empty()) {
      throw Error(where, "piece " + std::to_string(i) + " has no constraint", "give at least one");
    }
    pieces_[i].first_constraint = static_cast<std::uint32_t>(constraints_.size());
    pieces_[i].constraint_count = static_cast<std::uint32_t>(described.constraints.size());
    for (const LinearConstraint& constraint : described.constraints) {
      checkConstraint(constraint, where);
      constraints_.push_back(constraint);
    }
    pieces_[i].first_child = static_cast<std::uint32_t>(queue.size());
    pieces_[i].child_count = static_cast<std::uint32_t>(described.children.size());
    for (const PieceDescription& child : described.children) {
      queue.push_back(&child);
      TreePiece& piece = pieces_.emplace_back();
      const int level = pieces_[i].level;
      piece.level = level > 0 ? -(level + 1) : 1 - level;
      piece.parent = static_cast<std::uint32_t>(i);
    }
  }
}

std::vector<std::uint32_t> ConstraintTree::objectId(std::uint32_t piece) const {
  std::vector<std::uint32_t> id;
  for (; pieces_[piece].parent != kNoPiece; piece = pieces_[piece].parent) {
    id.push_back(piece - pieces_[pieces_[piece].parent].first_child + 1);
  }
  id.push_back(1);
  std::reverse(id.begin(), id.end());
  return id;
}

PieceDescription ConstraintTree::description(std::uint32_t piece) const {
  const TreePiece& described = pieces_[piece];
  PieceDescription result;
  const auto first = constraints_.begin() + described.first_constraint;
  result.constraints.assign(first, first + described.constraint_count);
  for (std::uint32_t i = 0; i < described.child_count; ++i) {
    result.children.push_back(description(described.first_child + i));
  }
  return result;
}

}  // namespace concave_distance
