#pragma once

#include <cstddef>
#include <string>

#include "base/random_engine.h"
#include "mesh/surface/mesh_topology.h"
#include "search/grid/search_nodes.h"

namespace concave_distance {

struct RandomNodesOptions {
  /// Nodes in all; more where the vertices and edges alone are more, or shells would be without any.
  std::size_t count = 1000;
  /// Every vertex is a node, and every edge between faces that are not flat against each other is divided
  /// evenly at the nodes' mean spacing; what is left of the count lies anywhere.
  bool vertices_and_edges = true;
};

/// Random points on the surface as the search's nodes, instead of a mesh's (Carretero, sec. 3.1.1): on every
/// part of the surface as many as its area is worth. The thesis gives them no neighbours, and so without a
/// mesh no descent, no mesh mating and no sharing; here two are neighbours where their regions touch (the
/// places nearer to one than to any other, along a grid four times as fine), so ways between them keep to the
/// surface and shells keep apart. For comparisons: makeSearchNodes() is what the package uses.
/// @param surface repaired, metres @param topology of it @param where named in errors
/// @throws Error when the count is 0; as makeSearchGrid()
SearchNodes makeRandomNodes(const SurfaceMesh& surface, const MeshTopology& topology,
                            const RandomNodesOptions& options, RandomEngine& engine,
                            const std::string& where);

}  // namespace concave_distance
