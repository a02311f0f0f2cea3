#pragma once

#include <Eigen/Geometry>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"

namespace concave_distance::test {

inline std::string thesisFile(const std::string& name) {
  return std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/thesis/" + name;
}

/// Poses of B in A's frame from one of meshes/thesis/*.csv, in the file's order.
inline std::vector<Eigen::Isometry3d> readThesisPoses(const std::string& csv) {
  std::ifstream stream(thesisFile(csv));
  std::string line;
  std::getline(stream, line);
  std::vector<Eigen::Isometry3d> poses;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::vector<double> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(values[1], values[2], values[3]);
    pose.linear() =
        Eigen::Quaterniond(values[7], values[4], values[5], values[6]).normalized().toRotationMatrix();
    poses.push_back(pose);
  }
  if (poses.empty()) throw std::runtime_error("no poses in " + thesisFile(csv));
  return poses;
}

/// A body of meshes/thesis by name, on a grid of the given edge length (metres).
inline std::shared_ptr<const BodyMesh> loadThesisBody(const std::string& name, double max_edge_length) {
  const std::string path = thesisFile(name + ".stl");
  BodyMeshOptions options;
  options.max_edge_length = max_edge_length;
  return std::make_shared<const BodyMesh>(name, repairMesh(importMesh(path), {}, path).mesh, options);
}

struct ThesisScene {
  std::shared_ptr<const BodyMesh> a;
  std::shared_ptr<const BodyMesh> b;
  Eigen::Isometry3d a_from_b;
};

/// The scene of a poses file with one line: boxes_position_1 or _2, cylinder_position_1 or _2,
/// battery_static.
inline ThesisScene loadThesisScene(const std::string& name, double max_edge_length) {
  const char family = name.front();
  const std::string a = family == 'b' && name[1] == 'o' ? "box" : family == 'c' ? "semi_extruded" : "fixture";
  const std::string b = a == "box" ? "notched_box" : a == "fixture" ? "battery" : "grooved_cylinder";
  return {loadThesisBody(a, max_edge_length), loadThesisBody(b, max_edge_length),
          readThesisPoses(name + ".csv").front()};
}

}  // namespace concave_distance::test
