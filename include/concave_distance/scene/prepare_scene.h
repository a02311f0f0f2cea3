#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace concave_distance {

/// Says how SceneTracker::prepare() works.
struct PreparationSettings {
  std::uint32_t threads = 0;  ///< that make parts of the bodies; 0: one per core
  /// Seconds; what has been begun by then is finished, some 0.1 s for a body of 10,000 triangles.
  double time_limit = std::numeric_limits<double>::infinity();
  /// Called after each piece of work, by one thread at a time; empty: nobody.
  std::function<void(std::size_t done, std::size_t count)> progress;
};

/// Counts what SceneTracker::prepare() has made and left.
struct PreparationCounts {
  std::size_t bodies = 0;        ///< meshes that it looked at
  std::size_t made = 0;          ///< of these the ones of which something was missing
  std::size_t left = 0;          ///< of these the ones that there was no time for
  std::size_t lists_left = 0;    ///< pairs whose niches there was no time for
  std::size_t memory_bytes = 0;  ///< by which the meshes have grown

  bool is_complete() const { return left == 0 && lists_left == 0; }
};

}  // namespace concave_distance
