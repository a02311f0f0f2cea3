#include "fuzz/reproducer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance::test {
namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text;
  if (!stream) throw Error(path, "the file cannot be written", "check the folder and its permissions");
}

std::array<std::array<double, 3>, 3> sortedCorners(const SurfaceMesh& mesh, std::size_t triangle) {
  std::array<std::array<double, 3>, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d& corner = mesh.corner(TriangleIndex{triangle}, static_cast<int>(k));
    corners[k] = {corner.x(), corner.y(), corner.z()};
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Whether the file brings the very triangles back that were tried, perhaps turned.
bool bringsBack(const std::string& path, const SurfaceMesh& mesh) {
  const SurfaceMesh again = repairMesh(importMesh(path), {}, path).mesh;
  if (again.triangleCount() != mesh.triangleCount()) return false;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (sortedCorners(again, t) != sortedCorners(mesh, t)) return false;
  }
  return true;
}

}  // namespace

std::string writeReproducer(const DifferentialScene& scene, std::uint64_t seed, const std::string& report,
                            const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::string mark = "_" + std::to_string(seed);
  const std::string mesh_a = folder + "/a" + mark + ".stl";
  const std::string mesh_b = folder + "/b" + mark + ".stl";
  const std::string poses = folder + "/poses" + mark + ".csv";
  exportMesh(scene.a, mesh_a);
  exportMesh(scene.b, mesh_b);
  std::ostringstream line;
  line.precision(17);
  line << "t,x,y,z,qx,qy,qz,qw\n0";
  for (Eigen::Index i = 0; i < 3; ++i) line << ',' << scene.b_in_a.translation[i];
  for (Eigen::Index i = 0; i < 4; ++i) line << ',' << scene.b_in_a.quaternion[i];
  line << '\n';
  write(poses, line.str());
  const std::string command = "distance_query --accuracy certified --mesh-a " + mesh_a + " --mesh-b " +
                              mesh_b + " --poses " + poses + " --output " + folder + "/answer" + mark +
                              ".csv";
  const bool same = bringsBack(mesh_a, scene.a) && bringsBack(mesh_b, scene.b);
  write(folder + "/report" + mark + ".txt",
        scene.description + "\n" + report + "\n" + command + "\n" +
            (same ? ""
                  : "The files are repaired to other triangles than were tried: use --first " +
                        std::to_string(seed) + " --count 1 instead.\n"));
  return command;
}

}  // namespace concave_distance::test
