#pragma once

#include <atomic>
#include <cstddef>

namespace concave_distance {

/// Limits for reading one mesh file. The defaults allow scans of a million triangles in any format.
struct MeshImportLimits {
  std::size_t memory = 1'024'000'000;              ///< bytes of the process that reads the file
  double seconds = 30.0;                           ///< of wall time, and of processor time
  std::size_t largest_triangle_count = 5'000'000;  ///< with every instance of a mesh counted
  const std::atomic<bool>* stop = nullptr;         ///< ends the import when it becomes true; nullptr: none
};

}  // namespace concave_distance
