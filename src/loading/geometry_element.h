#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/content_hash.h"
#include "concave_distance/loading/mesh_roots.h"
#include "concave_distance/loading/resource_locator.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/round_shape.h"
#include "mesh_search.h"

namespace concave_distance::detail {

/// One shape of a body: a collision or visual element of a URDF link, or a scene file's body.
struct GeometryElement {
  std::string where;                                ///< what messages call it
  std::string mesh_resource;                        ///< either this ...
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of the mesh
  std::string primitive;                            ///< ... or the name of one of primitives() ...
  std::shared_ptr<const TriangleSoup> triangles;    ///< ... or these, metres
  std::vector<double> dimensions;                   ///< as BodyDescription::dimensions, metres
  std::optional<double> chord_error;                ///< metres; empty: 1 % of the radius
  Eigen::Isometry3d frame_from_geometry = Eigen::Isometry3d::Identity();
  MeshAccess access;                      ///< of the mesh
  std::vector<std::string> real_folders;  ///< the file must be below one of them; empty: anywhere
};

/// Replaces the element's resource by a path of this machine; one without is not changed.
/// @return the folder of the search path where it was found; empty: none was needed
/// @throws Error as searchMesh, naming the element too
std::string locateGeometry(GeometryElement& element, const MeshFolders& folders,
                           const PackageLocator& package_locator);

/// A repaired surface with the key of the very files it was made from.
struct KeyedMesh {
  RepairedMesh repaired;
  std::optional<ContentKey> key;  ///< nothing: it has none
};

/// Loads located elements and merges them into one repaired surface in the body's frame; slits of
/// single precision are welded (kSinglePrecisionWeld), so that what is meant to be closed is.
/// @return with the geometryKey() of the very files that were read
/// @throws Error naming the element at fault: nothing of the body is served rather than a part of it
KeyedMesh loadGeometry(const std::vector<GeometryElement>& elements, const std::string& where);

/// Returns a key for all that loadGeometry() makes the surface from; nothing where a file does not tell it.
/// @throws Error for a file that cannot be read, and for an element with none or two shapes
std::optional<ContentKey> geometryKey(const std::vector<GeometryElement>& elements);

/// The solid of a body that is one round primitive, body frame; nothing for any other.
std::optional<RoundShape> roundShapeOf(const std::vector<GeometryElement>& elements);

/// One line for each element whose round surface became a mesh, with its chord error. May be empty.
std::string describeApproximations(const std::vector<GeometryElement>& elements);

}  // namespace concave_distance::detail
