#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace concave_distance {

/// The half-space normal . p + offset >= 0, one row of A p + b >= 0 (Carretero, app. C.1). The normal is a
/// unit vector that points into the piece; value(p) is then the distance to the plane, metres, body frame.
struct LinearConstraint {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0.0;
  double value(const Eigen::Vector3d& point) const { return normal.dot(point) + offset; }
};

/// What a tree is made from: a convex piece, and the pieces cut out of it.
struct PieceDescription {
  std::vector<LinearConstraint> constraints;
  std::vector<PieceDescription> children;
};

/// No piece: the root's parent.
inline constexpr std::uint32_t kNoPiece = 0xffffffffU;

/// One convex piece of a tree; constraints and children are ranges of the tree's arrays.
struct TreePiece {
  int level = 1;  ///< 1, -2, 3, -4 ...: its sign separates solids from concavities
  std::uint32_t parent = kNoPiece;
  std::uint32_t first_constraint = 0;
  std::uint32_t constraint_count = 0;
  std::uint32_t first_child = 0;
  std::uint32_t child_count = 0;
};

/// A body as a tree of convex pieces (Carretero, sec. 2.1.1, app. C.1): the root is the convex hull (level
/// 1), its children are concavities (level -2), theirs are solids again (level 3), alternating. A point is
/// inside a piece when it satisfies the piece's constraints and is inside none of its children; the body is
/// what is inside the root. Solids are closed sets, concavities open ones, so that a concavity's wall belongs
/// to the body. A piece need not repeat what its ancestors state: the mouth of a concavity, which lies in a
/// face of the hull, is no constraint of the concavity (as a constraint it would leave a lid without
/// thickness, feasible because the concavity is open). Immutable; pieces breadth first, the root is piece 0.
/// Body frame, metres.
class ConstraintTree {
 public:
  /// @param bounding_box of the body, what initial points are drawn from
  /// @param tolerance a constraint counts as met down to minus this, metres; what rounding needs
  /// @throws Error (naming `where`) when a piece has no constraint, a normal is no unit vector, a number is
  /// not
  ///         finite, the box is empty or the tolerance negative
  ConstraintTree(const PieceDescription& root, const Eigen::AlignedBox3d& bounding_box, double tolerance,
                 const std::string& where);

  const std::vector<TreePiece>& pieces() const { return pieces_; }
  const std::vector<LinearConstraint>& constraints() const { return constraints_; }
  const Eigen::AlignedBox3d& boundingBox() const { return bounding_box_; }
  double tolerance() const { return tolerance_; }
  /// Length of the bounding box's diagonal, metres.
  double diameter() const { return bounding_box_.diagonal().norm(); }

  /// The way from the root to a piece, counted from 1, as the thesis writes it: {1, 3, 2} is the second child
  /// of the root's third child (app. C.1).
  std::vector<std::uint32_t> objectId(std::uint32_t piece) const;
  /// The piece and what is below it, as the constructor takes it.
  PieceDescription description(std::uint32_t piece = 0) const;

 private:
  std::vector<TreePiece> pieces_;
  std::vector<LinearConstraint> constraints_;
  Eigen::AlignedBox3d bounding_box_;
  double tolerance_;
};

}  // namespace concave_distance
