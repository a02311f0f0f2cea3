#pragma once

#include <cstdint>

namespace concave_distance::detail {

// Format of the result pipe of mesh_import_worker: this header, then the body that it announces, in the byte
// order of this machine. The worker reads the mesh file from kMeshDescriptor.

/// Changes with the format, so that a worker of another version is detected.
inline constexpr std::uint64_t kImportMagic = 0x31306d695f64632eULL;
inline constexpr int kMeshDescriptor = 3;
inline constexpr int kResultDescriptor = 4;

enum class ImportStatus : std::uint32_t {
  Read = 1,         ///< first: vertices, second: triangles; 3 doubles each, then 3 std::uint32_t each
  Refused = 2,      ///< first and second: bytes of two texts, what is wrong and the remedy
  OutOfMemory = 3,  ///< no body; first: bytes of the last block requested, or 0
};

struct ImportHeader {
  std::uint64_t magic = kImportMagic;
  ImportStatus status = ImportStatus::Refused;
  std::uint32_t unused = 0;
  std::uint64_t first = 0;
  std::uint64_t second = 0;
};
static_assert(sizeof(ImportHeader) == 32);

inline constexpr std::uint64_t kLongestImportText = 4096;

}  // namespace concave_distance::detail
