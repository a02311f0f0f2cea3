#include "concave_distance/loading/load_body_mesh.h"

#include <utility>

#include "geometry_element.h"

namespace concave_distance {

LoadedBodyMesh loadBodyMesh(const std::string& path, double scale, const LoadMeshOptions& options) {
  detail::GeometryElement element;
  element.where = path;
  element.mesh_resource = path;
  element.scale = Eigen::Vector3d::Constant(scale);
  element.access.limits = options.limits;
  RepairedMesh repaired = detail::loadGeometry({element}, path).repaired;
  return {std::make_shared<const BodyMesh>(path, std::move(repaired.mesh), options.body), repaired.report};
}

}  // namespace concave_distance
