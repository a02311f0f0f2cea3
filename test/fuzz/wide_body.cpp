#include "fuzz/wide_body.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace concave_distance::test {
namespace {

/// Triangles this near to each other meet, as a fraction of the diameter.
constexpr long double kMeeting = 1e-9L;

std::uint32_t rootOf(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

void addPoint(const WidePoint& point, long double tolerance, std::vector<WidePoint>& points) {
  const auto is_same = [&](const WidePoint& other) { return length(other - point) <= tolerance; };
  if (std::none_of(points.begin(), points.end(), is_same)) points.push_back(point);
}

/// Corners of l on r, and where edges of l cross the face of r.
void addOneSide(const WideTriangle& l, const WideTriangle& r, long double tolerance,
                std::vector<WidePoint>& points) {
  const WidePoint normal = (r[1] - r[0]).cross(r[2] - r[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (length(closestOnTriangle(l[i], r) - l[i]) <= tolerance) addPoint(l[i], tolerance, points);
    const std::size_t next = (i + 1) % 3;
    const long double here = normal.dot(l[i] - r[0]);
    const long double there = normal.dot(l[next] - r[0]);
    if (!((here < 0 && there > 0) || (here > 0 && there < 0))) continue;
    const WidePoint at = l[i] + (l[next] - l[i]) * (here / (here - there));
    if (exactlyInside(at, r, normal)) addPoint(at, tolerance, points);
  }
}

/// The corners of what two triangles have in common.
std::vector<WidePoint> commonPoints(const WideTriangle& l, const WideTriangle& r, long double tolerance) {
  std::vector<WidePoint> points;
  addOneSide(l, r, tolerance, points);
  addOneSide(r, l, tolerance, points);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const WidePoint u = l[(i + 1) % 3] - l[i];
      const WidePoint v = r[(j + 1) % 3] - r[j];
      const WidePoint normal = u.cross(v);
      const long double squared = normal.squaredNorm();
      if (!(squared > 1e-24L * u.squaredNorm() * v.squaredNorm())) continue;
      const WidePoint w = r[j] - l[i];
      const long double s = w.cross(v).dot(normal) / squared;
      const long double t = w.cross(u).dot(normal) / squared;
      if (s < 0 || s > 1 || t < 0 || t > 1) continue;
      const WidePoint on_l = l[i] + u * s;
      if (length(r[j] + v * t - on_l) <= tolerance) addPoint(on_l, tolerance, points);
    }
  }
  return points;
}

/// Triangles, segments and points that cover the hull of points in one plane.
std::vector<WideTriangle> coverOf(const std::vector<WidePoint>& points, long double tolerance) {
  std::vector<WideTriangle> cover;
  if (points.size() == 1) cover.push_back({points[0], points[0], points[0]});
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      cover.push_back({points[i], points[j], points[j]});
      for (std::size_t k = 0; k < j; ++k) {
        const WidePoint normal = (points[j] - points[i]).cross(points[k] - points[i]);
        const long double longest = std::max(
            {length(points[j] - points[i]), length(points[k] - points[i]), length(points[k] - points[j])});
        if (length(normal) > 4 * tolerance * longest) cover.push_back({points[i], points[j], points[k]});
      }
    }
  }
  return cover;
}

std::vector<std::size_t> commonNodes(const TriangleNodes& l, const TriangleNodes& r) {
  std::vector<std::size_t> common;
  for (const NodeIndex node : l) {
    if (std::find(r.begin(), r.end(), node) != r.end()) common.push_back(node.value);
  }
  return common;
}

}  // namespace

WideBody::WideBody(const SurfaceMesh& mesh) : diameter_(mesh.diameter()) {
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex index{t};
    triangles_.push_back(
        {widened(mesh.corner(index, 0)), widened(mesh.corner(index, 1)), widened(mesh.corner(index, 2))});
  }
  for (const Eigen::Vector3d& vertex : mesh.vertices()) {
    reach_ = std::max<long double>(reach_, vertex.cwiseAbs().maxCoeff());
  }
  findShells(mesh);
  findJoints(mesh);
  findSurface();
}

/// Shells are connected over edges; closed where every edge has one triangle in each direction.
void WideBody::findShells(const SurfaceMesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::uint32_t>> triangles_along;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const TriangleNodes& nodes = mesh.triangles()[t];
    for (std::size_t k = 0; k < 3; ++k) {
      triangles_along[{nodes[k].value, nodes[(k + 1) % 3].value}].push_back(t);
    }
  }
  std::vector<std::uint32_t> parent(triangles_.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (const auto& [edge, along] : triangles_along) {
    const auto back = triangles_along.find({edge.second, edge.first});
    for (const std::uint32_t t : along) {
      parent[rootOf(parent, t)] = rootOf(parent, along.front());
      if (back != triangles_along.end()) parent[rootOf(parent, t)] = rootOf(parent, back->second.front());
    }
  }
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) shell_of_.push_back(rootOf(parent, t));
  is_closed_.assign(triangles_.size(), true);
  for (const auto& [edge, along] : triangles_along) {
    const auto back = triangles_along.find({edge.second, edge.first});
    if (back == triangles_along.end() || back->second.size() != along.size()) {
      is_closed_[shell_of_[along.front()]] = false;
    }
  }
}

void WideBody::findJoints(const SurfaceMesh& mesh) {
  const long double tolerance = kMeeting * diameter_;
  // Triangles around one vertex that follow each other over edges need no joint at the vertex: the steps over
  // these edges rise no higher.
  std::map<std::pair<std::size_t, std::uint32_t>, std::uint32_t> place;  // of (node, triangle)
  std::vector<std::uint32_t> fan;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (const NodeIndex node : mesh.triangles()[t]) {
      place[{node.value, t}] = static_cast<std::uint32_t>(fan.size());
      fan.push_back(static_cast<std::uint32_t>(fan.size()));
    }
  }
  for (std::uint32_t l = 0; l < triangles_.size(); ++l) {
    for (std::uint32_t r = 0; r < l; ++r) {
      const auto common = commonNodes(mesh.triangles()[l], mesh.triangles()[r]);
      if (common.size() < 2) continue;
      for (const std::size_t node : common) {
        fan[rootOf(fan, place[{node, l}])] = rootOf(fan, place[{node, r}]);
      }
    }
  }
  for (std::uint32_t l = 0; l < triangles_.size(); ++l) {
    for (std::uint32_t r = 0; r < l; ++r) {
      if (exactSquaredDistance(triangles_[l], triangles_[r]) > tolerance * tolerance) continue;
      const auto common = commonNodes(mesh.triangles()[l], mesh.triangles()[r]);
      const auto points = commonPoints(triangles_[l], triangles_[r], tolerance);
      const bool is_of_fan = common.size() == 1 && points.size() == 1 &&
                             rootOf(fan, place[{common[0], l}]) == rootOf(fan, place[{common[0], r}]);
      if (!points.empty() && !is_of_fan) joints_.push_back({l, r, coverOf(points, tolerance)});
    }
  }
}

void WideBody::findSurface() {
  std::vector<bool> is_met(triangles_.size(), false);
  for (const Joint& joint : joints_) {
    if (shell_of_[joint.l] != shell_of_[joint.r]) is_met[joint.l] = is_met[joint.r] = true;
  }
  // Six times the volume of each shell: the winding number inside is its sign.
  std::vector<long double> volume(triangles_.size(), 0.0L);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const WideTriangle& at = triangles_[t];
    const WidePoint& origin = triangles_[shell_of_[t]][0];
    volume[shell_of_[t]] += (at[0] - origin).dot((at[1] - origin).cross(at[2] - origin));
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const std::uint32_t own = shell_of_[t];
    const WidePoint middle = (triangles_[t][0] + triangles_[t][1] + triangles_[t][2]) * (1.0L / 3.0L);
    long double others = 0.0L;
    for (std::uint32_t shell = 0; shell < triangles_.size(); ++shell) {
      if (shell_of_[shell] == shell && shell != own && is_closed_[shell]) others += windingOf(shell, middle);
    }
    const long double least = is_closed_[own] && volume[own] < 0 ? others - 1.0L : others;
    is_surface_.push_back(is_met[t] || least < 0.5L);
  }
}

/// Sum of the solid angles of the shell's triangles (van Oosterom and Strackee 1983) over 4 pi.
long double WideBody::windingOf(std::uint32_t shell, const WidePoint& point) const {
  long double sum = 0.0L;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (shell_of_[t] != shell) continue;
    const WidePoint a = triangles_[t][0] - point;
    const WidePoint b = triangles_[t][1] - point;
    const WidePoint c = triangles_[t][2] - point;
    const long double la = length(a);
    const long double lb = length(b);
    const long double lc = length(c);
    sum += 2.0L * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0L * std::acos(-1.0L));
}

long double WideBody::winding(const WidePoint& point) const {
  long double sum = 0.0L;
  for (std::uint32_t shell = 0; shell < triangles_.size(); ++shell) {
    if (shell_of_[shell] == shell && is_closed_[shell]) sum += windingOf(shell, point);
  }
  return sum;
}

long double WideBody::highestOverPlane() const {
  if (is_closed_.size() != 1 || !is_closed_.front()) return std::numeric_limits<long double>::infinity();
  long double highest = -std::numeric_limits<long double>::infinity();
  for (const WideTriangle& plane : triangles_) {
    const WidePoint normal = (plane[1] - plane[0]).cross(plane[2] - plane[0]);
    for (const WideTriangle& t : triangles_) {
      for (const WidePoint& corner : t) {
        highest = std::max(highest, normal.dot(corner - plane[0]) / length(normal));
      }
    }
  }
  return highest;
}

}  // namespace concave_distance::test
