#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance::test {

/// Any triangles over few vertices: borders, edges of many triangles, slivers and shells all occur.
inline rc::Gen<SurfaceMesh> anySurface() {
  return rc::gen::exec([] {
    const auto vertex_count = *rc::gen::inRange<std::uint32_t>(4, 12);
    std::vector<Eigen::Vector3d> vertices;
    for (std::uint32_t i = 0; i < vertex_count; ++i) {
      const auto coordinate = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
      const double x = coordinate();
      const double y = coordinate();
      vertices.emplace_back(x, y, coordinate());
    }
    TriangleSoup soup{vertices, {}};
    const auto triangle_count = *rc::gen::inRange(1, 20);
    for (int i = 0; i < triangle_count; ++i) {
      const auto corner = [&] { return *rc::gen::inRange<std::uint32_t>(0, vertex_count); };
      const std::uint32_t a = corner();
      const std::uint32_t b = corner();
      soup.triangles.push_back({a, b, corner()});
    }
    soup.triangles.push_back({0, 1, 2});
    soup.vertices[0] = {0.0, 0.0, 0.0};  // at least one with an area
    soup.vertices[1] = {1.0, 0.0, 0.0};
    soup.vertices[2] = {0.0, 1.0, 0.0};
    return repairMesh(soup, {}, "generated surface").mesh;
  });
}

}  // namespace concave_distance::test
