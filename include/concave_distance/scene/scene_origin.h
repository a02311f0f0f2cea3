#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

namespace detail {
struct SceneOperation;
}

/// Operations that were applied to a scene, in their order. One that a later one makes void is not there.
using SceneJournal = std::vector<std::shared_ptr<const detail::SceneOperation>>;

/// These structs hold what a scene was made from, as files and services name it: enough to make it again.

/// The scene file as it was loaded.
struct SceneText {
  std::string text;         ///< up to its operations
  std::string folder;       ///< where relative paths in the text start
  SceneJournal operations;  ///< those of the file
};

/// One shape of a body.
struct BodyShape {
  std::string mesh_resource;  ///< either this ...
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  std::string primitive;           ///< ... or a primitive's name with its `dimensions`
  std::vector<double> dimensions;  ///< metres, in the order of srv/AddBody.srv
  Eigen::Isometry3d frame_from_geometry = Eigen::Isometry3d::Identity();
  std::shared_ptr<const TriangleSoup> triangles;  ///< ... or these, metres
};

/// Says which shapes a body was made from that is no link of a robot.
struct BodyOrigin {
  std::vector<BodyShape> shapes;
  std::string base_folder;                ///< where relative paths start; empty: there are none
  std::optional<double> max_edge_length;  ///< metres; empty: automatic
  std::optional<double> chord_error;      ///< metres; empty: 1 % of each radius
};

}  // namespace concave_distance
