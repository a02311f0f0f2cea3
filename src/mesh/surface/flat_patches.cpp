#include "flat_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace concave_distance::detail {
namespace {

constexpr std::uint32_t kNoPatch = 0xffffffffU;

/// A patch flatter than this, height over length, is seen stretched to it: a triangulation of angles that
/// rounding decides would be left as it is, however long its edges.
constexpr double kFlattest = 1e-5;

Eigen::Vector3d areaVector(const SurfaceMesh& surface, std::uint32_t triangle) {
  const TriangleIndex t{triangle};
  const Eigen::Vector3d& a = surface.corner(t, 0);
  return 0.5 * (surface.corner(t, 1) - a).cross(surface.corner(t, 2) - a);
}

/// The triangle across an edge that a patch may grow over, or the triangle itself.
std::uint32_t acrossEdge(const SurfaceMesh& surface, const EdgeTable& edges, HalfEdge h) {
  const std::uint32_t edge = edges.edge_of_half_edge[h];
  if (edges.first[edge + 1] - edges.first[edge] != 2) {
    return h / 3;
  }
  const HalfEdge first = edges.half_edges[edges.first[edge]];
  const HalfEdge other = first == h ? edges.half_edges[edges.first[edge] + 1] : first;
  return startOf(surface.triangles(), h) == startOf(surface.triangles(), other) ? h / 3 : other / 3;
}

/// Decides what lies close to a plane and faces its way.
struct Slab {
  Eigen::Vector3d normal;
  Eigen::Vector3d on_plane;
  double flatness;      ///< metres, to either side
  double least_height;  ///< of a triangle

  bool holds(const SurfaceMesh& surface, std::uint32_t t) const {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& corner = surface.corner(TriangleIndex{t}, k);
      longest = std::max(longest, (surface.corner(TriangleIndex{t}, (k + 1) % 3) - corner).norm());
      if (std::abs(normal.dot(corner - on_plane)) > flatness) {
        return false;
      }
    }
    return normal.dot(areaVector(surface, t)) > 0.5 * least_height * longest;
  }
};

/// A height below this is lost in the rounding of plane coordinates: which way the triangle faces is unknown.
double leastHeightOf(const SurfaceMesh& surface) {
  return 1e3 * std::numeric_limits<double>::epsilon() * surface.diameter();
}

/// Takes the direction of the longest edge on the patch's border.
PatchFrame frameOf(const SurfaceMesh& surface, const EdgeTable& edges,
                   const std::vector<std::uint32_t>& patch_of_triangle,
                   const std::vector<std::uint32_t>& triangles, const Eigen::Vector3d& normal) {
  PatchFrame frame;
  double longest = -1.0;
  for (const std::uint32_t t : triangles) {
    for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t other = acrossEdge(surface, edges, h);
      if (other != t && patch_of_triangle[other] == patch_of_triangle[t]) {
        continue;
      }
      const Eigen::Vector3d& start = surface.vertex(startOf(surface.triangles(), h));
      const Eigen::Vector3d along = surface.vertex(endOf(surface.triangles(), h)) - start;
      if (along.squaredNorm() > longest) {
        longest = along.squaredNorm();
        frame.origin = start;
        frame.first_axis = along;
      }
    }
  }
  if (longest < 0.0) {  // without a border: closed and flat, of no use to anybody but possible
    frame.origin = surface.corner(TriangleIndex{triangles.front()}, 0);
    frame.first_axis = surface.corner(TriangleIndex{triangles.front()}, 1) - frame.origin;
  }
  frame.first_axis = (frame.first_axis - normal.dot(frame.first_axis) * normal).normalized();
  if (frame.first_axis.isZero(0.0)) {  // all corners in one place
    frame.first_axis = Eigen::Vector3d::UnitX();
  }
  frame.second_axis = normal.cross(frame.first_axis);
  if (frame.second_axis.isZero(0.0)) {  // no area, no normal: any plane through the line will do
    frame.second_axis = frame.first_axis.unitOrthogonal();
  }
  Eigen::AlignedBox2d box;
  for (const std::uint32_t t : triangles) {
    for (int k = 0; k < 3; ++k) {
      box.extend(frame.project(surface.corner(TriangleIndex{t}, k)));
    }
  }
  const double least_height = kFlattest * box.sizes().x();
  if (box.sizes().y() > 0.0 && box.sizes().y() < least_height) {
    frame.second_axis *= least_height / box.sizes().y();
  }
  return frame;
}

}  // namespace

FlatPatches findFlatPatches(const SurfaceMesh& surface, const EdgeTable& edges, double flatness) {
  const std::size_t triangle_count = surface.triangleCount();
  std::vector<double> area(triangle_count);
  std::vector<std::uint32_t> by_area(triangle_count);
  std::iota(by_area.begin(), by_area.end(), 0U);
  for (const std::uint32_t t : by_area) {
    area[t] = areaVector(surface, t).norm();
  }
  std::stable_sort(by_area.begin(), by_area.end(), [&](auto l, auto r) { return area[l] > area[r]; });

  FlatPatches patches;
  patches.patch_of_triangle.assign(triangle_count, kNoPatch);
  const double least_height = leastHeightOf(surface);
  for (const std::uint32_t seed : by_area) {
    if (patches.patch_of_triangle[seed] != kNoPatch) {
      continue;
    }
    const auto patch = static_cast<std::uint32_t>(patches.frames.size());
    const Eigen::Vector3d normal = areaVector(surface, seed).stableNormalized();
    const Slab slab{normal, surface.corner(TriangleIndex{seed}, 0), flatness, least_height};
    std::vector<std::uint32_t> members{seed};
    patches.patch_of_triangle[seed] = patch;
    for (std::size_t next = 0; next < members.size(); ++next) {
      for (HalfEdge h = 3 * members[next]; h < 3 * members[next] + 3; ++h) {
        const std::uint32_t other = acrossEdge(surface, edges, h);
        if (patches.patch_of_triangle[other] == kNoPatch && slab.holds(surface, other)) {
          patches.patch_of_triangle[other] = patch;
          members.push_back(other);
        }
      }
    }
    patches.frames.push_back(frameOf(surface, edges, patches.patch_of_triangle, members, normal));
    patches.triangles_of_patch.push_back(std::move(members));
  }
  return patches;
}

FlatPatches joinFlatPatches(const SurfaceMesh& surface, const EdgeTable& edges, const FlatPatches& patches,
                            double flatness) {
  FlatPatches joined;
  joined.patch_of_triangle.assign(surface.triangleCount(), kNoPatch);
  // Patches come in the order of their first triangles' areas.
  for (const std::vector<std::uint32_t>& first : patches.triangles_of_patch) {
    if (joined.patch_of_triangle[first.front()] != kNoPatch) {
      continue;
    }
    const auto patch = static_cast<std::uint32_t>(joined.frames.size());
    const Eigen::Vector3d normal = areaVector(surface, first.front()).stableNormalized();
    const Slab slab{normal, surface.corner(TriangleIndex{first.front()}, 0), flatness,
                    leastHeightOf(surface)};
    std::vector<std::uint32_t> members;
    const auto take = [&](const std::vector<std::uint32_t>& triangles) {
      for (const std::uint32_t t : triangles) joined.patch_of_triangle[t] = patch;
      members.insert(members.end(), triangles.begin(), triangles.end());
    };
    take(first);
    for (std::size_t next = 0; next < members.size(); ++next) {
      for (HalfEdge h = 3 * members[next]; h < 3 * members[next] + 3; ++h) {
        const std::uint32_t other = acrossEdge(surface, edges, h);
        const auto& candidate = patches.triangles_of_patch[patches.patch_of_triangle[other]];
        if (joined.patch_of_triangle[other] == kNoPatch &&
            std::all_of(candidate.begin(), candidate.end(), [&](auto t) { return slab.holds(surface, t); })) {
          take(candidate);
        }
      }
    }
    joined.frames.push_back(frameOf(surface, edges, joined.patch_of_triangle, members, normal));
    joined.triangles_of_patch.push_back(std::move(members));
  }
  return joined;
}

}  // namespace concave_distance::detail
