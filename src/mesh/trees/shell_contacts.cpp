#include "shell_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "base/union_find.h"
#include "triangle_meeting.h"

namespace concave_distance {
namespace {

using Eigen::Vector3d;
using Corners = detail::TriangleCorners;

constexpr double kTouch = 1e-9;  // of the diameter

class ContactFinder {
 public:
  ContactFinder(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree)
      : mesh_(mesh), topology_(topology), tree_(tree), tolerance_(kTouch * mesh.diameter()) {}

  ShellContacts find() {
    is_near_.assign(mesh_.triangleCount(), false);
    compare();
    hide();
    return std::move(joints_);
  }

 private:
  Corners cornersOf(TriangleIndex t) const {
    return {mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2)};
  }
  std::uint32_t shellOf(TriangleIndex t) const { return topology_.shell_of_triangle[t.value]; }

  bool overlap(const Eigen::AlignedBox3d& l, const Eigen::AlignedBox3d& r) const {
    return l.squaredExteriorDistance(r) <= tolerance_ * tolerance_;
  }

  /// Every pair of triangles whose boxes meet.
  void compare() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{0U, 0U}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      const TriangleTree::Node& l = tree_.nodes()[i];
      const TriangleTree::Node& r = tree_.nodes()[j];
      if (!overlap(l.box, r.box)) continue;
      if (l.count > 0 && r.count > 0) {
        compareLeaves(l, r, i == j);
      } else if (i == j) {
        open.emplace_back(i + 1, i + 1);
        open.emplace_back(l.first, l.first);
        open.emplace_back(i + 1, l.first);
      } else if (r.count > 0 || (l.count == 0 && l.box.sizes().sum() >= r.box.sizes().sum())) {
        open.emplace_back(i + 1, j);
        open.emplace_back(l.first, j);
      } else {
        open.emplace_back(i, j + 1);
        open.emplace_back(i, r.first);
      }
    }
  }

  void compareLeaves(const TriangleTree::Node& l, const TriangleTree::Node& r, bool same) {
    for (std::uint32_t i = l.first; i < l.first + l.count; ++i) {
      for (std::uint32_t j = same ? i + 1 : r.first; j < r.first + r.count; ++j) {
        const TriangleIndex a = tree_.order()[i];
        const TriangleIndex b = tree_.order()[j];
        comparePair(a, b);
      }
    }
  }

  void comparePair(TriangleIndex a, TriangleIndex b) {
    const Corners corners_a = cornersOf(a);
    const Corners corners_b = cornersOf(b);
    const auto box_of = [](const Corners& c) {
      Eigen::AlignedBox3d box(c[0]);
      box.extend(c[1]);
      box.extend(c[2]);
      return box;
    };
    if (!overlap(box_of(corners_a), box_of(corners_b))) return;
    const Shared shared = sharedBy(a, b);
    if (shared.count == 3 || (shared.count == 1 && !detail::mayMeetBeside(shared.corner, shared.rest_a,
                                                                          shared.rest_b, tolerance_))) {
      return;
    }
    detail::TriangleMeeting meeting(corners_a, corners_b, tolerance_);
    if (!reachesBeyond(shared, meeting.points())) return;
    if (shellOf(a) != shellOf(b)) is_near_[a.value] = is_near_[b.value] = true;
    const Vector3d normal =
        (corners_a[1] - corners_a[0]).cross(corners_a[2] - corners_a[0]).stableNormalized();
    meeting.forEachSide(normal, [&](const Vector3d& from, const Vector3d& to) {
      joints_.joints.push_back({a, b, from, to});
    });
  }

  /// The corners that two triangles have in common by their numbers.
  struct Shared {
    std::size_t count = 0;
    Vector3d corner = Vector3d::Zero();  ///< one of them
    Vector3d other = Vector3d::Zero();   ///< the second of two
    std::array<Vector3d, 2> rest_a;      ///< the others of each, where one is shared
    std::array<Vector3d, 2> rest_b;
  };

  Shared sharedBy(TriangleIndex a, TriangleIndex b) const {
    const TriangleNodes& nodes_a = mesh_.triangle(a);
    const TriangleNodes& nodes_b = mesh_.triangle(b);
    Shared shared;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (nodes_a[i] != nodes_b[k]) continue;
        (shared.count == 0 ? shared.corner : shared.other) = mesh_.vertex(nodes_a[i]);
        shared.rest_a = {mesh_.vertex(nodes_a[(i + 1) % 3]), mesh_.vertex(nodes_a[(i + 2) % 3])};
        shared.rest_b = {mesh_.vertex(nodes_b[(k + 1) % 3]), mesh_.vertex(nodes_b[(k + 2) % 3])};
        ++shared.count;
      }
    }
    return shared;
  }

  /// Whether points in common lie elsewhere than at the shared corner or along the shared edge.
  bool reachesBeyond(const Shared& shared, const std::vector<Vector3d>& points) const {
    const Vector3d edge = shared.count == 2 ? Vector3d(shared.other - shared.corner) : Vector3d::Zero();
    const double squared_length = edge.squaredNorm();
    return std::any_of(points.begin(), points.end(), [&](const Vector3d& point) {
      if (shared.count == 0) return true;
      const Vector3d from_corner = point - shared.corner;
      const double share =
          squared_length > 0.0 ? std::clamp(from_corner.dot(edge) / squared_length, 0.0, 1.0) : 0.0;
      return (from_corner - share * edge).norm() > 2.0 * tolerance_;
    });
  }

  /// Triangles of a shell that no other one meets hang together in parts, each wholly inside or outside.
  void hide() {
    UnionFind parts(mesh_.triangleCount());
    for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
      if (is_near_[t]) continue;
      for (const TriangleIndex next : topology_.triangle_across_edge[t]) {
        if (next != kNoTriangle && !is_near_[next.value] && shellOf(next) == shellOf(TriangleIndex{t})) {
          parts.unite(t, next.value);
        }
      }
    }
    std::vector<char> hidden(mesh_.triangleCount(), 0);
    for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
      if (is_near_[t]) continue;
      const std::uint32_t part = parts.find(t);
      if (part != t) {
        hidden[t] = hidden[part];
        continue;
      }
      if (isCavity(shellOf(TriangleIndex{t}))) continue;
      const Corners corners = cornersOf(TriangleIndex{t});
      const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
      hidden[t] = isInsideOtherShell(mesh_, topology_, tree_, TriangleIndex{t}, middle) ? 1 : 0;
    }
    if (std::find(hidden.begin(), hidden.end(), 1) != hidden.end()) {
      joints_.hidden.assign(hidden.begin(), hidden.end());
    }
  }

  /// A closed shell around a hollow, whose own winding number is negative: never hidden.
  bool isCavity(std::uint32_t shell) {
    if (!topology_.shell_is_closed[shell]) return false;
    if (volumes_.empty()) {
      volumes_.assign(topology_.shellCount(), 0.0);
      for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t) {
        const Corners c = cornersOf(TriangleIndex{t});
        const Vector3d origin = mesh_.boundingBox().center();
        volumes_[shellOf(TriangleIndex{t})] += (c[0] - origin).dot((c[1] - origin).cross(c[2] - origin));
      }
    }
    return volumes_[shell] < 0.0;
  }

  const SurfaceMesh& mesh_;
  const MeshTopology& topology_;
  const TriangleTree& tree_;
  double tolerance_;
  std::vector<bool> is_near_;  ///< meets another shell
  std::vector<double> volumes_;
  ShellContacts joints_;
};

}  // namespace

ShellContacts findShellContacts(const SurfaceMesh& mesh, const MeshTopology& topology,
                                const TriangleTree& tree) {
  return ContactFinder(mesh, topology, tree).find();
}

bool isInsideOtherShell(const SurfaceMesh& mesh, const MeshTopology& topology, const TriangleTree& tree,
                        TriangleIndex triangle, const Vector3d& point) {
  std::vector<bool> others = topology.shell_is_closed;
  others[topology.shell_of_triangle[triangle.value]] = false;
  return containsPoint(tree, mesh, others, topology.shell_of_triangle, point);
}

CompressedRows<AdjacentTriangle> joinedAdjacency(const SurfaceMesh& mesh, const ShellContacts& joints,
                                                 const CompressedRows<AdjacentTriangle>& adjacency) {
  return compressedRows<AdjacentTriangle>(mesh.triangleCount(), [&](const auto& visit) {
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      if (joints.isHidden(TriangleIndex{t})) continue;
      for (const AdjacentTriangle& next : adjacency.row(t)) {
        if (!joints.isHidden(next.triangle)) visit(t, next);
      }
    }
    for (std::size_t j = 0; j < joints.joints.size(); ++j) {
      const ShellContacts::Joint& joint = joints.joints[j];
      const NodeIndex from{mesh.vertexCount() + 2 * j};
      const NodeIndex to{joint.from == joint.to ? from.value : from.value + 1};
      visit(joint.first.value, AdjacentTriangle{joint.second, from, to});
      visit(joint.second.value, AdjacentTriangle{joint.first, from, to});
    }
  });
}

void joinPieces(const ShellContacts& joints, ConnectedPieces& pieces) {
  if (joints.joints.empty()) return;
  UnionFind united(pieces.count);
  for (const ShellContacts::Joint& joint : joints.joints) {
    united.unite(pieces.piece_of_triangle[joint.first.value], pieces.piece_of_triangle[joint.second.value]);
  }
  std::vector<std::uint32_t> numbers(pieces.count);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < pieces.count; ++i) {
    const std::uint32_t root = united.find(i);
    numbers[i] = root == i ? count++ : numbers[root];
  }
  for (std::uint32_t& piece : pieces.piece_of_triangle) piece = numbers[piece];
  pieces.count = count;
}

}  // namespace concave_distance
