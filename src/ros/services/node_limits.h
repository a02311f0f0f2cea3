#pragma once

#include <cstdint>

namespace concave_distance {

/// The most that requests may cost: the private parameters below `~limits/` (doc/parameters.md).
struct NodeLimits {
  std::uint32_t service_threads = 2;  ///< requests of get_distance, get_distances and add_body at one time
  std::uint32_t service_queue = 8;    ///< further ones that wait; the next is refused
  double query_seconds = 10.0;        ///< for one call of get_distance or get_distances
  std::uint32_t largest_query_count = 10'000;     ///< in one call of get_distances
  std::uint32_t largest_niche_count = 1'000'000;  ///< of all answers of such a call, and of their contacts
  double clearance_seconds = 60.0;                ///< for one call of get_clearance
  std::uint32_t largest_waypoint_count = 10'000;  ///< of its motion
  std::uint32_t largest_body_count = 20'000;
  std::uint32_t largest_pair_count = 50'000;
  std::uint32_t largest_triangle_count = 5'000'000;  ///< of one body
  std::uint32_t largest_node_count = 200'000;        ///< of one body's search grid
  std::uint32_t import_memory_mb = 1024;             ///< of the process that reads one mesh file
  double import_seconds = 30.0;                      ///< for one mesh file
};

}  // namespace concave_distance
