#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

/// A triangle of one body's surface inside the other body. Of a triangle that is partly inside, the part is a
/// fan; where it is not convex, some of the fan's triangles count negatively and some lie partly outside.
struct OverlapFacet {
  std::array<Eigen::Vector3d, 3> corners_in_a;
  Eigen::Vector3d normal_in_a;  ///< unit, out of the body that owns it
  TriangleIndex triangle;       ///< of that body
  bool of_b = false;            ///< else of A
  bool is_negative = false;
  bool may_leave = false;  ///< parts of it may be outside the other body
};

/// A point of one body's surface inside the other, with its share of that surface. Sums over the samples of a
/// region of area * f(point, depth) are integrals over the mean of both surfaces. A triangle of a mesh that
/// is sampled whole gives three in turn, at the middles of its edges and of equal area and push.
struct OverlapSample {
  Eigen::Vector3d point_in_a;
  /// Unit, the way B is pushed there: out of A's surface, into B's.
  Eigen::Vector3d push_in_a;
  /// Unit, the way for B on which the depth decreases fastest; push_in_a where the depth is 0.
  Eigen::Vector3d exit_in_a;
  /// m^2, half of the surface that it stands for; < 0 where a fan counts negatively. Of an exact round body
  /// all of it: samples are then on the other body's surface alone, or on one of two round ones.
  double area;
  double depth;  ///< metres to the other body's surface
};

/// One place where two bodies overlap: a connected component of the regularised intersection of the two
/// solids, cavities counted to the region around them. What is not defined is NaN. All in A's frame.
/// The definitions with their reasons and bounds: doc/interference.md.
struct InterferenceRegion {
  /// Says how deep the surfaces lie in each other, metres: it is the greatest distance of a point of either
  /// surface in the region to the other body's surface. It changes by no more than the points move.
  double depth = std::numeric_limits<double>::quiet_NaN();
  /// Says how far B must be moved along the normal to take this region apart, metres: it is, over all lines
  /// along the normal, the greatest way from the region's part of B's surface up to its part of A's. Of a
  /// swallowed shell, which has no part of the other surface: how far until the bodies' extents along the
  /// normal part.
  double depth_along_normal = std::numeric_limits<double>::quiet_NaN();
  /// The ends of that line, on A's surface and `depth_along_normal` below it on B's.
  Eigen::Vector3d along_normal_a_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d along_normal_b_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Length of the vector area of A's surface inside B, m^2: what the loops enclose, seen along the normal.
  /// For a sphere of radius R pressed into a plane by delta pi 2 R delta at first order, as Carretero's a =
  /// sqrt(A / pi) of equation expects.
  double contact_area = std::numeric_limits<double>::quiet_NaN();
  double surface_area_a = std::numeric_limits<double>::quiet_NaN();  ///< of A's surface inside B, m^2
  double surface_area_b = std::numeric_limits<double>::quiet_NaN();  ///< of B's surface inside A, m^2
  double volume = std::numeric_limits<double>::quiet_NaN();          ///< m^3
  /// The centroid is that of the volume; where that vanishes, of the surfaces inside; where these are not
  /// defined, of the curves.
  Eigen::Vector3d centroid_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// Unit, from A to B: the direction of the vector area of A's surface inside B, which is minus that of B's
  /// inside A, since both have the same loops.
  Eigen::Vector3d normal_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// The depth is attained between these points, on A's surface and on B's: one lies inside the other body,
  /// the other is the closest point of that body's surface.
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  double reach = 0.0;              ///< of its curves from the centroid, metres; 0 for a swallowed shell
  std::uint32_t loop_count = 0;    ///< closed intersection curves; 0 for a swallowed shell
  std::uint32_t first_loop = 0;    ///< in Interference::loop_areas_in_a
  std::uint32_t first_facet = 0;   ///< in Interference::facets
  std::uint32_t facet_count = 0;   ///< 0 where surfaces only touch, are open or round
  std::uint32_t first_sample = 0;  ///< in Interference::samples
  std::uint32_t sample_count = 0;
  /// Every shell concerned is closed. Else the region is a connected piece of the intersection curve (or a
  /// swallowed open shell): areas, volume and depth are NaN, the normal is the curve's vector area or, where
  /// it is straight or undecided, any direction across it.
  bool closed = true;
  /// Thinner than roundings: the volume is at most twice Interference::rounding_bound times the
  /// surface. The surfaces touch; the depth is 0 but for roundings, the contact area that of the common
  /// part of flush faces.
  bool touching = false;
  /// The vector areas of the loops cancel (a peg through a plate) or there is none (a swallowed shell): the
  /// normal is then one of a few candidates whose depth is the least to 1 %: of those the one most along the
  /// known normal, or without one along a fixed direction, so that rounding decides nothing.
  bool normal_is_fallback = false;
  bool a_swallowed = false;  ///< a shell of A inside B that meets no surface of B
  bool b_swallowed = false;  ///< the same of B in A
  /// False where the bodies' own triangles pass through each other or are wound both ways near this region:
  /// its numbers are then no more than a guide.
  bool consistent = true;
};

enum class InterferenceStatus : std::uint8_t {
  Ok,
  InvalidPose,  ///< not finite or not a rotation within 1e-3: nothing was computed
  Cut,          ///< the limit was reached first: there are no regions
};

struct Interference {
  InterferenceStatus status = InterferenceStatus::Ok;
  std::vector<InterferenceRegion> regions;  ///< deepest first; those without a depth last
  std::vector<OverlapFacet> facets;         ///< of all regions: each surface inside the other body
  std::vector<OverlapSample> samples;       ///< of all regions
  /// Regions with facets list here the vector areas of A's side of their loops, m^2.
  std::vector<Eigen::Vector3d> loop_areas_in_a;
  bool a_inside_b = false;  ///< A lies in B's material, the surfaces do not meet
  bool b_inside_a = false;
  /// Rounding moves B's vertices in A's frame by at most this, and depths are sure to it, metres.
  double rounding_bound = 0.0;
};

/// Buffers of one thread; cleared, never freed. Grows to 36 bytes a vertex and 8 a triangle of the largest
/// bodies, and to what the largest regions need.
class InterferenceWorkspace {
 public:
  InterferenceWorkspace();
  ~InterferenceWorkspace();
  InterferenceWorkspace(InterferenceWorkspace&&) noexcept;
  InterferenceWorkspace& operator=(InterferenceWorkspace&&) noexcept;

  struct Implementation;
  Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

struct KnownNormal {
  Eigen::Vector3d centroid_in_a;
  double reach;  ///< metres: regions farther from it are others
  Eigen::Vector3d normal_in_a;
};

/// All regions where the bodies overlap. Exact but for the rounding of B's vertices into A's frame and of the
/// crossing points: which triangles cross where is decided by exact predicates, exact coincidences by moving
/// B by an infinitesimal and by minus that. a_from_b must be rigid to rounding. Time grows with the crossing
/// triangles, the surface inside the other body and the logarithm of the rest. Never throws but for lack of
/// memory; allocates nothing once workspace and result have grown.
/// @param limit checked for every pair of boxes and of triangles, and between passes; nullptr: none
/// @param known a moment ago: of these a fallback normal (normal_is_fallback) keeps the nearest while its
///        depth is within 1 % of the least
void findInterference(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                      InterferenceWorkspace& workspace, Interference& result, WorkLimit* limit = nullptr,
                      const std::vector<KnownNormal>& known = {});

}  // namespace concave_distance
