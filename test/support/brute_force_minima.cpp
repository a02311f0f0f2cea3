#include "support/brute_force_minima.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "mesh/surface/mesh_topology.h"
#include "support/exact_triangle_distance.h"
#include "support/wide_overlap.h"

namespace concave_distance::test {
namespace {

TrianglePoints movedCorners(const SurfaceMesh& mesh, std::size_t t, const Eigen::Isometry3d& pose) {
  TrianglePoints points;
  for (int k = 0; k < 3; ++k) points[static_cast<std::size_t>(k)] = pose * mesh.corner(TriangleIndex{t}, k);
  return points;
}

double longDoubleDistance(const TrianglePoints& a, const TrianglePoints& b) {
  return static_cast<double>(std::sqrt(exactSquaredDistance<long double>(a, b)));
}

using WidePoint = ExactVector<long double>;

/// The corners of the set of closest points of two triangles, on a, up to `tolerance` of the distance.
void appendMinimisers(const TrianglePoints& points_a, const TrianglePoints& points_b, double distance,
                      double tolerance, std::vector<Eigen::Vector3d>& minimisers) {
  const ExactTriangle<long double> a = exactTriangle<long double>(points_a);
  const ExactTriangle<long double> b = exactTriangle<long double>(points_b);
  const auto add = [&](const WidePoint& on_a, const WidePoint& on_b) {
    if (std::sqrt((on_b - on_a).squaredNorm()) > distance + tolerance) return;
    minimisers.emplace_back(static_cast<double>(on_a.x), static_cast<double>(on_a.y),
                            static_cast<double>(on_a.z));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    add(a[i], closestOnTriangle(a[i], b));
    add(closestOnTriangle(b[i], a), b[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      const WidePoint u = a[(i + 1) % 3] - a[i];
      const WidePoint v = b[(j + 1) % 3] - b[j];
      const WidePoint w = b[j] - a[i];
      const long double determinant = u.squaredNorm() * v.squaredNorm() - u.dot(v) * u.dot(v);
      if (!(determinant > 1e-12L * u.squaredNorm() * v.squaredNorm())) continue;
      const long double s = (w.dot(u) * v.squaredNorm() - w.dot(v) * u.dot(v)) / determinant;
      const long double t = (w.dot(u) * u.dot(v) - w.dot(v) * u.squaredNorm()) / determinant;
      if (s >= 0.0L && s <= 1.0L && t >= 0.0L && t <= 1.0L) add(a[i] + u * s, b[j] + v * t);
    }
  }
}

/// The largest distance of two points, and how far one is off the line through those.
void measure(const std::vector<Eigen::Vector3d>& points, double& length, double& width) {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = from;
  for (const Eigen::Vector3d& l : points) {
    for (const Eigen::Vector3d& r : points) {
      if ((r - l).norm() <= length) continue;
      length = (r - l).norm();
      from = l;
      to = r;
    }
  }
  if (!(length > 0.0)) return;
  const Eigen::Vector3d along = (to - from) / length;
  for (const Eigen::Vector3d& p : points) width = std::max(width, along.cross(p - from).norm());
}

/// The corners of what two triangles have in common, up to `tolerance`.
std::vector<Eigen::Vector3d> commonPoints(const TrianglePoints& points_a, const TrianglePoints& points_b,
                                          long double tolerance) {
  const ExactTriangle<long double> a = exactTriangle<long double>(points_a);
  const ExactTriangle<long double> b = exactTriangle<long double>(points_b);
  std::vector<Eigen::Vector3d> common;
  const auto add = [&](const WidePoint& p) {
    const Eigen::Vector3d point(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
    const auto is_here = [&](const Eigen::Vector3d& other) {
      return (other - point).norm() <= static_cast<double>(tolerance);
    };
    if (std::none_of(common.begin(), common.end(), is_here)) common.push_back(point);
  };
  const auto add_if_on = [&](const WidePoint& p, const ExactTriangle<long double>& t) {
    if (std::sqrt((closestOnTriangle(p, t) - p).squaredNorm()) <= tolerance) add(p);
  };
  const auto add_crossings = [&](const ExactTriangle<long double>& edges,
                                 const ExactTriangle<long double>& face) {
    const WidePoint normal = (face[1] - face[0]).cross(face[2] - face[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      add_if_on(edges[k], face);
      const WidePoint edge = edges[(k + 1) % 3] - edges[k];
      const long double rise = normal.dot(edge);
      if (rise == 0.0L) continue;
      const long double share = normal.dot(face[0] - edges[k]) / rise;
      if (share > 0.0L && share < 1.0L) add_if_on(edges[k] + edge * share, face);
    }
  };
  add_crossings(a, b);
  add_crossings(b, a);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const WidePoint u = a[(i + 1) % 3] - a[i];
      const WidePoint v = b[(j + 1) % 3] - b[j];
      const WidePoint n = u.cross(v);
      if (!(n.squaredNorm() > 1e-20L * u.squaredNorm() * v.squaredNorm())) continue;
      const long double s = (b[j] - a[i]).cross(v).dot(n) / n.squaredNorm();
      const long double t = (b[j] - a[i]).cross(u).dot(n) / n.squaredNorm();
      if (s < 0.0L || s > 1.0L || t < 0.0L || t > 1.0L) continue;
      const WidePoint on_a = a[i] + u * s;
      if (std::sqrt((b[j] + v * t - on_a).squaredNorm()) <= tolerance) add(on_a);
    }
  }
  return common;
}

/// Two triangles and a part of what they have in common.
struct Neighbours {
  std::uint32_t l;
  std::uint32_t r;
  TrianglePoints shared;
};

/// All triangles that have an edge or a vertex in common or touch, by comparing every two. What is nearer
/// than 1e-9 of the diameter touches.
std::vector<Neighbours> neighbourPairs(const SurfaceMesh& mesh, const Eigen::Isometry3d& pose) {
  std::vector<Neighbours> pairs;
  const Eigen::Isometry3d stay = Eigen::Isometry3d::Identity();
  for (std::uint32_t l = 0; l < mesh.triangleCount(); ++l) {
    for (std::uint32_t r = 0; r < l; ++r) {
      std::vector<Eigen::Vector3d> shared =
          commonPoints(movedCorners(mesh, l, stay), movedCorners(mesh, r, stay), 1e-9L * mesh.diameter());
      for (const NodeIndex node : mesh.triangles()[l]) {
        const TriangleNodes& other = mesh.triangles()[r];
        if (std::find(other.begin(), other.end(), node) == other.end()) continue;
        shared.push_back(mesh.vertex(node));
      }
      for (Eigen::Vector3d& point : shared) point = pose * point;
      // Every point of a convex polygon lies in a triangle of three of its corners.
      for (std::size_t i = 0; i < shared.size(); ++i) {
        for (std::size_t j = i; j < shared.size(); ++j) {
          for (std::size_t k = j; k < shared.size(); ++k) {
            if (shared.size() > 2 && (i == j || j == k)) continue;
            pairs.push_back({l, r, {shared[i], shared[j], shared[k]}});
          }
        }
      }
    }
  }
  return pairs;
}

WideSurface wideSurface(const BodyMesh& body, const std::vector<TrianglePoints>& corners) {
  WideSurface surface;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    surface.triangles.push_back(exactTriangle<long double>(corners[t]));
    surface.is_closed.push_back(body.topology().isOnClosedShell(TriangleIndex{t}));
  }
  return surface;
}

}  // namespace

std::vector<BruteForceMinimum> bruteForceMinima(const BodyMesh& a, const BodyMesh& b,
                                                const Eigen::Isometry3d& a_from_b, double cutoff,
                                                double least_prominence, double rounding, double plateau,
                                                double margin) {
  const double top =
      margin + (1.0 + least_prominence) * std::max(0.0, cutoff - margin) + std::max(rounding, plateau);
  const Eigen::Isometry3d stay = Eigen::Isometry3d::Identity();
  const std::size_t count_b = b.surface().triangleCount();
  std::vector<TrianglePoints> corners_a;
  std::vector<TrianglePoints> corners_b;
  for (std::size_t t = 0; t < a.surface().triangleCount(); ++t) {
    corners_a.push_back(movedCorners(a.surface(), t, stay));
  }
  for (std::size_t t = 0; t < count_b; ++t) {
    corners_b.push_back(movedCorners(b.surface(), t, a_from_b));
  }

  std::vector<double> distance(corners_a.size() * count_b);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    distance[i] = longDoubleDistance(corners_a[i / count_b], corners_b[i % count_b]);
    if (distance[i] <= top) order.push_back(i);
  }
  const auto deeper = [&](std::size_t l, std::size_t r) {
    return distance[l] != distance[r] ? distance[l] < distance[r] : l < r;
  };

  struct Pass {
    double level;
    std::size_t l;
    std::size_t r;
  };
  std::vector<Pass> passes;
  const auto join = [&](std::size_t l, std::size_t r, const TrianglePoints& shared,
                        const TrianglePoints& other) {
    if (distance[l] > top || distance[r] > top) return;
    const double level = longDoubleDistance(shared, other);
    if (level <= top) passes.push_back({std::max({level, distance[l], distance[r]}), l, r});
  };
  for (const auto& pair : neighbourPairs(a.surface(), stay)) {
    for (std::size_t t = 0; t < count_b; ++t) {
      join(pair.l * count_b + t, pair.r * count_b + t, pair.shared, corners_b[t]);
    }
  }
  for (const auto& pair : neighbourPairs(b.surface(), a_from_b)) {
    for (std::size_t t = 0; t < corners_a.size(); ++t) {
      join(t * count_b + pair.l, t * count_b + pair.r, pair.shared, corners_a[t]);
    }
  }
  const std::vector<int> parts =
      overlapPartsOfPairs(wideSurface(a, corners_a), wideSurface(b, corners_b), rounding);
  std::map<int, std::size_t> first_of_part;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i] < 0) continue;
    const std::size_t first = first_of_part.emplace(parts[i], i).first->second;
    passes.push_back({std::max(distance[first], distance[i]), first, i});
  }
  std::sort(passes.begin(), passes.end(), [](const Pass& l, const Pass& r) { return l.level < r.level; });

  std::vector<std::size_t> parent(distance.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) {
      parent[i] = parent[parent[i]];
      i = parent[i];
    }
    return i;
  };
  std::vector<BruteForceMinimum> minima;
  const auto report = [&](std::size_t i, double pass) {
    if (distance[i] > cutoff || pass <= std::max(distance[i], margin) + rounding) return;
    const double padded = distance[i] - margin;
    const double prominence =
        padded > rounding ? (pass - margin) / padded - 1.0 : std::numeric_limits<double>::infinity();
    if (prominence < least_prominence) return;
    minima.push_back({distance[i], prominence, static_cast<std::uint32_t>(i / count_b),
                      static_cast<std::uint32_t>(i % count_b), 0.0, 0.0});
  };
  for (const Pass& pass : passes) {
    const std::size_t l = root(pass.l);
    const std::size_t r = root(pass.r);
    if (l == r) continue;
    const std::size_t shallow = deeper(l, r) ? r : l;
    parent[shallow] = shallow == l ? r : l;
    report(shallow, pass.level);
  }
  for (const std::size_t i : order) {
    if (root(i) == i) report(i, std::numeric_limits<double>::infinity());
  }
  std::sort(minima.begin(), minima.end(),
            [](const BruteForceMinimum& l, const BruteForceMinimum& r) { return l.distance < r.distance; });

  for (BruteForceMinimum& minimum : minima) {
    // The set of minimisers: every triangle pair that is reached without rising above the tolerance.
    const double level = minimum.distance + plateau;
    std::vector<bool> on_plateau(distance.size(), false);
    on_plateau[minimum.triangle_a * count_b + minimum.triangle_b] = true;
    for (bool grows = true; grows;) {
      grows = false;
      for (const Pass& pass : passes) {
        if (pass.level > level) break;
        if (on_plateau[pass.l] == on_plateau[pass.r]) continue;
        on_plateau[pass.l] = on_plateau[pass.r] = true;
        grows = true;
      }
    }
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < on_plateau.size(); ++i) {
      if (!on_plateau[i]) continue;
      appendMinimisers(corners_a[i / count_b], corners_b[i % count_b], minimum.distance, plateau, points);
    }
    measure(points, minimum.length, minimum.width);
  }
  return minima;
}

}  // namespace concave_distance::test
