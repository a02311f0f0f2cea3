#pragma once

#include <vector>

#include "mesh_metric.h"
#include "node_graph.h"

namespace concave_distance {

/// Mesh distance of every node from the nearest of `sources`, metres; infinite where no path leads. O(n log
/// n); for preparation, it allocates.
std::vector<double> pathLengthsFrom(const NodeGraph& graph, const std::vector<NodeIndex>& sources);

/// How long the ways on a body are: per shell the mesh distance between two far ends (from its first node to
/// the farthest, from there to the farthest: at least half of the largest and in practice close to it),
/// averaged over the shells by their node counts, so that a handful of bolts does not make a link small.
/// Metres. O(n log n).
double geodesicExtent(const NodeGraph& graph);

/// A local maximum of the distance from the nodes' centroid.
struct Protrusion {
  NodeIndex node;
  double height;      ///< distance from the centroid, metres
  double prominence;  ///< height above the highest saddle to a higher protrusion of its shell; the highest:
                      ///< height
};

/// Protrusions that rise by at least `least_prominence` (a share of the greatest height), by flooding the
/// graph from the top (0-dimensional persistence); the most prominent first. O(n log n).
std::vector<Protrusion> findProtrusions(const NodeGraph& graph, double least_prominence);

/// The least mesh distance between two of the body's most prominent protrusions (those of at least 5 % of the
/// greatest height, 64 at most) when it is below `bound`, else `bound`; metres.
double protrusionSpacing(const MeshMetric& metric, double bound);

}  // namespace concave_distance
