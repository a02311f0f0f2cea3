#include "region_depth.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <limits>

#include "mesh/trees/bounding_volume_hierarchy.h"

namespace concave_distance::detail {
namespace {

constexpr std::size_t kLoopDirections = 4;
// A depth within this share of the least one may be preferred.
constexpr double kPreferred = 0.01;

/// Ways out of a region, of which the least one counts, or one nearly as short that is preferred.
class Exits {
 public:
  /// @param known unit, or zero: then a direction that no symmetry of round numbers is across to
  explicit Exits(const Eigen::Vector3d& known)
      : preferred_(known.isZero() ? Eigen::Vector3d(0.2711, 0.5341, 0.8008) : known) {}

  void add(const Eigen::Vector3d& normal, const OverlayDepth::Result& deepest) {
    exits_[count_++] = {normal, deepest};
    least_ = std::min(least_, deepest.depth);
  }
  /// @param otherwise where there is none
  DepthAlong chosen(const DepthAlong& otherwise) const {
    const DepthAlong* best = &otherwise;
    double most_along = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
      const double along = exits_[i].normal.dot(preferred_);
      if (exits_[i].deepest.depth > (1.0 + kPreferred) * least_ || along <= most_along) continue;
      most_along = along;
      best = &exits_[i];
    }
    return *best;
  }

 private:
  static constexpr std::size_t kMost = 1 + 2 * (kLoopDirections + 3);
  Eigen::Vector3d preferred_;
  std::array<DepthAlong, kMost> exits_;
  std::size_t count_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
};

/// A body's support along a few directions.
struct Extents {
  static constexpr std::size_t kDirections = 6;
  std::array<double, kDirections> least;
  std::array<double, kDirections> greatest;
  std::array<NodeIndex, kDirections> least_at;
  std::array<NodeIndex, kDirections> greatest_at;

  Extents() {
    least.fill(std::numeric_limits<double>::infinity());
    greatest.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Eigen::Matrix<double, 6, 3>& directions, NodeIndex vertex, const Eigen::Vector3d& point) {
    const Eigen::Matrix<double, 6, 1> heights = directions * point;
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double height = heights[static_cast<Eigen::Index>(k)];
      if (height < least[k]) {
        least[k] = height;
        least_at[k] = vertex;
      }
      if (height > greatest[k]) {
        greatest[k] = height;
        greatest_at[k] = vertex;
      }
    }
  }
};

}  // namespace

OverlayDepth::Result depthAlong(const Eigen::Vector3d& normal, WorkingFrame& frame,
                                const CrossingCurves& curves, const SurfacePieces (&pieces)[2],
                                const BoundaryComponents& components, const BoundaryComponent& region,
                                OverlayDepth& overlay) {
  overlay.begin(normal, curves.nodes()[region.first_node].position, frame.roundingBound() * frame.scale());
  const BoundaryComponent* part = &region;
  while (true) {
    for (const Side side : {Side::A, Side::B}) {
      const SurfacePieces& on_side = pieces[at(side)];
      forEachWholeTriangle(on_side, *part, side, [&](TriangleIndex triangle) {
        const Corners c = frame.corners(side, triangle);
        overlay.addFace(side, frame.normal(side, triangle));
        for (std::size_t k = 0; k < 3; ++k) overlay.addEdge(side, *c[k], *c[(k + 1) % 3]);
      });
      forEachCutTriangle(on_side, *part, side,
                         [&](TriangleIndex triangle, std::uint32_t first, std::uint32_t last) {
                           overlay.addFace(side, frame.normal(side, triangle));
                           for (std::uint32_t i = first; i < last; ++i)
                             overlay.addEdge(side, on_side.edges()[i].from, on_side.edges()[i].to);
                         });
    }
    // Facets that both surfaces have in common count for both.
    const auto own = static_cast<std::uint32_t>(part - components.all().data());
    for (std::size_t f = 0; f < curves.commonFaces().size(); ++f) {
      const CommonFace& face = curves.commonFaces()[f];
      if (face.opposite || components.componentOfCommonFace()[f] != own) continue;
      const Side side = other(face.inside);
      overlay.addFace(side, frame.normal(side, face.triangle[at(side)]));
      for (std::size_t k = 0; k < face.corner_count; ++k)
        overlay.addEdge(side, face.corners[k], face.corners[(k + 1) % face.corner_count]);
    }
    if (part->next_cavity == kNone) break;
    part = &components.all()[part->next_cavity];
  }
  return overlay.solve();
}

DepthAlong leastDepth(WorkingFrame& frame, const CrossingCurves& curves, const SurfacePieces (&pieces)[2],
                      BoundaryComponents& components, const BoundaryComponent& region, UnionFind& sets,
                      const Eigen::Vector3d& known, OverlayDepth& overlay) {
  std::array<Eigen::Vector3d, kLoopDirections + 3> directions;
  std::size_t count = 0;
  const std::uint32_t own = components.componentOfNode(region.first_node, sets);
  for (std::uint32_t n = 0; n < curves.nodes().size(); ++n) {
    if (components.loopOf(n) != n || components.componentOfNode(n, sets) != own) continue;
    const Eigen::Vector3d& area = components.vectorAreaOfLoop(n);
    std::size_t place = std::min(count, kLoopDirections);
    while (place > 0 && directions[place - 1].squaredNorm() < area.squaredNorm()) --place;
    if (place == kLoopDirections) continue;
    count = std::min(count + 1, kLoopDirections);
    for (std::size_t k = count - 1; k > place; --k) directions[k] = directions[k - 1];
    directions[place] = area;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(region.facing);
  for (int k = 2; k >= 0; --k) directions[count++] = principal.eigenvectors().col(k);

  const double rounding = frame.roundingBound() * frame.scale();
  const double trivial = region.volume > 2.0 * rounding * region.surface() ? rounding : -1.0;
  Exits exits(known);
  const auto consider = [&](const Eigen::Vector3d& normal) {
    const OverlayDepth::Result deepest =
        depthAlong(normal, frame, curves, pieces, components, region, overlay);
    // A way on which none of B's part is below A's is none: flush faces, of which each side has a part only.
    if (deepest.depth > trivial) exits.add(normal, deepest);
  };
  if (!known.isZero()) consider(known);
  for (std::size_t k = 0; k < count; ++k) {
    const double length = directions[k].stableNorm();
    if (!(length > 0.0)) continue;
    consider(directions[k] / length);
    consider(-directions[k] / length);
  }
  return exits.chosen({Eigen::Vector3d::UnitX(), {0.0, region.reference, region.reference}});
}

DepthAlong leastExit(WorkingFrame& frame, Side side, const SurfacePieces& pieces,
                     const BoundaryComponent& region, const Eigen::Vector3d& known) {
  Eigen::Matrix<double, 6, 3> directions;
  directions.topRows<3>() =
      frame.body(Side::A).hierarchy().box(BoundingVolumeHierarchy::kRoot).axes.transpose();
  directions.bottomRows<3>() =
      (frame.aFromB().linear() * frame.body(Side::B).hierarchy().box(BoundingVolumeHierarchy::kRoot).axes)
          .transpose();
  directions.rowwise().normalize();
  Extents extents[2];
  forEachWholeTriangle(pieces, region, side, [&](TriangleIndex triangle) {
    for (const NodeIndex node : frame.surface(side).triangle(triangle))
      extents[at(side)].add(directions, node, frame.point(side, node));
  });
  for (std::uint32_t v = 0; v < frame.surface(other(side)).vertexCount(); ++v)
    extents[at(other(side))].add(directions, NodeIndex{v}, frame.point(other(side), NodeIndex{v}));
  Exits exits(known);
  for (std::size_t k = 0; k < Extents::kDirections; ++k) {
    const Eigen::Vector3d direction = directions.row(static_cast<Eigen::Index>(k)).transpose();
    exits.add(direction,
              {extents[0].greatest[k] - extents[1].least[k], frame.point(Side::A, extents[0].greatest_at[k]),
               frame.point(Side::B, extents[1].least_at[k])});
    exits.add(-direction,
              {extents[1].greatest[k] - extents[0].least[k], frame.point(Side::A, extents[0].least_at[k]),
               frame.point(Side::B, extents[1].greatest_at[k])});
  }
  return exits.chosen({Eigen::Vector3d::UnitX(), {0.0, region.reference, region.reference}});
}

}  // namespace concave_distance::detail
