#pragma once

#include <memory>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance::python {

/// Python has this as BodyMesh.
struct PythonBody {
  std::shared_ptr<const BodyMesh> mesh;
  RepairReport repair;
};

}  // namespace concave_distance::python
