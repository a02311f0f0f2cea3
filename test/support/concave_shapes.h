#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "support/plain_shapes.h"

/// Small concave bodies for tests: extruded outlines, closed, outward oriented, only the outline's own
/// vertices. Metres.
namespace concave_distance::test {

using Outline = std::vector<Eigen::Vector2d>;  ///< simple polygon, counter-clockwise

namespace parts {

inline double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Ear clipping; a vertex on an ear's border (but not a corner of it) blocks the ear.
inline std::vector<std::array<std::uint32_t, 3>> triangulate(const Outline& outline) {
  std::vector<std::uint32_t> left(outline.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) {
    left[i] = i;
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (left.size() > 3) {
    bool clipped = false;
    for (std::size_t k = 0; k < left.size() && !clipped; ++k) {
      const std::uint32_t a = left[(k + left.size() - 1) % left.size()];
      const std::uint32_t b = left[k];
      const std::uint32_t c = left[(k + 1) % left.size()];
      if (turn(outline[a], outline[b], outline[c]) <= 0.0) {
        continue;
      }
      const bool blocked = std::any_of(left.begin(), left.end(), [&](std::uint32_t p) {
        return p != a && p != b && p != c && turn(outline[a], outline[b], outline[p]) >= 0.0 &&
               turn(outline[b], outline[c], outline[p]) >= 0.0 &&
               turn(outline[c], outline[a], outline[p]) >= 0.0;
      });
      if (!blocked) {
        triangles.push_back({a, b, c});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
        clipped = true;
      }
    }
    if (!clipped) {
      break;  // not simple, or clockwise: the caller's test sees an open mesh
    }
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

}  // namespace parts

/// The prism over `outline` between z = -height / 2 and z = +height / 2.
inline SurfaceMesh makeExtrusion(const Outline& outline, double height) {
  std::vector<Eigen::Vector3d> vertices;
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const Eigen::Vector2d& p : outline) {
      vertices.emplace_back(p.x(), p.y(), z);
    }
  }
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<TriangleNodes> triangles;
  for (const auto& t : parts::triangulate(outline)) {
    triangles.push_back({NodeIndex{t[2]}, NodeIndex{t[1]}, NodeIndex{t[0]}});
    triangles.push_back({NodeIndex{t[0] + n}, NodeIndex{t[1] + n}, NodeIndex{t[2] + n}});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    triangles.push_back({NodeIndex{i}, NodeIndex{j}, NodeIndex{j + n}});
    triangles.push_back({NodeIndex{i}, NodeIndex{j + n}, NodeIndex{i + n}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "extrusion");
}

/// A back bar from y = -back to 0 with `teeth` teeth up to y = length, `width` wide and `gap` apart, from
/// x = 0 on.
inline SurfaceMesh makeComb(int teeth, double width = 0.1, double gap = 0.15, double length = 0.4,
                            double back = 0.1, double height = 0.2) {
  Outline outline{{0.0, -back}};
  const double end = teeth * width + (teeth - 1) * gap;
  outline.emplace_back(end, -back);
  for (int i = teeth - 1; i >= 0; --i) {
    const double x = i * (width + gap);
    if (i < teeth - 1) {
      outline.emplace_back(x + width, 0.0);
    }
    outline.emplace_back(x + width, length);
    outline.emplace_back(x, length);
    if (i > 0) {
      outline.emplace_back(x, 0.0);
    }
  }
  return makeExtrusion(outline, height);
}

/// Stairs that rise along x: step i is `run` deep and ends at y = (i + 1) * rise.
inline SurfaceMesh makeStairs(int steps, double run = 0.2, double rise = 0.15, double height = 0.6) {
  Outline outline{{0.0, 0.0}, {steps * run, 0.0}};
  for (int i = steps - 1; i >= 0; --i) {
    outline.emplace_back((i + 1) * run, (i + 1) * rise);
    outline.emplace_back(i * run, (i + 1) * rise);
  }
  return makeExtrusion(outline, height);
}

/// Two arms of `arm` length and `thickness`, the inner corner at (thickness, thickness).
inline SurfaceMesh makeLShape(double arm = 0.6, double thickness = 0.15, double height = 0.2) {
  return makeExtrusion(
      {{0.0, 0.0}, {arm, 0.0}, {arm, thickness}, {thickness, thickness}, {thickness, arm}, {0.0, arm}},
      height);
}

/// A J: a shank up to y = shank, a bow of `opening` inner width at the bottom, a tip up to y = tip.
inline SurfaceMesh makeHook(double shank = 0.8, double tip = 0.35, double opening = 0.25,
                            double thickness = 0.1, double height = 0.1) {
  const double right = 2.0 * thickness + opening;
  return makeExtrusion({{0.0, 0.0},
                        {right, 0.0},
                        {right, tip},
                        {thickness + opening, tip},
                        {thickness + opening, thickness},
                        {thickness, thickness},
                        {thickness, shank},
                        {0.0, shank}},
                       height);
}

/// An open sheet of nx x ny squares of side `cell` in the plane z = 0, each cut along one diagonal; with
/// `wave` a height field z = wave * sin(3 x) * cos(2 y).
inline SurfaceMesh makeSheet(std::uint32_t nx, std::uint32_t ny, double cell = 0.1, double wave = 0.0) {
  std::vector<Eigen::Vector3d> vertices;
  for (std::uint32_t j = 0; j <= ny; ++j) {
    for (std::uint32_t i = 0; i <= nx; ++i) {
      const double x = i * cell;
      const double y = j * cell;
      vertices.emplace_back(x, y, wave * std::sin(3.0 * x) * std::cos(2.0 * y));
    }
  }
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t j = 0; j < ny; ++j) {
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t a = j * (nx + 1) + i;
      const std::uint32_t c = a + nx + 2;
      triangles.push_back({NodeIndex{a}, NodeIndex{a + 1}, NodeIndex{c}});
      triangles.push_back({NodeIndex{a}, NodeIndex{c}, NodeIndex{a + nx + 1}});
    }
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "sheet");
}

/// A closed ring: `around` quadrilaterals along it, `across` around its tube, the corner (i, j) where
/// `point(i, j)` says. Outward oriented when i runs about z and j from the outside to the top.
template <typename Point>
SurfaceMesh makeRingThrough(std::uint32_t around, std::uint32_t across, const Point& point) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      vertices.push_back(point(i, j));
      const NodeIndex a{i * across + j};
      const NodeIndex b{(i + 1) % around * across + j};
      const NodeIndex c{(i + 1) % around * across + (j + 1) % across};
      const NodeIndex d{i * across + (j + 1) % across};
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "ring");
}

/// A round plate around z with a hole, both bodies' edges at `around` corners, metres.
inline SurfaceMesh makePlateWithHole(double radius, double hole, double thickness, std::uint32_t around) {
  return makeRingThrough(around, 4, [&](std::uint32_t i, std::uint32_t j) {
    const double angle = 2.0 * M_PI * i / around;
    const double r = j == 1 || j == 2 ? radius : hole;
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), (j < 2 ? -0.5 : 0.5) * thickness);
  });
}

/// A ring around z whose tube has the radius `tube(along, over)`, angles in radians.
template <typename Tube>
SurfaceMesh makeRingOfTube(double radius, std::uint32_t around, std::uint32_t across, const Tube& tube) {
  return makeRingThrough(around, across, [&](std::uint32_t i, std::uint32_t j) {
    const double along = 2.0 * M_PI * i / around;
    const double over = 2.0 * M_PI * j / across;
    const double thickness = tube(along, over);
    const double r = radius + thickness * std::cos(over);
    return Eigen::Vector3d(r * std::cos(along), r * std::sin(along), thickness * std::sin(over));
  });
}

inline SurfaceMesh makeRing(double radius, double tube, std::uint32_t around, std::uint32_t across) {
  return makeRingOfTube(radius, around, across, [&](double, double) { return tube; });
}

/// A surface with its vertices drawn in and out along their direction, by `depth` of it: bumps all around.
inline SurfaceMesh makeBumpy(const SurfaceMesh& surface, double depth = 0.1) {
  std::vector<Eigen::Vector3d> vertices = surface.vertices();
  for (Eigen::Vector3d& v : vertices) {
    const Eigen::Vector3d d = v.normalized();
    v *= 1.0 + depth * std::sin(9.0 * d.x()) * std::cos(8.0 * d.y() + 1.0) * std::sin(7.0 * d.z() + 2.0);
  }
  return SurfaceMesh(std::move(vertices), surface.triangles(), "bumpy");
}

}  // namespace concave_distance::test
