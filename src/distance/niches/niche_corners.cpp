#include "niche_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "distance/kernels/pair_frame.h"

namespace concave_distance {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Points that are one in the plane may have been rounded differently, by this share of the bodies.
constexpr double kSamePlace = 1e-9;

double crossed(const Vector2d& l, const Vector2d& r) {
  return l.x() * r.y() - l.y() * r.x();
}

/// Takes out corners on the line of their neighbours within `same` (metres), and then those that cut off the
/// least area until few are left.
void keepLargest(std::vector<Vector2d>& hull, double same) {
  while (hull.size() > 2) {
    std::size_t least = 0;
    double least_area = std::numeric_limits<double>::infinity();
    bool is_on_line = false;
    for (std::size_t i = 0; i < hull.size() && !is_on_line; ++i) {
      const Vector2d& before = hull[(i + hull.size() - 1) % hull.size()];
      const Vector2d& after = hull[(i + 1) % hull.size()];
      const double area = std::abs(crossed(hull[i] - before, after - before));
      const bool is_between = (hull[i] - before).dot(after - hull[i]) > 0.0;
      is_on_line = is_between && area <= same * (after - before).norm();
      if (area >= least_area && !is_on_line) continue;
      least_area = area;
      least = i;
    }
    if (!is_on_line && hull.size() <= kMostCorners) return;
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

/// The closest points of two edges; false when they are parallel.
bool closestOfEdges(const Vector3d& a0, const Vector3d& a1, const Vector3d& b0, const Vector3d& b1,
                    Vector3d& on_a, Vector3d& on_b) {
  const Vector3d along_a = a1 - a0;
  const Vector3d along_b = b1 - b0;
  const Vector3d across = along_a.cross(along_b);
  const double squared = across.squaredNorm();
  if (!(squared > kSamePlace * along_a.squaredNorm() * along_b.squaredNorm())) return false;
  const Vector3d between = b0 - a0;
  on_a = a0 + std::clamp(between.cross(along_b).dot(across) / squared, 0.0, 1.0) * along_a;
  on_b = b0 + std::clamp(between.cross(along_a).dot(across) / squared, 0.0, 1.0) * along_b;
  return true;
}

/// Returns whether the vertices of a body that are level with a point of it, and hang together from there on,
/// reach as far as `length` from it (metres). No set of level points is longer than twice the farthest of
/// either body. A few microseconds, where measureExtent() looks at each pair of small triangles.
/// @param outwards unit vector @param looks vertices to look at; with more the answer is true
bool reachesOut(const BodyMesh& body, TriangleIndex triangle, const Vector3d& point, const Vector3d& outwards,
                double tolerance, double length, std::size_t looks, CornerWorkspace& workspace) {
  const SurfaceMesh& surface = body.surface();
  std::vector<NodeIndex>& level = workspace.level;
  if (workspace.is_level.size() < surface.vertexCount())
    workspace.is_level.resize(surface.vertexCount(), false);
  level.clear();
  const auto add = [&](TriangleIndex of) {
    for (const NodeIndex node : surface.triangle(of)) {
      if (workspace.is_level[node.value]) continue;
      if (!(std::abs(outwards.dot(surface.vertex(node) - point)) <= tolerance)) continue;
      workspace.is_level[node.value] = true;
      level.push_back(node);
    }
  };
  add(triangle);
  bool reaches = false;
  for (std::size_t i = 0; i < level.size() && !reaches; ++i) {
    reaches = i >= looks || (surface.vertex(level[i]) - point).squaredNorm() >= length * length;
    if (reaches) break;
    for (const TriangleIndex other : body.topology().triangles_of_vertex.row(level[i].value)) add(other);
  }
  for (const NodeIndex node : level) workspace.is_level[node.value] = false;
  return reaches;
}

/// Looks for the closest pair of points at one place of the plane.
class PlaceSearch {
 public:
  PlaceSearch(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
              const ExtentWorkspace& extent)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        extent_(extent),
        same_(kSamePlace * (a.diameter() + b.diameter())) {}

  bool find(const Vector2d& place, CornerPair& corner) {
    corner.distance = std::numeric_limits<double>::infinity();
    for (const ExtentWorkspace::Piece& piece : extent_.pieces) {
      const auto first = extent_.points.begin() + piece.first;
      const bool is_here = std::any_of(first, first + piece.count, [&](const Vector2d& point) {
        return (point - place).squaredNorm() <= same_ * same_;
      });
      if (is_here)
        tryTriangles(place, extent_.open[piece.pair].first, extent_.open[piece.pair].second, corner);
    }
    return std::isfinite(corner.distance);
  }

  bool isSame(const CornerPair& l, const CornerPair& r) const {
    return (l.point_a_in_a - r.point_a_in_a).norm() + (l.point_b_in_a - r.point_b_in_a).norm() <= 2.0 * same_;
  }

 private:
  void tryTriangles(const Vector2d& place, TriangleIndex triangle_a, TriangleIndex triangle_b,
                    CornerPair& corner) const {
    const detail::PairFrame frame(a_, b_, a_from_b_, triangle_a, triangle_b);
    const TrianglePoints of_a = frame.cornersOfA(triangle_a);
    const TrianglePoints of_b = frame.cornersOfB(triangle_b);
    const Vector3d origin = extent_.origin - frame.centre_a;
    const auto flat = [&](const Vector3d& point) {
      return Vector2d(extent_.axis_x.dot(point - origin), extent_.axis_y.dot(point - origin));
    };
    const auto offer = [&](const Vector3d& on_a, const Vector3d& on_b) {
      const double distance = (on_b - on_a).norm();
      if (distance < corner.distance) corner = {on_a + frame.centre_a, on_b + frame.centre_a, distance};
    };
    bool at_vertex = false;
    for (const Vector3d& vertex : of_a) {
      if ((flat(vertex) - place).norm() > same_) continue;
      at_vertex = true;
      offer(vertex, pointTriangleDistance(vertex, of_b).point);
    }
    for (const Vector3d& vertex : of_b) {
      if ((flat(vertex) - place).norm() > same_) continue;
      at_vertex = true;
      offer(pointTriangleDistance(vertex, of_a).point, vertex);
    }
    if (at_vertex) return;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!isOnEdge(flat(of_a[i]), flat(of_a[(i + 1) % 3]), place)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!isOnEdge(flat(of_b[k]), flat(of_b[(k + 1) % 3]), place)) continue;
        Vector3d on_a;
        Vector3d on_b;
        if (closestOfEdges(of_a[i], of_a[(i + 1) % 3], of_b[k], of_b[(k + 1) % 3], on_a, on_b))
          offer(on_a, on_b);
      }
    }
  }

  bool isOnEdge(const Vector2d& begin, const Vector2d& end, const Vector2d& place) const {
    return std::abs(crossed(end - begin, place - begin)) <= same_ * (end - begin).norm();
  }

  const BodyMesh& a_;
  const BodyMesh& b_;
  const Eigen::Isometry3d& a_from_b_;
  const ExtentWorkspace& extent_;
  double same_;
};

}  // namespace

std::size_t findCorners(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                        const WitnessPair& witness, double tolerance, double least_length,
                        std::size_t pair_limit, std::size_t ring_limit, CornerWorkspace& workspace,
                        CornerPairs& corners) {
  if (least_length > 0.0) {
    const Vector3d normal = (witness.point_b_in_a - witness.point_a_in_a).normalized();
    const Eigen::Isometry3d b_from_a = a_from_b.inverse();
    const double rounding = kSamePlace * (a.diameter() + b.diameter());
    const auto reaches = [&](const BodyMesh& body, TriangleIndex triangle, const Vector3d& point,
                             const Vector3d& outwards) {
      return reachesOut(body, triangle, point, outwards, tolerance + rounding, 0.5 * least_length - rounding,
                        ring_limit, workspace);
    };
    if (!reaches(a, witness.triangle_a, witness.point_a_in_a, normal) ||
        !reaches(b, witness.triangle_b, b_from_a * witness.point_b_in_a, b_from_a.linear() * normal)) {
      return 0;
    }
  }
  const NicheExtent extent =
      measureExtent(a, b, a_from_b, witness, tolerance, pair_limit, workspace.extent, nullptr, ring_limit);
  if (extent.kind == NicheKind::Point || extent.cut || extent.length < least_length) return 0;
  workspace.hull = workspace.extent.hull;
  keepLargest(workspace.hull, kSamePlace * (a.diameter() + b.diameter()));
  PlaceSearch search(a, b, a_from_b, workspace.extent);
  std::size_t count = 0;
  for (const Vector2d& place : workspace.hull) {
    CornerPair corner;
    if (!search.find(place, corner)) continue;
    const auto end = corners.begin() + static_cast<std::ptrdiff_t>(count);
    if (std::any_of(corners.begin(), end,
                    [&](const CornerPair& other) { return search.isSame(other, corner); }))
      continue;
    corners[count++] = corner;
  }
  return count;
}

}  // namespace concave_distance
