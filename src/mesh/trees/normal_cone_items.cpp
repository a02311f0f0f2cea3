#include "normal_cone_items.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "normal_cone.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
using Item = NormalConeTree::Item;
using Kind = NormalConeTree::Kind;

/// A triangle that leaves its normal this uncertain bounds nothing.
constexpr double kWorstSlack = 0.1;
/// Edges whose normals differ by less may be convex or reflex, and count as both.
constexpr double kFlat = 1e-7;
/// Heights within this, relative to the diameter, are rounding: a fraction of what the kernels have.
constexpr double kLevel = 0x1.0p-49;

class Collector {
 public:
  Collector(const SurfaceMesh& mesh, const MeshTopology& topology, NormalSides sides,
            const ShellContacts& joints)
      : mesh_(mesh), topology_(topology), sides_(sides), hidden_(joints.hidden) {
    if (joints.joints.empty()) return;
    is_joined_.assign(mesh.triangleCount(), false);
    for (const ShellContacts::Joint& joint : joints.joints) {
      is_joined_[joint.first.value] = is_joined_[joint.second.value] = true;
    }
  }

  std::vector<Item> collect() {
    items_.reserve(3 * mesh_.triangleCount());
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v) addVertex(NodeIndex{v});
    for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
      addFace(TriangleIndex{t});
      for (std::uint8_t k = 0; k < 3; ++k) addEdge(TriangleIndex{t}, k);
    }
    return std::move(items_);
  }

 private:
  bool isHidden(TriangleIndex t) const { return !hidden_.empty() && hidden_[t.value]; }

  bool bothSides(TriangleIndex t) const {
    return sides_ == NormalSides::Both || !topology_.isOnClosedShell(t) ||
           (!is_joined_.empty() && is_joined_[t.value]);
  }

  template <typename Triangles>
  bool anyHidden(const Triangles& triangles) const {
    return std::any_of(triangles.begin(), triangles.end(), [this](TriangleIndex t) { return isHidden(t); });
  }

  /// Where shells meet, the sum of their normals is meaningless for each.
  template <typename Triangles>
  bool bothSidesOfAny(const Triangles& triangles) const {
    const std::uint32_t shell = topology_.shell_of_triangle[triangles.begin()->value];
    return std::any_of(triangles.begin(), triangles.end(), [&](TriangleIndex t) {
      return bothSides(t) || isHidden(t) || topology_.shell_of_triangle[t.value] != shell;
    });
  }

  double slackOf(TriangleIndex t) const { return normalError(mesh_, t); }

  void add(const Vector3d& centre, double radius, const DirectionCap& cap, TriangleIndex t, Kind kind,
           std::uint8_t element) {
    items_.push_back({centre, radius * (1.0 + 1e-12), cap, t, kind, element});
  }

  /// Adds what the clipper holds, on the sides wanted.
  void addClipped(const Vector3d& centre, double radius, const Vector3d& normal, bool both_sides,
                  TriangleIndex t, Kind kind, std::uint8_t element) {
    if (const auto cap = clipper_.capOnSide(normal)) add(centre, radius, *cap, t, kind, element);
    if (!both_sides || normal.isZero(0.0)) return;
    if (const auto cap = clipper_.capOnSide(-normal)) add(centre, radius, *cap, t, kind, element);
  }

  void addVertex(NodeIndex v) {
    const auto fan = topology_.triangles_of_vertex.row(v.value);
    const auto seen = std::find_if(fan.begin(), fan.end(), [this](TriangleIndex t) { return !isHidden(t); });
    if (seen == fan.end()) return;
    const auto around = topology_.neighbours_of_vertex.row(v.value);
    // As many neighbours as triangles: no border runs through.
    if (around.size() == fan.size() && !anyHidden(fan) && isInsidePlane(fan, around, mesh_.vertex(v))) return;
    clipper_.reset();
    forEachNeighbour(mesh_, topology_, hidden_, v, [&](NodeIndex neighbour) {
      const Vector3d displacement = (mesh_.vertex(neighbour) - mesh_.vertex(v)).stableNormalized();
      if (!displacement.isZero(0.0)) clipper_.clip(displacement, kConeSlack);
    });
    const TriangleNodes& nodes = mesh_.triangle(*seen);
    const auto corner = static_cast<std::uint8_t>(std::find(nodes.begin(), nodes.end(), v) - nodes.begin());
    addClipped(mesh_.vertex(v), 0.0, topology_.vertex_normals[v.value], bothSidesOfAny(fan), *seen,
               Kind::Vertex, corner);
  }

  /// Whether a triangle's corner away from an edge lies in another triangle's plane.
  bool isLevel(const Vector3d& normal, const Vector3d& point, NodeIndex node) const {
    return std::abs(normal.dot(mesh_.vertex(node) - point)) <= kLevel * mesh_.diameter();
  }

  /// Within a plane: what is opposite to it is opposite to the faces around, too, or to a corner or an edge
  /// of the plane's outline. The normals differ by no more than the caps of the faces are widened by.
  template <typename Triangles, typename Nodes>
  bool isInsidePlane(const Triangles& triangles, const Nodes& nodes, const Vector3d& point) const {
    const TriangleIndex first = *triangles.begin();
    const Vector3d& normal = topology_.triangle_normals[first.value];
    const double slack = kConeSlack + slackOf(first);
    const auto has_normal = [&](TriangleIndex t) {
      const Vector3d& other = topology_.triangle_normals[t.value];
      const double slack_of_other = slackOf(t);
      return slack_of_other < kWorstSlack && other.dot(normal) > 0.0 &&
             other.cross(normal).norm() <= slack + slack_of_other;
    };
    return std::all_of(triangles.begin(), triangles.end(), has_normal) &&
           std::all_of(nodes.begin(), nodes.end(), [&](NodeIndex n) { return isLevel(normal, point, n); });
  }

  void addFace(TriangleIndex t) {
    const Vector3d& normal = topology_.triangle_normals[t.value];
    if (isHidden(t) || normal.isZero(0.0)) return;  // or its edges are all there is
    const Vector3d low = mesh_.corner(t, 0).cwiseMin(mesh_.corner(t, 1)).cwiseMin(mesh_.corner(t, 2)).eval();
    const Vector3d high = mesh_.corner(t, 0).cwiseMax(mesh_.corner(t, 1)).cwiseMax(mesh_.corner(t, 2)).eval();
    const Vector3d centre = 0.5 * (low + high);
    double radius = 0.0;
    for (int k = 0; k < 3; ++k) radius = std::max(radius, (mesh_.corner(t, k) - centre).norm());
    const double slack = slackOf(t);
    const bool unsure = slack > kWorstSlack;
    add(centre, radius, unsure ? DirectionCap{} : capOfAngle(normal, slack), t, Kind::Face, 0);
    if (bothSides(t) && !unsure) add(centre, radius, capOfAngle(-normal, slack), t, Kind::Face, 0);
  }

  void addEdge(TriangleIndex t, std::uint8_t k) {
    const NodeIndex from = mesh_.triangle(t)[k];
    const NodeIndex to = mesh_.triangle(t)[(k + 1U) % 3];
    if (from == to || isHidden(t)) return;
    around_.clear();
    bool is_rim = false;
    const auto at_from = topology_.triangles_of_vertex.row(from.value);
    const auto at_to = topology_.triangles_of_vertex.row(to.value);
    const bool fewer_at_from = at_from.size() <= at_to.size();
    const NodeIndex opposite = fewer_at_from ? to : from;
    for (const TriangleIndex other : fewer_at_from ? at_from : at_to) {
      const TriangleNodes& nodes = mesh_.triangle(other);
      if (std::find(nodes.begin(), nodes.end(), opposite) == nodes.end()) continue;
      is_rim = is_rim || isHidden(other);
      if (isHidden(other)) continue;
      if (other < t) return;  // the edge was added with that triangle
      around_.push_back(other);
    }
    if (around_.size() == 2 && isInsidePlane(around_, mesh_.triangle(around_[0]), mesh_.vertex(from)) &&
        isInsidePlane(around_, mesh_.triangle(around_[1]), mesh_.vertex(from))) {
      return;
    }
    const Vector3d centre = 0.5 * (mesh_.vertex(from) + mesh_.vertex(to));
    const double radius = 0.5 * (mesh_.vertex(to) - mesh_.vertex(from)).norm();
    const Vector3d along = (mesh_.vertex(to) - mesh_.vertex(from)).stableNormalized();
    if (addBetweenTwo(t, k, centre, radius, along, is_rim)) return;
    clipper_.reset();
    clipper_.clip(along, kConeSlack);
    clipper_.clip(-along, kConeSlack);
    Vector3d normal = Vector3d::Zero();
    for (const TriangleIndex other : around_) {
      normal += topology_.triangle_normals[other.value];
      const double slack = slackOf(other);
      if (slack > kWorstSlack) continue;
      const TriangleNodes& nodes = mesh_.triangle(other);
      const NodeIndex apex =
          *std::find_if(nodes.begin(), nodes.end(), [&](NodeIndex n) { return n != from && n != to; });
      const Vector3d displacement = mesh_.vertex(apex) - mesh_.vertex(from);
      clipper_.clip((displacement - along.dot(displacement) * along).normalized(), slack + kConeSlack);
    }
    addClipped(centre, radius, normal.normalized(), is_rim || bothSidesOfAny(around_), t, Kind::Edge, k);
  }

  /// The common case in closed form: two sound triangles of one winding. False when it is another.
  bool addBetweenTwo(TriangleIndex t, std::uint8_t k, const Vector3d& centre, double radius,
                     const Vector3d& along, bool is_rim) {
    if (is_rim || around_.size() != 2) return false;
    const TriangleIndex other = around_[0] == t ? around_[1] : around_[0];
    const TriangleNodes& nodes = mesh_.triangle(other);
    const auto at = static_cast<std::size_t>(
        std::find(nodes.begin(), nodes.end(), mesh_.triangle(t)[(k + 1U) % 3]) - nodes.begin());
    const bool opposite = nodes[(at + 1) % 3] == mesh_.triangle(t)[k];
    const Vector3d& n0 = topology_.triangle_normals[t.value];
    const Vector3d& n1 = topology_.triangle_normals[other.value];
    const double slack = slackOf(t) + slackOf(other);
    if (!opposite || !(slack < 0.1 * kFlat) || !(n0.dot(n1) > -0.999)) return false;
    const Vector3d axis = (n0 + n1).normalized();
    const Vector3d turn = n0.cross(n1);
    const double angle = 0.5 * std::atan2(turn.norm(), n0.dot(n1)) + slack;
    const double convex = turn.dot(along);
    if (convex > -kFlat) add(centre, radius, capOfAngle(axis, angle), t, Kind::Edge, k);
    if (convex < kFlat && bothSides(t)) add(centre, radius, capOfAngle(-axis, angle), t, Kind::Edge, k);
    return true;
  }

  const SurfaceMesh& mesh_;
  const MeshTopology& topology_;
  NormalSides sides_;
  const std::vector<bool>& hidden_;
  std::vector<bool> is_joined_;  ///< empty: none is
  std::vector<Item> items_;
  std::vector<TriangleIndex> around_;
  ConeClipper clipper_;
};

}  // namespace

std::vector<Item> collectConeItems(const SurfaceMesh& mesh, const MeshTopology& topology, NormalSides sides,
                                   const ShellContacts& joints) {
  return Collector(mesh, topology, sides, joints).collect();
}

}  // namespace concave_distance::detail
