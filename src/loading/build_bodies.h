#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/scene_limits.h"
#include "geometry_element.h"

namespace concave_distance::detail {

/// A body still to be loaded: what is known of it before its mesh, and where that comes from.
struct BodySource : SceneBody {
  std::vector<GeometryElement> geometry;
  std::string base_folder;  ///< where relative paths start; empty: none are allowed
  std::optional<double> max_edge_length;
  std::string problem;  ///< known already: the body is not tried
};

struct BuiltBody {
  std::optional<SceneBody> body;  ///< nothing when there is a problem
  std::string problem;
  std::vector<std::string> notes;
};

struct BuildOptions {
  PackageLocator package_locator;
  std::vector<std::string> mesh_search_path;
  std::shared_ptr<BodyPool> pool;    ///< not nullptr
  SceneLimits limits;                ///< only those of one body apply
  LoadProgress* progress = nullptr;  ///< nullptr: none
};

/// Loads all bodies, in parallel; one result per source, in their order, the same for any number of threads.
/// Never throws for a body: its problem says what is wrong.
std::vector<BuiltBody> buildBodies(std::vector<BodySource> sources, const BuildOptions& options);

}  // namespace concave_distance::detail
