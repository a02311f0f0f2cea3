#include "read_mesh.h"

#include <utility>

#include "concave_distance/base/error.h"
#include "mesh_readers.h"

namespace concave_distance::detail {
namespace {

TriangleSoup readFile(std::string_view content, const std::string& path, const std::string& extension,
                      std::uint64_t most_triangles) {
  if (extension == ".stl") return readStl(content, path, most_triangles);
  if (extension == ".obj") return readObj(content, path, most_triangles);
  if (extension == ".ply") return readPly(content, path, most_triangles);
  if (extension == ".dae") return readDae(content, path, most_triangles);
  throw Error(path, "the ending '" + extension + "' is not that of a mesh file",
              "give an STL, OBJ, PLY or DAE file");
}

void applyScale(TriangleSoup& soup, const Eigen::Vector3d& scale, const std::string& path) {
  for (Eigen::Vector3d& vertex : soup.vertices) {
    vertex = vertex.cwiseProduct(scale);
    if (!vertex.allFinite())
      throw Error(path, "the scale is too large or not a number", "give a smaller scale");
  }
  if ((scale.array() < 0.0).count() % 2 == 0) return;
  for (auto& corners : soup.triangles) std::swap(corners[1], corners[2]);
}

}  // namespace

TriangleSoup readMesh(std::string_view content, const std::string& path, const std::string& extension,
                      const Eigen::Vector3d& scale, std::uint64_t most_triangles) {
  TriangleSoup soup = readFile(content, path, extension, most_triangles);
  if (soup.triangles.empty()) {
    throw Error(path, "the file has no triangle", "give a mesh with faces, not only points or lines");
  }
  applyScale(soup, scale, path);
  return soup;
}

}  // namespace concave_distance::detail
