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
    size = 0.5 * (a.body().diameter() + b.body().diameter()) + frames.offset.norm();
    rounding = kTriangleDistanceError * size;
  }

  Eigen::Vector3d vertexOfA(NodeIndex node) const {
    return a.body().surface().vertex(node) - frames.centre_a;
  }
  Eigen::Vector3d vertexOfB(NodeIndex node) const {
    return frames.rotation * (b.body().surface().vertex(node) - frames.centre_b) + frames.offset;
  }
  TrianglePoints cornersOfA(TriangleIndex t) const { return frames.cornersOfA(a.body(), t); }
  TrianglePoints cornersOfB(TriangleIndex t) const { return frames.cornersOfB(b.body(), t); }

  const MinimaIndex& a;
  const MinimaIndex& b;
  Eigen::Isometry3d a_from_b;
  LocalFrames frames;
  double size;      ///< no coordinate is larger
  double rounding;  ///< metres, of a distance between triangles
};

}  // namespace concave_distance::detail
