#include "body_key.h"

namespace concave_distance {

ContentKey surfaceKey(const SurfaceMesh& surface) {
  const auto& vertices = surface.vertices();
  const auto& triangles = surface.triangles();
  return ContentHasher()
      .addBytes(vertices.data(), vertices.size() * sizeof(vertices[0]))
      .addBytes(triangles.data(), triangles.size() * sizeof(triangles[0]))
      .key();
}

ContentKey bodyKey(const ContentKey& surface_key, const BodyMeshOptions& options) {
  ContentHasher hasher;
  hasher.add(surface_key)
      .add(options.max_edge_length.has_value())
      .add(options.max_edge_length.value_or(0.0))
      .add(options.search_node_limit);
  if (!options.shape) return hasher.key();
  const RoundShape& shape = *options.shape;
  hasher.add(shape.kind).add(shape.radius).add(shape.half_length).add(shape.chord_error);
  for (int i = 0; i < 16; ++i) hasher.add(shape.body_from_shape.data()[i]);
  return hasher.key();
}

}  // namespace concave_distance
