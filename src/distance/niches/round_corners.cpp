#include "round_corners.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "distance/bound/closest_point.h"
#include "distance/kernels/witness_refinement.h"
#include "mesh/surface/round_geometry.h"

namespace concave_distance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kRounds = 4;           // a plane's normal is found in the first, its point in the second
constexpr double kAlongSide = 0.5;   // of the axis in the normal: below it the side is near, above it an end
constexpr double kAtRim = 0.9;       // of the radius: a corner farther out is one of the disc's rim
constexpr double kSamePlace = 1e-9;  // of the bodies

/// The solid and the mesh in the solid's axes.
class RoundPlaces {
 public:
  RoundPlaces(const RoundShape& shape, const BodyMesh& mesh, TriangleIndex hint,
              const Eigen::Isometry3d& shape_from_mesh)
      : shape_(shape), mesh_(mesh), hint_(hint), shape_from_mesh_(shape_from_mesh) {}

  /// Moves a corner of the inscribed mesh to the solid. @param normal from the solid to the mesh
  void settle(const Vector3d& corner, Vector3d normal, Vector3d& on_shape, Vector3d& on_mesh) const {
    const Eigen::Isometry3d mesh_from_shape = shape_from_mesh_.inverse();
    const bool is_end = std::abs(normal.z()) > kAlongSide && detail::hasFlatEnds(shape_);
    for (int round = 0; round < kRounds; ++round) {
      on_shape = is_end ? onEnd(corner, normal) : onSide(corner, normal);
      on_mesh = shape_from_mesh_ * closestPoint(mesh_, mesh_from_shape * on_shape, hint_).point;
      if (is_end || !((on_mesh - on_shape).norm() > 0.0)) return;
      normal = (on_mesh - on_shape).normalized();
    }
  }

  /// Leads the closest points to where each is the closest to the other. @param normal as settle()
  void settleClosest(Vector3d normal, Vector3d& on_shape, Vector3d& on_mesh) const {
    const Eigen::Isometry3d mesh_from_shape = shape_from_mesh_.inverse();
    for (int round = 0; round < kRounds; ++round) {
      on_shape = detail::supportPoint(shape_, normal);
      on_mesh = shape_from_mesh_ * closestPoint(mesh_, mesh_from_shape * on_shape, hint_).point;
      if (!((on_mesh - on_shape).norm() > 0.0)) return;
      normal = (on_mesh - on_shape).normalized();
    }
  }

 private:
  Vector3d onEnd(const Vector3d& corner, const Vector3d& normal) const {
    const double radius = corner.head<2>().norm();
    const double scale = radius > kAtRim * shape_.radius ? shape_.radius / radius : 1.0;
    return {scale * corner.x(), scale * corner.y(), std::copysign(shape_.half_length, normal.z())};
  }
  Vector3d onSide(const Vector3d& corner, const Vector3d& normal) const {
    const Vector3d core(0.0, 0.0, std::clamp(corner.z(), -shape_.half_length, shape_.half_length));
    const Vector3d out = detail::hasFlatEnds(shape_) ? Vector3d(normal.x(), normal.y(), 0.0) : normal;
    return core + shape_.radius * out.normalized();
  }

  const RoundShape& shape_;
  const BodyMesh& mesh_;
  TriangleIndex hint_;  ///< of the mesh, near its points
  const Eigen::Isometry3d& shape_from_mesh_;
};

/// One solid of the pair in A's frame, and what of it is level with the closest points.
struct LevelSolid {
  enum class Part : std::uint8_t { None, Side, End };

  LevelSolid(const RoundShape& of, const Eigen::Isometry3d& pose, const Vector3d& outwards, double tolerance)
      : shape(of), a_from_shape(pose), shape_from_a(pose.inverse()), out(shape_from_a.linear() * outwards) {
    const double across = std::hypot(out.x(), out.y());
    if (2.0 * shape.half_length * std::abs(out.z()) <= tolerance) part = Part::Side;
    if (detail::hasFlatEnds(shape) && 2.0 * shape.radius * across <= tolerance) part = Part::End;
  }

  Vector3d closestTo(const Vector3d& point_in_a) const {
    return a_from_shape * detail::surfacePoint(shape, shape_from_a * point_in_a);
  }
  /// The middle of the level part, A's frame.
  Vector3d middle() const { return a_from_shape * Vector3d(0.0, 0.0, part == Part::End ? endZ() : 0.0); }
  double endZ() const { return std::copysign(shape.half_length, out.z()); }
  Vector3d axis() const { return a_from_shape.linear().col(2); }

  const RoundShape& shape;
  Eigen::Isometry3d a_from_shape;
  Eigen::Isometry3d shape_from_a;
  Vector3d out;  ///< to the other solid, in the shape's axes
  Part part = Part::None;
};

class PairCorners {
 public:
  PairCorners(const LevelSolid& a, const LevelSolid& b, double farthest, double same, CornerPairs& corners)
      : a_(a), b_(b), farthest_(farthest), same_(same), corners_(corners) {}

  std::size_t find() {
    using Part = LevelSolid::Part;
    if (a_.part == Part::Side && b_.part == Part::Side) {
      addEndsOf(a_, b_);
      addEndsOf(b_, a_);
    } else if (a_.part == Part::Side && b_.part == Part::End) {
      addChord(a_, b_);
    } else if (a_.part == Part::End && b_.part == Part::Side) {
      addChord(b_, a_);
    } else if (a_.part == Part::End && b_.part == Part::End) {
      addLens();
    }
    return count_;
  }

 private:
  /// The ends of a side that lie beside the other one.
  void addEndsOf(const LevelSolid& side, const LevelSolid& other) {
    for (const double end : {-1.0, 1.0}) {
      const double z = end * side.shape.half_length;
      const Vector3d core = other.shape_from_a * (side.a_from_shape * Vector3d(0.0, 0.0, z));
      if (std::abs(core.z()) <= other.shape.half_length + same_) addOnSide(side, other, z);
    }
  }

  /// The ends of what a side has within a disc, seen along the axis of that.
  void addChord(const LevelSolid& side, const LevelSolid& end) {
    const Vector3d from = end.shape_from_a * side.middle();
    const Vector3d along = end.shape_from_a.linear() * side.axis();
    const Vector2d centre = from.head<2>();
    const Vector2d axis = along.head<2>();
    const double half = axis.dot(centre) / axis.squaredNorm();
    const double squared =
        half * half - (centre.squaredNorm() - end.shape.radius * end.shape.radius) / axis.squaredNorm();
    if (!(squared > 0.0)) return;
    for (const double sign : {-1.0, 1.0}) {
      const double z = -half + sign * std::sqrt(squared);
      addOnSide(side, end, std::clamp(z, -side.shape.half_length, side.shape.half_length));
    }
  }

  /// The points farthest in eight directions, fixed to A, of what two discs share.
  void addLens() {
    const Vector2d offset = (a_.shape_from_a * b_.middle()).head<2>();
    const double apart = offset.norm();
    const double radius_a = a_.shape.radius;
    const double radius_b = b_.shape.radius;
    if (apart >= radius_a + radius_b) return;
    for (std::size_t k = 0; k < kMostCorners; ++k) {
      const double angle = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(kMostCorners);
      const Vector2d direction(std::cos(angle), std::sin(angle));
      const Vector2d on_a = radius_a * direction;
      const Vector2d on_b = offset + radius_b * direction;
      if ((on_a - offset).norm() <= radius_b) {
        addOnEnd(a_, b_, on_a);
      } else if (on_b.norm() <= radius_a) {
        const Vector3d in_b = b_.shape_from_a * (a_.a_from_shape * Vector3d(on_b.x(), on_b.y(), a_.endZ()));
        addOnEnd(b_, a_, in_b.head<2>());
      } else {
        // The rims cross on either side of the line of the centres.
        const double along = (apart * apart + radius_a * radius_a - radius_b * radius_b) / (2.0 * apart);
        const double aside = std::sqrt(std::max(0.0, radius_a * radius_a - along * along));
        const Vector2d towards = offset / apart;
        const Vector2d across(-towards.y(), towards.x());
        addOnEnd(a_, b_, along * towards + std::copysign(aside, across.dot(direction)) * across);
      }
    }
  }

  void addOnSide(const LevelSolid& side, const LevelSolid& other, double z) {
    const Vector3d core = side.a_from_shape * Vector3d(0.0, 0.0, z);
    Vector3d normal = side.a_from_shape.linear() * side.out;
    Vector3d on_side;
    Vector3d on_other;
    for (int round = 0; round < kRounds; ++round) {
      if (detail::hasFlatEnds(side.shape)) normal -= normal.dot(side.axis()) * side.axis();
      on_side = core + side.shape.radius * normal.normalized();
      on_other = other.closestTo(on_side);
      normal = on_other - on_side;
      if (!(normal.squaredNorm() > 0.0)) return;
    }
    add(side, on_side, on_other);
  }

  void addOnEnd(const LevelSolid& end, const LevelSolid& other, const Vector2d& place) {
    const Vector3d on_end = end.a_from_shape * Vector3d(place.x(), place.y(), end.endZ());
    add(end, on_end, other.closestTo(on_end));
  }

  void add(const LevelSolid& own, const Vector3d& on_own, const Vector3d& on_other) {
    const bool is_of_a = &own == &a_;
    const CornerPair corner{is_of_a ? on_own : on_other, is_of_a ? on_other : on_own,
                            (on_other - on_own).norm()};
    if (!(corner.distance <= farthest_) || count_ == corners_.size()) return;
    const auto end = corners_.begin() + static_cast<std::ptrdiff_t>(count_);
    const bool is_known = std::any_of(corners_.begin(), end, [&](const CornerPair& other) {
      return (other.point_a_in_a - corner.point_a_in_a).norm() <= same_;
    });
    if (!is_known) corners_[count_++] = corner;
  }

  const LevelSolid& a_;
  const LevelSolid& b_;
  double farthest_;  ///< metres
  double same_;      ///< metres
  CornerPairs& corners_;
  std::size_t count_ = 0;
};

/// Two sides that are parallel have the ends of what they share, a flat end over a side those of its chord,
/// and two flat ends up to 8 points around what their discs share. A corner is a point of the solid that
/// limits the set there, and the other one's closest point, at most `tolerance` farther apart than the
/// witness.
std::size_t findPairCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const WitnessPair& witness, double tolerance, double least_length,
                            CornerPairs& corners) {
  if (!detail::hasSide(*a.shape()) || !detail::hasSide(*b.shape())) return 0;
  const Vector3d normal = (witness.point_b_in_a - witness.point_a_in_a).normalized();
  const LevelSolid of_a(*a.shape(), a.shape()->body_from_shape, normal, tolerance);
  const LevelSolid of_b(*b.shape(), a_from_b * b.shape()->body_from_shape, -normal, tolerance);
  const double same = kSamePlace * (a.diameter() + b.diameter());
  const double farthest = std::sqrt(witness.squared_distance) + tolerance + same;
  const std::size_t count = PairCorners(of_a, of_b, farthest, same, corners).find();
  double length = 0.0;
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t k = 0; k < i; ++k)
      length = std::max(length, (corners[i].point_a_in_a - corners[k].point_a_in_a).norm());
  return length > std::max(same, least_length) ? count : 0;
}

}  // namespace

std::size_t findRoundCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                             const WitnessPair& witness, double tolerance, double least_length,
                             std::size_t pair_limit, std::size_t ring_limit, CornerWorkspace& workspace,
                             CornerPairs& corners) {
  const bool a_is_round = a.shape() != nullptr;
  if (a_is_round && b.shape() != nullptr)
    return findPairCorners(a, b, a_from_b, witness, tolerance, least_length, corners);
  const RoundShape& shape = a_is_round ? *a.shape() : *b.shape();
  if (!detail::hasSide(shape)) return 0;
  const WitnessPair of_meshes =
      refineWitness(a, b, a_from_b, witness.triangle_a, witness.triangle_b, workspace.extent.ring).witness;
  const std::size_t found = findCorners(a, b, a_from_b, of_meshes, tolerance, least_length, pair_limit,
                                        ring_limit, workspace, corners);
  const Eigen::Isometry3d a_from_shape =
      a_is_round ? shape.body_from_shape : a_from_b * shape.body_from_shape;
  const Eigen::Isometry3d shape_from_a = a_from_shape.inverse();
  const Eigen::Isometry3d shape_from_mesh =
      a_is_round ? Eigen::Isometry3d(shape_from_a * a_from_b) : shape_from_a;
  const RoundPlaces places(shape, a_is_round ? b : a, a_is_round ? witness.triangle_b : witness.triangle_a,
                           shape_from_mesh);
  const Vector3d from_a = shape_from_a.linear() * (witness.point_b_in_a - witness.point_a_in_a).normalized();
  const double same = kSamePlace * (a.diameter() + b.diameter());
  const Vector3d outwards = a_is_round ? from_a : Vector3d(-from_a);
  std::size_t count = 0;
  const auto add = [&](const Vector3d& on_shape, const Vector3d& on_mesh) {
    const Vector3d in_a = a_from_shape * on_shape;
    const Vector3d mesh_in_a = a_from_shape * on_mesh;
    const CornerPair settled{a_is_round ? in_a : mesh_in_a, a_is_round ? mesh_in_a : in_a,
                             (on_mesh - on_shape).norm()};
    const bool is_known = std::any_of(
        corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count),
        [&](const CornerPair& other) { return (other.point_a_in_a - settled.point_a_in_a).norm() <= same; });
    if (!is_known) corners[count++] = settled;
  };
  Vector3d on_shape;
  Vector3d on_mesh;
  for (std::size_t i = 0; i < found; ++i) {
    places.settle(shape_from_a * (a_is_round ? corners[i].point_a_in_a : corners[i].point_b_in_a), outwards,
                  on_shape, on_mesh);
    add(on_shape, on_mesh);
  }
  if (found == 0) return 0;
  places.settleClosest(outwards, on_shape, on_mesh);
  const double distance = (on_mesh - on_shape).norm();
  const auto end = corners.begin() + static_cast<std::ptrdiff_t>(count);
  const bool is_nearest =
      std::all_of(corners.begin(), end, [&](const CornerPair& corner) { return distance < corner.distance; });
  if (is_nearest && distance <= std::sqrt(witness.squared_distance) + same) add(on_shape, on_mesh);
  return count;
}

}  // namespace concave_distance
