#pragma once

#include <iosfwd>

#include "mesh_tool_commands.h"

namespace concave_distance::tools {

/// The commands that need CGAL. Without it (CONCAVE_DISTANCE_WITH_CGAL off) all throw an Error that says so.
/// @throws Error naming the file
void hullOfMeshFile(const MeshToolOptions& options, std::ostream& out);
void partitionMeshFile(const MeshToolOptions& options, std::ostream& out);
void treeOfMeshFile(const MeshToolOptions& options, std::ostream& out);

}  // namespace concave_distance::tools
