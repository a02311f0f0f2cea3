#pragma once

#include "concave_distance/mesh/body_mesh.h"
#include "search/grid/search_nodes.h"

namespace concave_distance {

/// A volume mesh's nodes (Carretero, sec. 3.1.2): those of the surface's grid, and inside the body a
/// body-centred cubic lattice (the nodes and edges of its tetrahedra). Lattice nodes keep off the surface's
/// by half of its edges and are neighbours of those within 1.25 of the longer of both edges that they see
/// through the body. Closed shells have an inside, open ones none. For comparisons: the nearest points of two
/// bodies lie on their surfaces, so nodes inside can only be stood on for nothing.
/// @param surface_nodes of makeGridNodes() with an explicit edge length
/// @param lattice_edge edge of the lattice's cubes, metres
/// @throws Error when the surface nodes are thinned or the edge is not positive and finite
SearchNodes makeVolumeNodes(const BodyMesh& body, SearchNodes surface_nodes, double lattice_edge);

}  // namespace concave_distance
