#include "concave_distance/mesh/import/import_mesh.h"

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "import_process.h"
#include "mesh_file.h"

namespace concave_distance {
namespace {

void checkScale(const std::string& path, const Eigen::Vector3d& scale) {
  if (!scale.allFinite() || (scale.array() == 0.0).any()) {
    TextStream seen;
    seen << "the mesh scale is " << scale.x() << ' ' << scale.y() << ' ' << scale.z();
    throw Error(path, seen.str(), "give three finite factors other than zero");
  }
}

}  // namespace

TriangleSoup importMesh(const MeshFile& file, const Eigen::Vector3d& scale, const MeshImportLimits& limits) {
  checkScale(file.path(), scale);
  return detail::importInProcess(detail::importWorkerPath(), file, scale, limits);
}

TriangleSoup importMesh(const std::string& path, const Eigen::Vector3d& scale,
                        const MeshImportLimits& limits) {
  checkScale(path, scale);
  return importMesh(MeshFile(path), scale, limits);
}

void appendTransformed(TriangleSoup& body, const TriangleSoup& part,
                       const Eigen::Isometry3d& body_from_part) {
  const auto first = static_cast<std::uint32_t>(body.vertices.size());
  body.vertices.reserve(body.vertices.size() + part.vertices.size());
  body.triangles.reserve(body.triangles.size() + part.triangles.size());
  for (const Eigen::Vector3d& vertex : part.vertices) {
    body.vertices.push_back(body_from_part * vertex);
  }
  for (const auto& corners : part.triangles) {
    body.triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
  }
}

}  // namespace concave_distance
