#pragma once

#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/resource_locator.h"
#include "concave_distance/mesh/import/mesh_import_limits.h"

namespace concave_distance {

/// Says where a request may read mesh files: named as `package://<package>`/..., or below a folder.
struct MeshRoots {
  bool every_package = false;
  std::vector<std::string> packages;
  std::vector<std::string> folders;  ///< absolute; one that does not exist (yet) holds nothing
};

/// @param entries `package://` (every package), `package://<package>`, or an absolute folder
/// @param where names the list in errors
/// @throws Error for any other entry
MeshRoots parseMeshRoots(const std::vector<std::string>& entries, const std::string& where);

/// Says which mesh files may be read, and the limits for it.
struct MeshAccess {
  MeshImportLimits limits;
  std::optional<MeshRoots> roots;  ///< nothing: any file
};

struct LocatedMesh {
  std::string path;
  std::vector<std::string> real_folders;  ///< for MeshFile: the file is below one of them
};

/// Finds a mesh file below the roots, with symbolic links resolved. Every other path gives the same error,
/// outsideOfMeshFolders(), and most are not looked up, so that nothing about them is revealed.
/// @throws Error that error, or, below the roots, as locateResource
LocatedMesh locateMeshBelow(const std::string& resource, const MeshRoots& roots,
                            const PackageLocator& package_locator);

}  // namespace concave_distance
