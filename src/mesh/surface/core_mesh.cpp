#include "core_mesh.h"

#include <cmath>
#include <utility>
#include <vector>

namespace concave_distance::detail {
namespace {

/// The thickness is this share of the radius. Normals are good to rounding: the core lies on its frame's
/// axes.
constexpr double kThickness = 0x1.0p-27;

}  // namespace

CoreMesh coreMesh(const RoundShape& shape, const std::string& where) {
  const double thickness = kThickness * shape.radius;
  const auto corner = [](int x) { return NodeIndex{static_cast<std::uint32_t>(x)}; };
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  if (shape.half_length > 0.0) {
    // A prism around the axis.
    for (const double z : {-shape.half_length, shape.half_length}) {
      for (const auto& [x, y] : {std::pair{-0.5, -0.5}, std::pair{0.75, 0.0}, std::pair{-0.5, 0.5}}) {
        vertices.emplace_back(thickness * x, thickness * y, z);
      }
    }
    triangles = {{corner(0), corner(2), corner(1)}, {corner(3), corner(4), corner(5)}};
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      triangles.push_back({corner(k), corner(next), corner(next + 3)});
      triangles.push_back({corner(k), corner(next + 3), corner(k + 3)});
    }
  } else {
    const double side = 0.5 * thickness;
    vertices = {{side, side, side}, {side, -side, -side}, {-side, side, -side}, {-side, -side, side}};
    triangles = {{corner(0), corner(1), corner(2)},
                 {corner(0), corner(3), corner(1)},
                 {corner(0), corner(2), corner(3)},
                 {corner(1), corner(3), corner(2)}};
  }
  return {SurfaceMesh(std::move(vertices), std::move(triangles), where), thickness};
}

}  // namespace concave_distance::detail
