#pragma once

#include <memory>
#include <string>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance {

/// @throws Error naming `where` and the body that is null
inline void requireBodies(const std::string& where, const std::shared_ptr<const BodyMesh>& a,
                          const std::shared_ptr<const BodyMesh>& b) {
  if (a && b) return;
  throw Error(where, std::string("body ") + (a ? "B" : "A") + " is null",
              "give a body that was loaded or made");
}

}  // namespace concave_distance
