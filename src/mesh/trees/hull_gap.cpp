#include "hull_gap.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "base/constants.h"
#include "base/exact_orientation.h"
#include "base/triangle_measures.h"
#include "mesh/surface/surface_moments.h"
#include "normal_cone.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// The rounding of a point's height over a plane through the centre, relative to the body's reach.
constexpr double kRounding = 0x1.0p-51;

std::array<Vector3d, 3> cornersOf(const SurfaceMesh& mesh, std::size_t triangle) {
  const TriangleIndex t{triangle};
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

/// The centre of mass of the solid, or the middle of the box where rounding decides.
Vector3d centreOf(const SurfaceMesh& mesh) {
  const detail::SurfaceMoments moments(mesh);
  const Vector3d centre = moments.centre();
  return mesh.boundingBox().contains(centre) ? centre : moments.origin;
}

/// True when every ray from the centre crosses the closed surface once: no triangle is seen from behind, and
/// together they cover the sphere once.
bool isStarShaped(const SurfaceMesh& mesh, const Vector3d& centre) {
  double covered = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto [p, q, r] = cornersOf(mesh, t);
    if (detail::orientationSign(p, q, r, centre) >= 0) return false;
    covered += solidAngle(p - centre, q - centre, r - centre);
  }
  return covered < 6.0 * kPi;
}

/// A half-space that holds the whole surface: dot(normal, x - centre) <= most.
struct HalfSpace {
  Vector3d normal;
  double most;
};

class GapMeasure {
 public:
  GapMeasure(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree,
             const Vector3d& centre)
      : mesh_(mesh),
        topology_(topology),
        tree_(tree),
        centre_(centre),
        widest_(kWidestHullGap * mesh.diameter()) {
    rounding_ = kRounding * (mesh.diameter() + centre.cwiseAbs().maxCoeff());
  }

  HullGap measure() {
    half_spaces_.resize(mesh_.triangleCount());
    HullGap measured;
    measured.gap = 0.0;
    measured.shallow = kShallowGap * mesh_.diameter();
    measured.behind.resize(mesh_.triangleCount());
    for (std::size_t t = 0; t < mesh_.triangleCount(); ++t) {
      const double gap = gapOver(t);
      if (!(gap <= widest_)) return {};
      measured.gap = std::max(measured.gap, gap);
      measured.behind[t] = !(heightOver(t) <= measured.shallow);
      if (gap > measured.shallow) measured.dents.push_back({TriangleIndex{t}, gap});
    }
    const auto behind = std::count(measured.behind.begin(), measured.behind.end(), true);
    if (4 * static_cast<std::size_t>(behind) > mesh_.triangleCount()) {
      measured.behind.clear();
      measured.dents.clear();
    }
    return measured;
  }

 private:
  /// Bounds the gap over a triangle. A needle's own plane may be far off: its neighbours' bound the hull,
  /// too.
  double gapOver(std::size_t t) {
    double gap = gapBelow(halfSpace(t), t);
    for (const TriangleIndex next : topology_.triangle_across_edge[t]) {
      if (gap <= 64.0 * rounding_ || next == kNoTriangle) continue;
      gap = std::min(gap, gapBelow(halfSpace(next.value), t));
    }
    return gap;
  }

  /// Bounds how far the surface reaches over the triangle's plane, whatever the rounding of its normal.
  double heightOver(std::size_t t) {
    const HalfSpace& half_space = halfSpace(t);
    double least = kInfinite;
    for (const Vector3d& corner : cornersOf(mesh_, t)) {
      least = std::min(least, half_space.normal.dot(corner - centre_));
    }
    return half_space.most - least + rounding_ +
           detail::normalError(mesh_, TriangleIndex{t}) * mesh_.diameter();
  }

  /// Bounds the way from the triangle's points out of a half-space along the rays through them. It is convex
  /// over the triangle: the corners have the most.
  double gapBelow(const HalfSpace& half_space, std::size_t t) const {
    double longest = 0.0;
    double farthest = 0.0;
    for (const Vector3d& corner : cornersOf(mesh_, t)) {
      const Vector3d ray = corner - centre_;
      const double along = half_space.normal.dot(ray) - rounding_;
      if (!(along > 0.0)) return kInfinite;
      longest = std::max(longest, (half_space.most - along) / along);
      farthest = std::max(farthest, ray.norm());
    }
    return longest * farthest;
  }

  const HalfSpace& halfSpace(std::size_t t) {
    std::optional<HalfSpace>& known = half_spaces_[t];
    if (!known) {
      const auto [p, q, r] = cornersOf(mesh_, t);
      const Vector3d normal = (q - p).cross(r - p).normalized();
      const double own =
          std::max({normal.dot(p - centre_), normal.dot(q - centre_), normal.dot(r - centre_)});
      known = HalfSpace{normal, farthestAlong(normal, own) + rounding_};
    }
    return *known;
  }

  /// How far the surface reaches along a direction, metres from the centre; `least` is reached.
  double farthestAlong(const Vector3d& direction, double least) {
    open_.assign(1, 0);
    double most = least;
    while (!open_.empty()) {
      const std::uint32_t index = open_.back();
      open_.pop_back();
      const TriangleTree::Node& node = tree_.nodes()[index];
      const double reach =
          direction.dot(node.box.center() - centre_) + 0.5 * direction.cwiseAbs().dot(node.box.sizes());
      // A reach within rounding of the farthest does not count.
      if (!(reach > most + rounding_)) continue;
      if (node.count == 0) {
        open_.push_back(index + 1);
        open_.push_back(node.first);
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        for (const Vector3d& corner : cornersOf(mesh_, tree_.order()[i].value)) {
          most = std::max(most, direction.dot(corner - centre_));
        }
      }
    }
    return most + rounding_;
  }

  const SurfaceMesh& mesh_;
  const MeshTopology& topology_;
  const TriangleTree& tree_;
  Vector3d centre_;
  double widest_;
  double rounding_;                                    ///< metres, of a height over a plane
  std::vector<std::optional<HalfSpace>> half_spaces_;  ///< by triangle, where asked for
  std::vector<std::uint32_t> open_;
};

}  // namespace

HullGap measureHullGap(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree) {
  if (!topology.allShellsClosed()) return {};
  const Vector3d centre = centreOf(mesh);
  if (!isStarShaped(mesh, centre)) return {};
  return GapMeasure(mesh, topology, tree, centre).measure();
}

}  // namespace concave_distance
