#pragma once

#include "boundary_components.h"
#include "overlay_depth.h"

namespace concave_distance::detail {

/// Depth and where it is attained, working frame.
struct DepthAlong {
  Eigen::Vector3d normal;
  OverlayDepth::Result deepest;
};

/// The region's depth along a direction (OverlayDepth over its pieces).
OverlayDepth::Result depthAlong(const Eigen::Vector3d& normal, WorkingFrame& frame,
                                const CrossingCurves& curves, const SurfacePieces (&pieces)[2],
                                const BoundaryComponents& components, const BoundaryComponent& region,
                                OverlayDepth& overlay);

/// Finds the least depth where the vector areas cancel: along the known normal, the vector areas of the (four
/// largest) loops and the principal axes of how the pieces face, but for the first each both ways. Among what
/// is the least to 1 % the direction most along the known normal counts, without one a fixed direction: of
/// two opposite ways that are as long rounding would choose.
/// @param known unit, or zero: none
DepthAlong leastDepth(WorkingFrame& frame, const CrossingCurves& curves, const SurfacePieces (&pieces)[2],
                      BoundaryComponents& components, const BoundaryComponent& region, UnionFind& sets,
                      const Eigen::Vector3d& known, OverlayDepth& overlay);

/// Finds, for a shell of the body `side` that nothing crosses, the least way until its extent and the other
/// body's part, along the axes of both bodies' boxes, each both ways; to 1 %, as leastDepth().
DepthAlong leastExit(WorkingFrame& frame, Side side, const SurfacePieces& pieces,
                     const BoundaryComponent& region, const Eigen::Vector3d& known);

}  // namespace concave_distance::detail
