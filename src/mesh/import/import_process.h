#pragma once

#include <Eigen/Core>
#include <string>

#include "concave_distance/mesh/import/mesh_import_limits.h"
#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh_file.h"

namespace concave_distance::detail {

/// Path of mesh_import_worker: the environment variable CONCAVE_DISTANCE_IMPORT_WORKER, else the program in
/// the folder concave_distance/ beside this library, where it is built and installed.
std::string importWorkerPath();

/// Starts the worker for one file and reads its answer without trusting it: counts are checked before memory
/// is reserved, then every index and number. The process has ended when this returns or throws. It leaves no
/// zombie and no descriptor, however this program handles SIGCHLD.
/// @throws Error as importMesh
TriangleSoup importInProcess(const std::string& worker_path, const MeshFile& file,
                             const Eigen::Vector3d& scale, const MeshImportLimits& wanted);

}  // namespace concave_distance::detail
