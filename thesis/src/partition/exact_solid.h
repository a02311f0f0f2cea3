#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>

#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "convex_piece.h"

namespace concave_distance::detail {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPoint = ExactKernel::Point_3;
using ExactPolyhedron = CGAL::Polyhedron_3<ExactKernel>;

/// One shell of a closed surface as CGAL has it. @throws Error (naming `where`) when it is no orientable
/// two-manifold or crosses itself
ExactPolyhedron exactShell(const SurfaceMesh& mesh, const std::vector<TriangleIndex>& triangles,
                           const std::string& where);

/// A convex polyhedron rounded to doubles: coplanar facets become one, corners in the middle of an edge go,
/// half-spaces keep the exact directions. Fewer than four facets are left of a sliver that is thinner than
/// doubles can say: then `piece` is not touched and false returned.
bool roundedPiece(const ExactPolyhedron& polyhedron, const std::string& where, ConvexPiece& piece);

}  // namespace concave_distance::detail
