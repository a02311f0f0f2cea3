#include "orient_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "edge_table.h"

namespace concave_distance::detail {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Triangles joined by edges of two triangles.
struct Patch {
  std::vector<std::uint32_t> triangles;
  Eigen::AlignedBox3d box;
  bool closed = true;
};

/// Floods winding over the edges of two triangles; returns the patches.
std::vector<Patch> floodWinding(const EdgeTable& edges, const std::vector<TriangleNodes>& triangles,
                                std::vector<bool>& turned) {
  std::vector<Patch> patches;
  std::vector<bool> visited(triangles.size(), false);
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (visited[seed]) {
      continue;
    }
    Patch patch;
    patch.triangles.push_back(seed);
    visited[seed] = true;
    for (std::size_t next = 0; next < patch.triangles.size(); ++next) {
      const std::uint32_t t = patch.triangles[next];
      // In the order of the triangles, not of the corners, which turning changes: what cannot be oriented is
      // then left alone when it comes again.
      std::array<std::pair<std::uint32_t, bool>, 3> neighbours;  // triangle, whether it runs the same way
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfEdge h = 3 * t + k;
        const std::uint32_t edge = edges.edge_of_half_edge[h];
        neighbours[k] = {t, false};
        if (edges.first[edge + 1] - edges.first[edge] == 2) {
          const HalfEdge first = edges.half_edges[edges.first[edge]];
          const HalfEdge other = first == h ? edges.half_edges[edges.first[edge] + 1] : first;
          neighbours[k] = {other / 3, startOf(triangles, h) == startOf(triangles, other)};
        }
      }
      std::sort(neighbours.begin(), neighbours.end());
      for (const auto& [neighbour, same_direction] : neighbours) {
        if (!visited[neighbour]) {
          visited[neighbour] = true;
          turned[neighbour] = turned[t] != same_direction;
          patch.triangles.push_back(neighbour);
        }
      }
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

/// A patch is closed when along every edge its triangles run as often one way as the other.
void findClosedPatches(const EdgeTable& edges, const std::vector<TriangleNodes>& triangles,
                       const std::vector<bool>& turned, std::vector<Patch>& patches) {
  std::vector<std::uint32_t> patch_of_triangle(triangles.size());
  for (std::uint32_t p = 0; p < patches.size(); ++p) {
    for (const std::uint32_t t : patches[p].triangles) {
      patch_of_triangle[t] = p;
    }
  }
  std::vector<std::pair<std::uint32_t, int>> directions;  // of one edge: patch, 1 or -1
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const NodeIndex start = startOf(triangles, edges.half_edges[edges.first[e]]);
    directions.clear();
    for (std::uint32_t i = edges.first[e]; i < edges.first[e + 1]; ++i) {
      const HalfEdge h = edges.half_edges[i];
      const bool from_start = (startOf(triangles, h) == start) != turned[h / 3];
      directions.emplace_back(patch_of_triangle[h / 3], from_start ? 1 : -1);
    }
    std::sort(directions.begin(), directions.end());
    for (std::size_t i = 0; i < directions.size();) {
      const std::uint32_t patch = directions[i].first;
      int balance = 0;
      for (; i < directions.size() && directions[i].first == patch; ++i) {
        balance += directions[i].second;
      }
      patches[patch].closed = patches[patch].closed && balance == 0;
    }
  }
}

/// The triangles as they came, and those of them that are to be turned.
struct Surface {
  const std::vector<Eigen::Vector3d>& vertices;
  const std::vector<TriangleNodes>& triangles;
  const std::vector<bool>& turned;

  const Eigen::Vector3d& corner(std::uint32_t triangle, std::size_t k) const {
    return vertices[triangles[triangle][k].value];
  }
  double sign(std::uint32_t triangle) const { return turned[triangle] ? -1.0 : 1.0; }
};

/// Six times the volume that a closed patch encloses, positive when its triangles face outwards.
double signedVolume(const Surface& surface, const Patch& patch) {
  const Eigen::Vector3d origin = patch.box.center();
  double sum = 0.0;
  for (const std::uint32_t t : patch.triangles) {
    const Eigen::Vector3d a = surface.corner(t, 0) - origin;
    const Eigen::Vector3d b = surface.corner(t, 1) - origin;
    const Eigen::Vector3d c = surface.corner(t, 2) - origin;
    sum += surface.sign(t) * a.dot(b.cross(c));
  }
  return sum;
}

/// How often a closed patch winds around a point: the sum of its triangles' solid angles over 4 pi.
double windingNumber(const Surface& surface, const Patch& patch, const Eigen::Vector3d& point) {
  double sum = 0.0;
  for (const std::uint32_t t : patch.triangles) {
    const Eigen::Vector3d a = surface.corner(t, 0) - point;
    const Eigen::Vector3d b = surface.corner(t, 1) - point;
    const Eigen::Vector3d c = surface.corner(t, 2) - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double solid_angle =
        2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    sum += surface.sign(t) * solid_angle;
  }
  return sum / (4.0 * kPi);
}

/// Whether all of `inner` lies inside `outer`: several of its triangles' middles are asked, so that two
/// solids that merely overlap are not taken for a hollow one.
bool liesInside(const Surface& surface, const Patch& inner, const Patch& outer) {
  if (!outer.box.contains(inner.box)) {
    return false;
  }
  constexpr std::size_t kSamples = 16;
  const std::size_t step = std::max<std::size_t>(1, inner.triangles.size() / kSamples);
  for (std::size_t i = 0; i < inner.triangles.size(); i += step) {
    const std::uint32_t t = inner.triangles[i];
    const Eigen::Vector3d middle = (surface.corner(t, 0) + surface.corner(t, 1) + surface.corner(t, 2)) / 3.0;
    if (std::abs(windingNumber(surface, outer, middle)) < 0.75) {
      return false;  // 0 outside, 1/2 on the surface, 1 inside
    }
  }
  return true;
}

}  // namespace

std::size_t orientTriangles(const std::vector<Eigen::Vector3d>& vertices,
                            std::vector<TriangleNodes>& triangles) {
  const EdgeTable edges = buildEdgeTable(triangles);
  std::vector<bool> turned(triangles.size(), false);
  std::vector<Patch> patches = floodWinding(edges, triangles, turned);
  for (Patch& patch : patches) {
    for (const std::uint32_t t : patch.triangles) {
      for (const NodeIndex node : triangles[t]) {
        patch.box.extend(vertices[node.value]);
      }
    }
  }
  findClosedPatches(edges, triangles, turned, patches);
  const Surface surface{vertices, triangles, turned};
  for (const Patch& patch : patches) {
    bool turn_all = false;
    if (patch.closed) {
      std::size_t around = 0;
      for (const Patch& other : patches) {
        around += &other != &patch && other.closed && liesInside(surface, patch, other) ? 1U : 0U;
      }
      const double volume = signedVolume(surface, patch);
      turn_all = around % 2 == 0 ? volume < 0.0 : volume > 0.0;
    } else {
      const auto turned_count = static_cast<std::size_t>(
          std::count_if(patch.triangles.begin(), patch.triangles.end(), [&](auto t) { return turned[t]; }));
      turn_all = 2 * turned_count > patch.triangles.size();
    }
    for (const std::uint32_t t : patch.triangles) {
      turned[t] = turned[t] != turn_all;
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (turned[t]) {
      std::swap(triangles[t][1], triangles[t][2]);
    }
  }
  return static_cast<std::size_t>(std::count(turned.begin(), turned.end(), true));
}

}  // namespace concave_distance::detail
