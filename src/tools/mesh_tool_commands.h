#pragma once

#include <Eigen/Core>
#include <iosfwd>
#include <string>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/repair/merge_flat_triangles.h"

namespace concave_distance::tools {

struct MeshToolOptions {
  std::string input;
  std::string output;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  double weld_tolerance = kSinglePrecisionWeld;  ///< relative to the bounding box's diagonal
  bool orient = true;                            ///< turn triangles that disagree
  double max_edge_length = 0.0;                  ///< metres
  double merge_tolerance = kMergeTolerance;      ///< relative to the bounding box's diagonal
};

/// Each reads `input`, writes `output` (but for inspect) and prints what it found to `out`.
/// @throws Error naming the file
void inspectMeshFile(const MeshToolOptions& options, std::ostream& out);
void repairMeshFile(const MeshToolOptions& options, std::ostream& out);
void refineMeshFile(const MeshToolOptions& options, std::ostream& out);
void simplifyMeshFile(const MeshToolOptions& options, std::ostream& out);
void convertMeshFile(const MeshToolOptions& options, std::ostream& out);

}  // namespace concave_distance::tools
