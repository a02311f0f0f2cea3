#pragma once

#include <memory>
#include <string>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/import/mesh_import_limits.h"
#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance {

struct LoadMeshOptions {
  BodyMeshOptions body;     ///< search grid
  MeshImportLimits limits;  ///< of reading the file
};

struct LoadedBodyMesh {
  std::shared_ptr<const BodyMesh> mesh;
  RepairReport repair;  ///< what was found and changed
};

/// Reads a mesh file (importMesh), repairs it (repairMesh) and makes it ready for queries, as the node and
/// the tools do.
/// @param path of a file; its name is the body's
/// @param scale factor on the file's coordinates: 0.001 for millimetres
/// @throws Error naming the file, as the functions above
[[nodiscard]] LoadedBodyMesh loadBodyMesh(const std::string& path, double scale = 1.0,
                                          const LoadMeshOptions& options = {});

}  // namespace concave_distance
