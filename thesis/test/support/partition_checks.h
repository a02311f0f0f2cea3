#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/random_engine.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "thesis/src/partition/convex_piece.h"

namespace concave_distance::test {

inline SurfaceMesh loadSurface(const std::string& relative, double weld_tolerance = 0.0) {
  const std::string path = std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/" + relative;
  RepairOptions options;
  options.weld_tolerance = weld_tolerance;
  return repairMesh(importMesh(path), options, path).mesh;
}

inline double volumeOf(const SurfaceMesh& mesh) {
  const Eigen::Vector3d origin = mesh.boundingBox().center();
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Eigen::Vector3d b = mesh.corner(triangle, 1) - origin;
    const Eigen::Vector3d c = mesh.corner(triangle, 2) - origin;
    sum += (mesh.corner(triangle, 0) - origin).dot(b.cross(c)) / 6.0;
  }
  return sum;
}

inline double volumeOf(const ConvexPartition& partition) {
  double sum = 0.0;
  for (const ConvexPiece& piece : partition.pieces) sum += volume(piece);
  return sum;
}

/// Every corner on the inner side of every facet, up to rounding.
inline void expectConvex(const ConvexPartition& partition) {
  for (const ConvexPiece& piece : partition.pieces) {
    for (const Eigen::Vector3d& corner : piece.vertices) {
      EXPECT_GE(depth(piece, corner), -1e-14 * (1.0 + corner.norm()));
    }
    for (std::size_t f = 0; f < piece.facets.size(); ++f) {
      for (const std::uint32_t corner : piece.facets[f]) {
        const auto row = static_cast<Eigen::Index>(f);
        EXPECT_NEAR(piece.normals.row(row).dot(piece.vertices[corner]) + piece.offsets[row], 0.0,
                    1e-14 * (1.0 + piece.vertices[corner].norm()));
      }
      EXPECT_NEAR(piece.normals.row(static_cast<Eigen::Index>(f)).norm(), 1.0, 1e-15);
    }
  }
}

/// The pieces are the body: the same volume to 1e-9, and random points lie in a piece exactly when they lie
/// inside the mesh; in one piece only, but for the walls between them.
inline void expectSameSolid(const ConvexPartition& partition, const SurfaceMesh& mesh, int points) {
  const double body_volume = volumeOf(mesh);
  EXPECT_NEAR(volumeOf(partition), body_volume, 1e-9 * body_volume) << partition.name;
  const MeshTopology topology = buildMeshTopology(mesh);
  const TriangleTree tree(mesh);
  RandomEngine engine(7);
  const double clear_of_walls = 1e-9 * mesh.diameter();
  int inside_count = 0;
  for (int k = 0; k < points; ++k) {
    Eigen::Vector3d point = mesh.boundingBox().min();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      point[axis] += uniformUnit(engine) * mesh.boundingBox().sizes()[axis];
    }
    int holders = 0;
    bool on_wall = false;
    for (const ConvexPiece& piece : partition.pieces) {
      const double deep = depth(piece, point);
      on_wall = on_wall || std::abs(deep) < clear_of_walls;
      holders += deep > 0.0 ? 1 : 0;
    }
    if (on_wall) continue;
    const bool inside =
        containsPoint(tree, mesh, topology.shell_is_closed, topology.shell_of_triangle, point);
    EXPECT_EQ(holders, inside ? 1 : 0) << partition.name << " at " << point.transpose();
    inside_count += inside ? 1 : 0;
  }
  EXPECT_GT(inside_count, points / 50) << "the points say nothing";
}

}  // namespace concave_distance::test
