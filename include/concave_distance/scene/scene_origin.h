#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/contact/material.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// These structs hold what a scene was made from, as files and services name it: enough to make it again.

enum class GeometrySource : std::uint8_t { Collision, Visual };

/// One shape of a body.
struct BodyShape {
  std::string mesh_resource;  ///< either this ...
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  std::string primitive;           ///< ... or a primitive's name with its `dimensions`
  std::vector<double> dimensions;  ///< metres, in the order of srv/AddBody.srv
  Eigen::Isometry3d frame_from_geometry = Eigen::Isometry3d::Identity();
  std::shared_ptr<const TriangleSoup> triangles;  ///< ... or these, metres
};

/// Says what a body was made from: a link of a robot, or shapes.
struct BodyOrigin {
  std::string link;       ///< as the URDF names it; empty: no link
  std::size_t robot = 0;  ///< of a link: place in Scene::robots
  std::vector<BodyShape> shapes;
  std::string base_folder;                ///< where relative paths start; empty: there are none
  std::optional<double> max_edge_length;  ///< metres; empty: automatic
  std::optional<double> chord_error;      ///< metres; empty: 1 % of each radius
};

/// A robot as a scene file names it.
struct SceneRobot {
  std::string name;                  ///< of its group; empty: `<prefix><name in the URDF>`
  std::string description;           ///< parameter with the URDF, or empty and
  std::string urdf;                  ///< ... the file
  std::string semantic_description;  ///< parameter with the SRDF, or
  std::string srdf;                  ///< ... the file, or neither
  std::string base_folder;           ///< where relative paths start
  std::string prefix;                ///< put before link names, in bodies and frames
  GeometrySource geometry = GeometrySource::Collision;
  std::vector<std::string> skip_links;  ///< names and patterns
  std::vector<std::string> links;       ///< that became bodies, as the URDF names them
  double margin = 0.0;                  ///< metres, of each link
  std::optional<double> max_edge_length;
  std::optional<double> chord_error;
  Material material;
};

}  // namespace concave_distance
