#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene.h"
#include "ros/markers/marker_style.h"
#include "ros/services/node_limits.h"
#include "ros/topics/constraint_topic.h"

namespace concave_distance {

/// Every private parameter of the node, validated (doc/parameters.md). SI units.
struct NodeParameters {
  std::string scene_file;                               ///< empty: none
  std::string robot_description = "robot_description";  ///< name of the parameter with the URDF; empty: none
  std::string reference_frame = "world";                ///< tf frame of every output; a continuous one
  GeometrySource geometry = GeometrySource::Collision;
  std::string mesh_search_path;                  ///< folders, separated by `:`
  std::vector<std::string> mesh_search_folders;  ///< the same; as in SceneLoadOptions, so are the next two
  bool automatic_cutoff = false;                 ///< a robot without scene file, and `cutoff` is not set
  bool skip_overlapping_pairs = false;
  double chord_error = 0.0;  ///< m, of a robot without scene file; 0: 1 % of the radius
  std::string save_folder;   ///< save_scene writes below it; empty: nowhere
  /// Services may read mesh files below these; no value: every package and the scene file's folder.
  std::optional<std::vector<std::string>> mesh_roots;
  MeshAccess mesh_access;  ///< of bodies that services add, from the former and the limits
  double rate = 50.0;      ///< cycles per second
  /// Seconds from the start of a cycle after which niches are left for later ones; 0: no end, no value: the
  /// usual share of the period.
  std::optional<double> cycle_budget;
  double marker_rate = 20.0;         ///< marker messages per second, at most `rate`
  std::uint32_t threads = 0;         ///< that solve pairs in one cycle; 0: one per core
  double transform_timeout = 0.2;    ///< s that a service waits for a transform
  double stale_after = 1.0;          ///< s, age of the newest common transform at which a pair is not solved
  double tf_cache = 10.0;            ///< s, of transforms kept
  double tf_future_tolerance = 1.0;  ///< s that a transform's stamp may be ahead of the clock
  PairSettings pair;                 ///< for pairs and settings that no scene file sets
  bool publish_markers = true;
  bool publish_contact_markers = true;
  bool show_bodies = true;
  bool show_collision = false;
  /// Patterns of the pairs with their own topics; nothing: every pair of a small scene.
  std::optional<std::vector<std::string>> pair_topics;
  MarkerStyle marker;
  ConstraintOptions constraints;
  double diagnostic_period = 1.0;  ///< s
  NodeLimits limits;
};

/// Returns the seconds that a cycle at this rate (Hz) may take: infinite without an end.
/// @throws Error for a budget longer than the period
double cycleBudget(const std::optional<double>& budget, double rate);

/// @param values the node's private namespace as a struct, as ros::NodeHandle::getParam("") gives it; an
///        invalid value (nothing set) counts as empty
/// @param unknown receives the names in `values` that are no parameter of this node: spelling mistakes
/// @throws Error naming the parameter, the value seen and what is allowed
NodeParameters parseNodeParameters(const XmlRpc::XmlRpcValue& values, std::vector<std::string>& unknown);

}  // namespace concave_distance
