#include "piece_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

/// The faces of a box, counter-clockwise seen from outside.
std::vector<Polygon> boxFaces(const Eigen::AlignedBox3d& box) {
  std::vector<Polygon> faces;
  const Eigen::Vector3d& low = box.min();
  const Eigen::Vector3d& high = box.max();
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const bool upper : {false, true}) {
      Polygon face;
      for (const auto& [at_u, at_v] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        Eigen::Vector3d corner;
        corner[axis] = upper ? high[axis] : low[axis];
        corner[u] = at_u == 1 ? high[u] : low[u];
        corner[v] = at_v == 1 ? high[v] : low[v];
        face.push_back(corner);
      }
      if (!upper) {
        std::reverse(face.begin(), face.end());
      }
      faces.push_back(face);
    }
  }
  return faces;
}

/// The part of a face with value >= 0; points on the plane go to `cut`.
Polygon clipped(const Polygon& face, const LinearConstraint& constraint, double margin, Polygon& cut) {
  Polygon kept;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Eigen::Vector3d& p = face[i];
    const Eigen::Vector3d& next = face[(i + 1) % face.size()];
    const double at_p = constraint.value(p);
    const double at_next = constraint.value(next);
    if (at_p >= -margin) {
      kept.push_back(p);
    }
    if (std::abs(at_p) <= margin) {
      cut.push_back(p);
    }
    if ((at_p > margin && at_next < -margin) || (at_p < -margin && at_next > margin)) {
      kept.emplace_back(p + at_p / (at_p - at_next) * (next - p));
      cut.push_back(kept.back());
    }
  }
  return kept.size() >= 3 ? kept : Polygon{};
}

/// The points on a constraint's plane as the face that closes the solid there.
Polygon closingFace(const Polygon& cut, const LinearConstraint& constraint, double margin) {
  Polygon face;
  for (const Eigen::Vector3d& p : cut) {
    const bool is_new = std::none_of(face.begin(), face.end(),
                                     [&](const Eigen::Vector3d& q) { return (p - q).norm() <= margin; });
    if (is_new) {
      face.push_back(p);
    }
  }
  if (face.size() < 3) {
    return {};
  }
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : face) {
    centre += p / static_cast<double>(face.size());
  }
  const Eigen::Vector3d outward = -constraint.normal;
  const Eigen::Vector3d u = outward.unitOrthogonal();
  const Eigen::Vector3d v = outward.cross(u);
  std::sort(face.begin(), face.end(), [&](const Eigen::Vector3d& l, const Eigen::Vector3d& r) {
    return std::atan2((l - centre).dot(v), (l - centre).dot(u)) <
           std::atan2((r - centre).dot(v), (r - centre).dot(u));
  });
  return face;
}

void clip(std::vector<Polygon>& faces, const LinearConstraint& constraint, double margin) {
  std::vector<Polygon> kept;
  Polygon cut;
  bool cuts = false;
  for (const Polygon& face : faces) {
    cuts = cuts || std::any_of(face.begin(), face.end(),
                               [&](const Eigen::Vector3d& p) { return constraint.value(p) < -margin; });
    Polygon rest = clipped(face, constraint, margin, cut);
    // A face that lies in the plane is closed anew below.
    const bool lies_in_plane = std::all_of(rest.begin(), rest.end(), [&](const Eigen::Vector3d& p) {
      return std::abs(constraint.value(p)) <= margin;
    });
    if (!lies_in_plane) {
      kept.push_back(std::move(rest));
    }
  }
  if (!cuts) {
    return;
  }
  Polygon closing = closingFace(cut, constraint, margin);
  if (!closing.empty()) {
    kept.push_back(std::move(closing));
  }
  faces = std::move(kept);
}

}  // namespace

SurfaceMesh pieceMesh(const ConstraintTree& tree, std::uint32_t piece) {
  const std::string where = "piece " + std::to_string(piece) + " of a constraint tree";
  if (piece >= tree.pieces().size()) {
    throw Error(where, "there are " + std::to_string(tree.pieces().size()) + " pieces", "count from 0");
  }
  const double margin = 1e-9 * tree.diameter();
  std::vector<Polygon> faces = boxFaces(tree.boundingBox());
  for (std::uint32_t at = piece; at != kNoPiece; at = tree.pieces()[at].parent) {
    const TreePiece& clipping = tree.pieces()[at];
    for (std::uint32_t i = 0; i < clipping.constraint_count; ++i) {
      clip(faces, tree.constraints()[clipping.first_constraint + i], margin);
    }
  }
  TriangleSoup soup;
  for (const Polygon& face : faces) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), face.begin(), face.end());
    for (std::uint32_t i = 1; i + 1 < face.size(); ++i) {
      soup.triangles.push_back({first, first + i, first + i + 1});
    }
  }
  RepairOptions options;
  options.weld_tolerance = 4e-9;
  return repairMesh(soup, options, where).mesh;
}

}  // namespace concave_distance
