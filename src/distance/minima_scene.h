#pragma once

#include <vector>

#include "concave_distance/distance/local_minima.h"
#include "local_frames.h"

namespace concave_distance::detail {

/// Both surfaces at one pose in one recentred frame, with the rounding that distances in it carry.
struct MinimaScene {
  MinimaScene(const MinimaIndex& index_a, const MinimaIndex& index_b, const Eigen::Isometry3d& pose)
      : a(index_a),
        b(index_b),
        a_from_b(pose),
        frames(index_a.body().surface().boundingBox().center(),
               index_b.body().surface().boundingBox().center(), pose) {
    vertices_a.reserve(a.body().surface().vertexCount());
    for (const Eigen::Vector3d& v : a.body().surface().vertices()) vertices_a.push_back(v - frames.centre_a);
    vertices_b.reserve(b.body().surface().vertexCount());
    for (const Eigen::Vector3d& v : b.body().surface().vertices()) {
      vertices_b.push_back(frames.rotation * (v - frames.centre_b) + frames.offset);
    }
    size = 0.5 * (a.body().diameter() + b.body().diameter()) + frames.offset.norm();
    rounding = kTriangleDistanceError * size;
  }

  TrianglePoints cornersOfA(TriangleIndex t) const {
    return corners(vertices_a, a.body().surface().triangle(t));
  }
  TrianglePoints cornersOfB(TriangleIndex t) const {
    return corners(vertices_b, b.body().surface().triangle(t));
  }

  const MinimaIndex& a;
  const MinimaIndex& b;
  Eigen::Isometry3d a_from_b;
  LocalFrames frames;
  std::vector<Eigen::Vector3d> vertices_a;
  std::vector<Eigen::Vector3d> vertices_b;
  double size;      ///< no coordinate is larger
  double rounding;  ///< metres, of a distance between triangles

 private:
  static TrianglePoints corners(const std::vector<Eigen::Vector3d>& vertices, const TriangleNodes& nodes) {
    return {vertices[nodes[0].value], vertices[nodes[1].value], vertices[nodes[2].value]};
  }
};

}  // namespace concave_distance::detail
