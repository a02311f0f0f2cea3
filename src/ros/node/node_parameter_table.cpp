#include "node_parameter_table.h"

namespace concave_distance {
namespace {

using N = NodeParameters;
using L = NodeLimits;

ParameterTable<N> ofTheScene() {
  const std::vector<std::pair<std::string, GeometrySource>> geometries = {
      {"collision", GeometrySource::Collision}, {"visual", GeometrySource::Visual}};
  return {
      text<N>(
          "scene_file", "a path", [](auto& n) -> auto& { return n.scene_file; },
          "scene YAML ([scene_file](scene_file.md)); empty: only the robot in `robot_description`"),
      text<N>(
          "robot_description", "a name", [](auto& n) -> auto& { return n.robot_description; },
          "name of the parameter that holds the URDF, searched in the node's namespace and those above it "
          "(or the "
          "URDF itself, in `~`); empty: no robot. Without a scene file, the SRDF is read from the parameter "
          "of that "
          "name with `_semantic` appended, if there is one"),
      text<N>(
          "reference_frame", "a tf frame", [](auto& n) -> auto& { return n.reference_frame; },
          "frame of every output. Choose one that does not jump (`odom` rather than `map`): warm starts "
          "follow motion"),
      choice<N>(
          "geometry", geometries, [](auto& n) -> auto& { return n.geometry; },
          "which of the URDF's geometry"),
      text<N>(
          "mesh_search_path", "paths, separated by `:`", [](auto& n) -> auto& { return n.mesh_search_path; },
          "folders to search for meshes that are not found at their `package://` or relative path ([your own "
          "robot](your_own_robot.md#meshes-that-are-not-found)); a file means its folder and the three above "
          "it"),
      flag<N>(
          "skip_overlapping_pairs", [](auto& n) -> auto& { return n.skip_overlapping_pairs; },
          "for a robot without a scene file: leave out pairs of links that overlap in every pose tried, "
          "instead of "
          "only warning ([your own robot](your_own_robot.md#links-that-always-overlap))"),
      automatic<N>(
          "chord_error", [](auto& n) -> auto& { return n.chord_error; },
          "for a robot without a scene file: how far the mesh of a sphere, cylinder or capsule may be from "
          "its "
          "surface ([round bodies](scene_file.md#bodies)); `auto`: 1 % of the radius")
          .inUnit("m")
          .to(1e6),
      list<N>(
          "mesh_roots", "a list of texts", [](auto& n) -> auto& { return n.mesh_roots; },
          "where `add_body` and `apply_scene` may read mesh files: `package://` (every package), "
          "`package://<package>`, "
          "absolute "
          "folders; `[]`: nowhere; unset: every package and the scene file's folder ([who may do "
          "what](security.md#mesh-files))"),
      text<N>(
          "save_folder", "a path, or `off`", [](auto& n) -> auto& { return n.save_folder; },
          "folder below which `save_scene` may write; empty: that of the scene file"),
  };
}

ParameterTable<N> ofTheCycle() {
  return {
      number<N>(
          "rate", [](auto& n) -> auto& { return n.rate; }, "cycles per second, of ROS time")
          .from(0.1)
          .to(2000.0)
          .atRunTime(),
      optionalNumber<N>(
          "cycle_budget", "auto", [](auto& n) -> auto& { return n.cycle_budget; },
          "time from the start of a cycle after which niches and effects that are not finished are put off "
          "to "
          "later ones ([a cycle has an end](#a-cycle-has-an-end)), at most the period; 0: no end; `auto`: "
          "0.8 "
          "of the period")
          .inUnit("s")
          .to(10.0),
      count<N>(
          "threads", [](auto& n) -> auto& { return n.threads; },
          "threads that solve pairs, and long pairs together, in one cycle; 0: one per core (also the "
          "maximum), 1: serial")
          .to(1024.0),
      number<N>(
          "transform_timeout", [](auto& n) -> auto& { return n.transform_timeout; },
          "time that a service waits for a transform")
          .inUnit("s")
          .to(60.0),
      number<N>(
          "stale_after", [](auto& n) -> auto& { return n.stale_after; },
          "age at which transforms are too old to solve a pair")
          .inUnit("s")
          .from(1e-3)
          .to(1e6),
      number<N>(
          "tf_cache", [](auto& n) -> auto& { return n.tf_cache; },
          "time for which transforms are kept (how far back `stamp` of a query may be)")
          .inUnit("s")
          .from(0.1)
          .to(3600.0),
      number<N>(
          "tf_future_tolerance", [](auto& n) -> auto& { return n.tf_future_tolerance; },
          "time that the stamp of a transform may be ahead of this machine's clock; later ones are "
          "[refused](#transforms-that-are-refused)")
          .inUnit("s")
          .to(60.0),
      list<N>(
          "pair_topics", "a list of texts", [](auto& n) -> auto& { return n.pair_topics; },
          "pairs with their own topics (`pairs/<name>/...`): patterns of names with `*` (any characters) and "
          "`?` "
          "(one), e.g. `['gripper/*', 'arm/table']`; unset: every pair while the scene has at most 16"),
      number<N>(
          "constraint_distance", [](auto& n) -> auto& { return n.constraints.settings.distance; },
          "niches within this distance have a row in `constraints` ([rows for controllers](control.md)); "
          "pairs "
          "need a `cutoff` as large")
          .inUnit("m")
          .from(1e-6)
          .to(1e6),
      count<N>(
          "constraint_capacity", [](auto& n) -> auto& { return n.constraints.settings.capacity; },
          "slots of `constraints`: where there are more rows, the farthest have none")
          .from(1.0)
          .to(100000.0),
      number<N>(
          "constraint_tilt", [](auto& n) -> auto& { return n.constraints.settings.tilt; },
          "edges and faces tilted by less have a row in `constraints` for each of their corners, as if they "
          "were parallel")
          .inUnit("rad")
          .above(0.0)
          .to(0.5),
      flag<N>(
          "track_constraints", [](auto& n) -> auto& { return n.constraints.always; },
          "follow rows without subscribers too, so that they have their slots before a controller starts"),
      number<N>(
          "diagnostic_period", [](auto& n) -> auto& { return n.diagnostic_period; },
          "time between two diagnostics")
          .inUnit("s")
          .from(0.05)
          .to(3600.0),
  };
}

ParameterTable<N> ofTheMarkers() {
  return {
      flag<N>(
          "publish_markers", [](auto& n) -> auto& { return n.publish_markers; },
          "publish niche markers to subscribers")
          .atRunTime(),
      number<N>(
          "marker_rate", [](auto& n) -> auto& { return n.marker_rate; },
          "marker messages per second, at most `rate`")
          .from(0.1)
          .to(200.0)
          .atRunTime(),
      count<N>(
          "marker_pair_count", [](auto& n) -> auto& { return n.marker.pair_count; },
          "how many of the nearest pairs are drawn, besides every pair in warning; 0: all")
          .to(1e6),
      count<N>(
          "marker_niche_count", [](auto& n) -> auto& { return n.marker.niche_count; },
          "niches drawn in all of these pairs; the nearest one of each is always drawn; 0: all. As many "
          "contacts are labelled, the deepest first")
          .to(1e6),
      automatic<N>(
          "marker_scale", [](auto& n) -> auto& { return n.marker.scale; },
          "diameter of the nearest points; `auto`: from the size of the scene "
          "([markers](markers.md))")
          .inUnit("m")
          .to(1e6),
      number<N>(
          "marker_near", [](auto& n) -> auto& { return n.marker.near; }, "near end of the colour gradient")
          .inUnit("m")
          .to(1e6),
      automatic<N>(
          "marker_far", [](auto& n) -> auto& { return n.marker.far; },
          "far end, beyond `marker_near`; `auto`: from the size of the scene")
          .inUnit("m")
          .to(1e6),
  };
}

ParameterTable<N> ofTheDrawing() {
  return {
      flag<N>(
          "publish_contact_markers", [](auto& n) -> auto& { return n.publish_contact_markers; },
          "draw contacts too, of pairs with effects")
          .atRunTime(),
      number<N>(
          "force_marker_scale", [](auto& n) -> auto& { return n.marker.force_scale; },
          "force that an arrow of one metre represents")
          .inUnit("N")
          .from(1e-6)
          .to(1e12),
      automatic<N>(
          "pressure_marker_scale", [](auto& n) -> auto& { return n.marker.pressure_scale; },
          "pressure drawn in the last colour; `auto`: the largest of all contacts, rounded up "
          "([markers](markers.md#pressure))")
          .inUnit("Pa")
          .to(1e15),
      flag<N>(
          "show_bodies", [](auto& n) -> auto& { return n.show_bodies; }, "publish `body_markers`"),
      flag<N>(
          "show_collision", [](auto& n) -> auto& { return n.show_collision; },
          "add the collision geometry of robot links to `body_markers`, namespace `collision`"),
  };
}

}  // namespace

const ParameterTable<NodeParameters>& nodeParameterTable() {
  static const ParameterTable<N> table =
      joined<N>({ofTheScene(), ofTheCycle(), ofTheMarkers(), ofTheDrawing()});
  return table;
}

namespace {

ParameterTable<L> ofRequests() {
  return {
      count<L>(
          "service_threads", [](auto& l) -> auto& { return l.service_threads; },
          "calls of `get_distance`, `get_distances`, `add_body` and `apply_scene` that run at one time")
          .from(1.0)
          .to(64.0),
      count<L>(
          "service_queue", [](auto& l) -> auto& { return l.service_queue; },
          "further such calls that wait for a thread; the next one is refused at once (`SERVICE BUSY`)")
          .to(1000.0),
      number<L>(
          "query_seconds", [](auto& l) -> auto& { return l.query_seconds; },
          "time for one call of `get_distance` or `get_distances`, with waiting and all its queries; "
          "unfinished "
          "ones have the status `BUDGET_EXHAUSTED`")
          .inUnit("s")
          .from(1e-3)
          .to(3600.0),
      count<L>(
          "largest_query_count", [](auto& l) -> auto& { return l.largest_query_count; },
          "queries in one call of `get_distances`")
          .from(1.0)
          .to(1e6),
      count<L>(
          "largest_niche_count", [](auto& l) -> auto& { return l.largest_niche_count; },
          "niches and regions of contact in all answers of one call, in equal shares; an answer takes about "
          "1 kB of memory for each")
          .from(1.0)
          .to(1e8),
      number<L>(
          "clearance_seconds", [](auto& l) -> auto& { return l.clearance_seconds; },
          "time for one call of `get_clearance`; what is not proven by then has the status "
          "`BUDGET_EXHAUSTED`")
          .inUnit("s")
          .from(1e-3)
          .to(3600.0),
      count<L>(
          "largest_waypoint_count", [](auto& l) -> auto& { return l.largest_waypoint_count; },
          "waypoints of the motion in one call of `get_clearance`")
          .from(1.0)
          .to(1e6),
  };
}

ParameterTable<L> ofSizes() {
  return {
      count<L>(
          "largest_body_count", [](auto& l) -> auto& { return l.largest_body_count; }, "bodies of the scene")
          .from(1.0)
          .to(1e6),
      count<L>(
          "largest_pair_count", [](auto& l) -> auto& { return l.largest_pair_count; },
          "named pairs of the scene, and pairs by rule that are near at one time: what is more is cut, with "
          "a "
          "count (`pairs_cut`)")
          .from(1.0)
          .to(1e7),
      count<L>(
          "largest_triangle_count", [](auto& l) -> auto& { return l.largest_triangle_count; },
          "triangles of one body; making it ready takes about 1.5 kB of memory for each")
          .from(1.0)
          .to(1e8),
      count<L>(
          "largest_node_count", [](auto& l) -> auto& { return l.largest_node_count; },
          "nodes of one body's search grid, which `max_edge_length` makes finer")
          .from(10.0)
          .to(1e7),
      count<L>(
          "import_memory_mb", [](auto& l) -> auto& { return l.import_memory_mb; },
          "memory of the process that reads one mesh file; a million triangles take up to 700, two million "
          "up to "
          "1200 (as text STL)")
          .inUnit("MB")
          .from(64.0)
          .to(1e6),
      number<L>(
          "import_seconds", [](auto& l) -> auto& { return l.import_seconds; },
          "time for the same; two million triangles take 1 to 4 on an idle core")
          .inUnit("s")
          .from(0.1)
          .to(3600.0),
  };
}

}  // namespace

const ParameterTable<NodeLimits>& limitParameters() {
  static const ParameterTable<L> table = joined<L>({ofRequests(), ofSizes()});
  return table;
}

}  // namespace concave_distance
