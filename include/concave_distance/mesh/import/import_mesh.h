#pragma once

#include <Eigen/Geometry>
#include <string>

#include "concave_distance/mesh/import/mesh_import_limits.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// Reads every mesh of a file (binary or ASCII STL, OBJ, PLY or DAE, by the file name's ending) into one
/// soup, in metres and in the frame that rviz 1.14 draws the file in: with the transforms of its nodes, a
/// DAE's `<unit>` applied and its `<up_axis>` ignored (assimp would turn y up). STL, OBJ and PLY state no
/// unit: their numbers are metres. All their digits are kept; those of a DAE pass through assimp's single
/// precision: 6e-8 of their size.
///
/// Polygons are cut into triangles, concave ones too, without new vertices. Their corners need not be in one
/// plane. What is thinner than kSinglePrecisionWeld of the mesh's diagonal may be turned over by rounding; a
/// border that crosses itself by more is refused.
///
/// A separate process, mesh_import_worker, reads the file within `limits`. It opens no other file (materials,
/// textures), and a crash there becomes an error here. Starting it takes some milliseconds.
/// @param scale the URDF's mesh scale, a factor per axis. Where it or a node's transform mirrors, the winding
///        is turned, so that normals keep pointing outwards.
/// @throws Error naming the file, and in it the line or element, when it is missing, empty or unreadable, or
///         breaks off (an OBJ cut between two lines shows no sign of it); when it has no triangle, a
///         coordinate that is not finite, a polygon that crosses itself or faces of a kind that is not read;
///         when reading it exceeds the limits or crashes; when the scale is zero or not finite; when the
///         worker cannot be started
TriangleSoup importMesh(const std::string& path, const Eigen::Vector3d& scale = Eigen::Vector3d::Ones(),
                        const MeshImportLimits& limits = {});

/// Appends `part`, transformed, to `body`: several collision elements of a link become one body.
void appendTransformed(TriangleSoup& body, const TriangleSoup& part, const Eigen::Isometry3d& body_from_part);

}  // namespace concave_distance
