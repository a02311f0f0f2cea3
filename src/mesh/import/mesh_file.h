#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/content_hash.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"

namespace concave_distance {

/// A mesh file opened for reading. Only a regular file is opened, never a FIFO, a device or a socket. Later
/// reads come from this file, even if another one replaces it at its path.
class MeshFile {
 public:
  /// @param folders real paths (no symbolic links); the file that was opened must lie below one of them.
  ///        Empty: it may lie anywhere.
  /// @throws Error naming the path when it is missing, not a regular file, empty, not readable or not below
  ///         `folders`
  explicit MeshFile(std::string path, const std::vector<std::string>& folders = {});
  MeshFile(MeshFile&& other) noexcept;
  MeshFile& operator=(MeshFile&& other) = delete;
  ~MeshFile();

  const std::string& path() const { return path_; }
  /// The file name's ending with its dot, in lower case.
  const std::string& extension() const { return extension_; }
  /// Size in bytes when it was opened.
  std::uint64_t size() const { return size_; }
  /// Descriptor of the operating system; belongs to this object.
  int descriptor() const { return descriptor_; }

 private:
  std::string path_;
  std::string extension_;
  std::uint64_t size_ = 0;
  int descriptor_ = -1;
};

/// Adds the file's bytes and its ending to the hash of a body. False when it cannot be read completely or
/// exceeds `limits`: then it has no key. Uses constant memory.
bool addMeshFile(ContentHasher& hasher, const MeshFile& file, const MeshImportLimits& limits);

/// Imports an opened file as importMesh() does a path.
TriangleSoup importMesh(const MeshFile& file, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones(),
                        const MeshImportLimits& limits = {});

/// The error for every file outside the allowed folders. It does not reveal what is there.
Error outsideOfMeshFolders(const std::string& name);

/// True when `path` is `folder` or lies below it, both absolute and without . and ..
bool isBelow(const std::string& path, const std::string& folder);

}  // namespace concave_distance
