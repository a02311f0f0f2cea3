#include "concave_distance/ros/node_limits.h"
#include "concave_distance/ros/parameter_reader.h"

namespace concave_distance {

NodeLimits readLimits(ParameterReader& parameters) {
  ParameterReader reader = parameters.group("limits");
  NodeLimits limits;
  limits.service_threads = reader.count("service_threads", limits.service_threads, 1, 64);
  limits.service_queue = reader.count("service_queue", limits.service_queue, 0, 1000);
  limits.query_seconds = reader.number("query_seconds", limits.query_seconds, 1e-3, 3600.0);
  limits.query_memory_mb = reader.count("query_memory_mb", limits.query_memory_mb, 1, 1'000'000);
  limits.largest_query_count = reader.count("largest_query_count", limits.largest_query_count, 1, 1'000'000);
  limits.largest_body_count = reader.count("largest_body_count", limits.largest_body_count, 1, 1'000'000);
  limits.largest_pair_count = reader.count("largest_pair_count", limits.largest_pair_count, 1, 10'000'000);
  limits.largest_triangle_count =
      reader.count("largest_triangle_count", limits.largest_triangle_count, 1, 100'000'000);
  limits.largest_node_count = reader.count("largest_node_count", limits.largest_node_count, 10, 10'000'000);
  limits.import_memory_mb = reader.count("import_memory_mb", limits.import_memory_mb, 64, 1'000'000);
  limits.import_seconds = reader.number("import_seconds", limits.import_seconds, 0.1, 3600.0);
  parameters.adoptUnread(reader, "limits/");
  return limits;
}

}  // namespace concave_distance
