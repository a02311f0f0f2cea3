#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

struct FaceNames {
  std::string kind;               ///< "line" or "face", before its number
  std::string of = {};            ///< after it, as " of mesh 'door'"
  std::int64_t first_vertex = 0;  ///< number of the first vertex in this format
};

/// The faces of a file as its reader finds them: triangles, and polygons that are still to be cut. Faces may
/// come before their vertices, which are counted from 0.
class FileMesh {
 public:
  explicit FileMesh(FaceNames names) : names_(std::move(names)) {}

  std::vector<Eigen::Vector3d>& vertices() { return soup_.vertices; }

  /// Points and lines (fewer than three corners) have no surface and are passed over.
  /// @param number what errors name the face by
  void addFace(const std::vector<std::int64_t>& corners, std::uint64_t number);

  /// All triangles, those of polygons last.
  /// @throws Error naming the file and the face, for a corner that is no vertex, a vertex that is not finite
  ///         or beyond 1e60, a polygon that crosses itself, or more than `most_triangles`
  TriangleSoup takeTriangles(const std::string& path, std::uint64_t most_triangles);

 private:
  struct Polygon {
    std::size_t end;  ///< of its corners
    std::uint64_t number;
  };
  struct NotedCorner {
    std::int64_t vertex;
    std::uint64_t number;  ///< of the face
  };

  void checkCorners(const std::string& path) const;
  void cutPolygons(const std::string& path);

  TriangleSoup soup_;
  std::vector<std::uint32_t> polygon_corners_;
  std::vector<Polygon> polygons_;
  NotedCorner least_{0, 0};
  NotedCorner largest_{-1, 0};
  FaceNames names_;
};

/// @throws Error when there are more triangles than allowed
void checkTriangleCount(std::uint64_t count, std::uint64_t most_triangles, const std::string& path);
/// @throws Error naming the first vertex with a coordinate that is not finite or beyond 1e60
void checkVertices(const std::vector<Eigen::Vector3d>& vertices, const FaceNames& names,
                   const std::string& path);
Eigen::AlignedBox3d boxOf(const std::vector<Eigen::Vector3d>& vertices);
/// Refuses small bodies far from the origin of a file of single precision, whose seven digits do not hold
/// their shape. The largest of the meshes' boxes counts.
/// @throws Error with the sizes
void checkSinglePrecision(const std::vector<Eigen::AlignedBox3d>& meshes, const std::string& path);

}  // namespace concave_distance::detail
