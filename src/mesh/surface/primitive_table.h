#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/round_shape.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// A primitive as scene files and messages give it. All that they need to know of one is its row in
/// primitives(): a new primitive is a function in primitives.h and a row. A URDF has only those that urdfdom
/// reads (toElement() in loading/robot_description.cpp).
struct Primitive {
  /// A key below the primitive's in a scene file.
  struct Size {
    const char* key;
    std::size_t count;  ///< numbers that it takes, metres
  };

  const char* name;
  std::vector<Size> sizes;  ///< their numbers, one after the other, are the primitive's dimensions
  bool is_curved;           ///< its mesh is inscribed, within a chord error
  std::optional<RoundKind> round_kind;  ///< the solid that distances are exact for; radius and length
  /// @param d dimensions, as many as `sizes` say @param chord_error metres, for a curved one
  SurfaceMesh (*make)(const std::vector<double>& d, double chord_error, const std::string& where);

  std::size_t dimensionCount() const;
};

const std::vector<Primitive>& primitives();

/// Returns nullptr for a name that no primitive has.
const Primitive* findPrimitive(const std::string& name);
const Primitive& primitiveOf(RoundKind kind);

/// Returns "box, sphere, cylinder": the names with commas, `last` before the last one.
std::string primitiveNames(const std::string& last = ", ");

}  // namespace concave_distance::detail
