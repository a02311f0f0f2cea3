#include "find_cavities.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "mesh/trees/ray_crossing.h"

namespace concave_distance::detail {
namespace {

/// Number of triangles of a unit that are tested against another unit.
constexpr std::size_t kSamples = 16;
/// Boxes and triangles visited, some seconds; units that are not decided by then bound material.
constexpr std::uint64_t kMostWork = std::uint64_t{1} << 28U;
/// Relative to the largest coordinate: a point this near to a surface may lie on it, given rounding.
constexpr double kOnSurface = 32.0 * std::numeric_limits<double>::epsilon();

using Corners = std::array<Eigen::Vector3d, 3>;

Eigen::AlignedBox3d boxOf(const Corners& corners) {
  return Eigen::AlignedBox3d(corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]),
                             corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]));
}

/// A tree over boxes: over triangles that have these bounding boxes.
TriangleTree treeOver(const std::vector<Eigen::AlignedBox3d>& boxes) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (const Eigen::AlignedBox3d& box : boxes) {
    const NodeIndex low{vertices.size()};
    const NodeIndex high{vertices.size() + 1};
    triangles.push_back({low, high, high});
    vertices.push_back(box.min());
    vertices.push_back(box.max());
  }
  return TriangleTree(SurfaceMesh(std::move(vertices), std::move(triangles), "boxes"));
}

/// The boundary of a unit with a tree over it, for queries what lies inside.
class OuterSkin {
 public:
  /// @param coefficients how often each triangle counts, negative where its back looks out
  OuterSkin(SurfaceMesh mesh, std::vector<int> coefficients)
      : mesh_(std::move(mesh)), tree_(mesh_), coefficients_(std::move(coefficients)) {
    const Eigen::AlignedBox3d& box = mesh_.boundingBox();
    on_surface_ = kOnSurface * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  }

  /// False only where no triangle reaches into the box. @param work counts the triangles visited
  bool mayMeet(const Eigen::AlignedBox3d& box, std::uint64_t& work) const {
    return visitLeaves(
        tree_, [&](const Eigen::AlignedBox3d& node) { return node.intersects(box); },
        [&](TriangleIndex t) {
          ++work;
          return boxOf(cornersOf(mesh_, t)).intersects(box);
        });
  }

  /// Winding number of the skin around a point, by the crossings of a ray; nothing for a point on the skin.
  std::optional<int> windingNumber(const Eigen::Vector3d& point, std::uint64_t& work) const {
    // Slanted against the axes and their diagonals, as in containsPoint().
    static const Eigen::Vector3d direction(0.8431, 0.2749, 0.4620);
    const ShearedRay ray(point, direction);
    const SlabTest passes(point - 4.0 * on_surface_ * direction, direction, 4.0 * mesh_.diameter() + 1e-300);
    int winding = 0;
    const bool is_on_surface = visitLeaves(tree_, passes, [&](TriangleIndex t) {
      ++work;
      const ShearedRay::Meeting met = ray.meeting(cornersOf(mesh_, t));
      if (met.height > 0.0) winding += met.side * coefficients_[t.value];
      return met.side != 0 && std::abs(met.height) <= on_surface_ * met.weight;
    });
    return is_on_surface ? std::nullopt : std::optional<int>(winding);
  }

 private:
  SurfaceMesh mesh_;
  TriangleTree tree_;
  std::vector<int> coefficients_;
  double on_surface_;  ///< metres
};

/// The boundary of a unit, turned outwards.
struct Skin {
  std::vector<std::uint32_t> faces;
  Eigen::AlignedBox3d box;
  double volume = 0.0;  ///< six times the volume
};

class NestedSkins {
 public:
  NestedSkins(const std::vector<Eigen::Vector3d>& vertices, const ResolvedShells& resolved)
      : vertices_(vertices),
        resolved_(resolved),
        skins_(resolved.units.count),
        outer_skins_(resolved.units.count) {
    for (std::uint32_t face = 0; face < resolved.table.faces.size(); ++face) {
      if (resolved.decisions[face].coefficient == 0) continue;
      Skin& skin = skins_[resolved.units.unit_of_face[face]];
      skin.faces.push_back(face);
      for (const NodeIndex node : resolved.table.faces[face].nodes) skin.box.extend(vertices[node.value]);
    }
    for (Skin& skin : skins_) {
      if (!skin.faces.empty()) skin.volume = volumeOf(skin);
    }
  }

  std::vector<bool> cavities() {
    std::vector<bool> is_cavity(skins_.size(), false);
    sortByVolume();
    if (largest_first_.size() < 2) return is_cavity;
    const TriangleTree tree = treeOver(boxes_);
    for (std::uint32_t i = 0; i < largest_first_.size(); ++i) {
      const std::uint32_t unit = largest_first_[i];
      int around = 0;
      std::uint32_t outermost = unit;
      collectBoxesAround(tree, i);
      for (const std::uint32_t k : boxes_around_) {
        const std::uint32_t other = largest_first_[k];
        if (work_ > kMostWork) return is_cavity;
        if (!liesInside(skins_[unit], other)) continue;
        around += is_cavity[other] ? -1 : 1;
        if (outermost == unit) outermost = other;
      }
      is_cavity[unit] = around > 0 && resolved_.unit_is_inward[unit] != resolved_.unit_is_inward[outermost];
    }
    return is_cavity;
  }

 private:
  const Eigen::Vector3d& corner(std::uint32_t face, std::size_t k) const {
    return vertices_[resolved_.table.faces[face].nodes[k].value];
  }

  double volumeOf(const Skin& skin) const {
    const Eigen::Vector3d origin = skin.box.center();
    double sum = 0.0;
    for (const std::uint32_t face : skin.faces) {
      const Eigen::Vector3d b = corner(face, 1) - origin;
      sum += resolved_.decisions[face].coefficient *
             (corner(face, 0) - origin).dot(b.cross(corner(face, 2) - origin));
    }
    return sum;
  }

  void sortByVolume() {
    for (std::uint32_t unit = 0; unit < skins_.size(); ++unit) {
      if (!skins_[unit].faces.empty()) largest_first_.push_back(unit);
    }
    std::stable_sort(largest_first_.begin(), largest_first_.end(),
                     [&](std::uint32_t l, std::uint32_t r) { return skins_[l].volume > skins_[r].volume; });
    for (const std::uint32_t unit : largest_first_) boxes_.push_back(skins_[unit].box);
  }

  /// The larger units whose boxes hold that of the i-th, largest first.
  void collectBoxesAround(const TriangleTree& tree, std::uint32_t i) {
    boxes_around_.clear();
    const auto holds = [&](const Eigen::AlignedBox3d& box) { return box.contains(boxes_[i]); };
    visitLeaves(tree, holds, [&](TriangleIndex k) {
      ++work_;
      if (k.value < i && holds(boxes_[k.value])) boxes_around_.push_back(k.value);
      return false;
    });
    std::sort(boxes_around_.begin(), boxes_around_.end());
  }

  const OuterSkin& outerSkin(std::uint32_t unit) {
    if (outer_skins_[unit]) return *outer_skins_[unit];
    std::vector<Eigen::Vector3d> corners;
    std::vector<TriangleNodes> triangles;
    std::vector<int> coefficients;
    for (const std::uint32_t face : skins_[unit].faces) {
      const NodeIndex first{corners.size()};
      triangles.push_back({first, NodeIndex{first.value + 1}, NodeIndex{first.value + 2}});
      for (std::size_t k = 0; k < 3; ++k) corners.push_back(corner(face, k));
      coefficients.push_back(resolved_.decisions[face].coefficient);
    }
    outer_skins_[unit] = std::make_unique<OuterSkin>(
        SurfaceMesh(std::move(corners), std::move(triangles), "skin"), std::move(coefficients));
    return *outer_skins_[unit];
  }

  /// Tests the centres of several triangles, so that two overlapping solids are not taken for a hollow one. A
  /// centre on the other's surface is ignored.
  bool liesInside(const Skin& inner, std::uint32_t outer_unit) {
    const OuterSkin& outer = outerSkin(outer_unit);
    const bool all_alike = !outer.mayMeet(inner.box, work_);
    const std::size_t step =
        all_alike ? inner.faces.size() : std::max<std::size_t>(1, inner.faces.size() / kSamples);
    bool any = false;
    for (std::size_t i = 0; i < inner.faces.size(); i += step) {
      const std::uint32_t face = inner.faces[i];
      const std::optional<int> winding =
          outer.windingNumber((corner(face, 0) + corner(face, 1) + corner(face, 2)) / 3.0, work_);
      if (winding && *winding < 1) return false;
      any = any || winding;
    }
    return any;
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  const ResolvedShells& resolved_;
  std::vector<Skin> skins_;
  std::vector<std::unique_ptr<OuterSkin>> outer_skins_;  ///< of the units that were tested against
  std::vector<std::uint32_t> largest_first_;             ///< the units that have a skin
  std::vector<Eigen::AlignedBox3d> boxes_;               ///< in that order
  std::vector<std::uint32_t> boxes_around_;
  std::uint64_t work_ = 0;
};

}  // namespace

std::vector<bool> findCavities(const std::vector<Eigen::Vector3d>& vertices, const ResolvedShells& resolved) {
  return NestedSkins(vertices, resolved).cavities();
}

}  // namespace concave_distance::detail
