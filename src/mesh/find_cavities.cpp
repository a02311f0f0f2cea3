#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "resolve_shells.h"

namespace concave_distance::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Number of triangles of a unit that are tested against another unit.
constexpr std::size_t kSamples = 16;

/// The boundary of a unit, turned outwards.
struct Skin {
  std::vector<std::uint32_t> faces;
  Eigen::AlignedBox3d box;
  double volume = 0.0;  ///< six times the volume
};

class NestedSkins {
 public:
  NestedSkins(const std::vector<Eigen::Vector3d>& vertices, const ResolvedShells& resolved)
      : vertices_(vertices), resolved_(resolved), skins_(resolved.units.count) {
    for (std::uint32_t face = 0; face < resolved.table.faces.size(); ++face) {
      if (resolved.verdicts[face].coefficient == 0) continue;
      Skin& skin = skins_[resolved.units.unit_of_face[face]];
      skin.faces.push_back(face);
      for (const NodeIndex node : resolved.table.faces[face].nodes) skin.box.extend(vertices[node.value]);
    }
    for (Skin& skin : skins_) {
      if (!skin.faces.empty()) skin.volume = volumeOf(skin);
    }
  }

  std::vector<bool> cavities() const {
    std::vector<std::uint32_t> largest_first(skins_.size());
    std::iota(largest_first.begin(), largest_first.end(), 0U);
    std::stable_sort(largest_first.begin(), largest_first.end(),
                     [&](std::uint32_t l, std::uint32_t r) { return skins_[l].volume > skins_[r].volume; });
    std::vector<Eigen::AlignedBox3d> boxes;  // in one array, because there may be tens of thousands
    for (const std::uint32_t unit : largest_first) boxes.push_back(skins_[unit].box);
    std::vector<bool> is_cavity(skins_.size(), false);
    for (std::size_t i = 0; i < largest_first.size(); ++i) {
      const std::uint32_t unit = largest_first[i];
      int around = 0;
      std::uint32_t outermost = unit;
      for (std::size_t k = 0; k < i; ++k) {
        if (!boxes[k].contains(boxes[i])) continue;
        const std::uint32_t other = largest_first[k];
        if (!liesInside(skins_[unit], skins_[other])) continue;
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
      sum += resolved_.verdicts[face].coefficient *
             (corner(face, 0) - origin).dot(b.cross(corner(face, 2) - origin));
    }
    return sum;
  }

  /// Winding number of a boundary around a point: the sum of its triangles' solid angles over 4 pi.
  double windingNumber(const Skin& skin, const Eigen::Vector3d& point) const {
    double sum = 0.0;
    for (const std::uint32_t face : skin.faces) {
      const Eigen::Vector3d a = corner(face, 0) - point;
      const Eigen::Vector3d b = corner(face, 1) - point;
      const Eigen::Vector3d c = corner(face, 2) - point;
      const double la = a.norm();
      const double lb = b.norm();
      const double lc = c.norm();
      sum += resolved_.verdicts[face].coefficient * 2.0 *
             std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (4.0 * kPi);
  }

  /// Tests the centres of several triangles, so that two overlapping solids are not taken for a hollow one. A
  /// centre on the other's surface (1/2) is ignored.
  bool liesInside(const Skin& inner, const Skin& outer) const {
    if (inner.faces.empty() || outer.faces.empty()) return false;
    const std::size_t step = std::max<std::size_t>(1, inner.faces.size() / kSamples);
    bool any = false;
    for (std::size_t i = 0; i < inner.faces.size(); i += step) {
      const std::uint32_t face = inner.faces[i];
      const double winding =
          windingNumber(outer, (corner(face, 0) + corner(face, 1) + corner(face, 2)) / 3.0);
      if (winding < 0.25) return false;
      any = any || winding > 0.75;
    }
    return any;
  }

  const std::vector<Eigen::Vector3d>& vertices_;
  const ResolvedShells& resolved_;
  std::vector<Skin> skins_;
};

}  // namespace

std::vector<bool> findCavities(const std::vector<Eigen::Vector3d>& vertices, const ResolvedShells& resolved) {
  return NestedSkins(vertices, resolved).cavities();
}

}  // namespace concave_distance::detail
