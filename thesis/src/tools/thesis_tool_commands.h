#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance::tools {

struct ThesisToolOptions {
  std::string input;
  std::string output;
  RepairOptions repair;
  std::size_t reflex_edge_limit = 1500;
  double flatness = 1e-6;  ///< of a tree, relative to the bounding box's diagonal
  std::string pieces;      ///< a tree's convex pieces as .obj; empty: not written
};

/// Reads `input` and repairs it. @throws Error naming the file
SurfaceMesh readRepaired(const ThesisToolOptions& options);

/// Each reads `input`, writes `output` and prints what it found to `out`. @throws Error naming the file
void writeHull(const ThesisToolOptions& options, std::ostream& out);
void writePartition(const ThesisToolOptions& options, std::ostream& out);
void writeTree(const ThesisToolOptions& options, std::ostream& out);

}  // namespace concave_distance::tools
