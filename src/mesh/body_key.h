#pragma once

#include "base/content_hash.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

/// Stands for the surface.
ContentKey surfaceKey(const SurfaceMesh& surface);

/// Stands for everything that a body's answers depend on: bodies with the same key differ only in their
/// names.
ContentKey bodyKey(const ContentKey& surface_key, const BodyMeshOptions& options);

}  // namespace concave_distance
