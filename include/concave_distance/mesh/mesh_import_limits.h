#pragma once

#include <atomic>
#include <cstddef>

namespace concave_distance {

/// What reading one mesh file may cost. The defaults let scans of two million triangles pass.
struct MeshImportLimits {
  std::size_t memory = 1'024'000'000;              ///< bytes of the process that reads the file
  double seconds = 30.0;                           ///< by the wall clock, and of processor time
  std::size_t largest_triangle_count = 5'000'000;  ///< with every instance of a mesh counted
  const std::atomic<bool>* stop = nullptr;         ///< ends the import when it becomes true; nullptr: none
};

}  // namespace concave_distance
