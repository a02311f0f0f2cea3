#include "bag_options.h"

#include "bag_report.h"
#include "base/number_text.h"
#include "base/output_file.h"
#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "ros/node/node_parameter_table.h"
#include "scene/name_pattern.h"
#include "scene/pair_parameters.h"
#include "tools/parameter_options.h"
#include "tools/scene_options.h"

namespace concave_distance {
namespace {

void addSceneOptions(CLI::App& app, BagOptions& options) {
  app.add_option("--scene", options.node.scene_file, "scene file; without one, the robot alone")
      ->type_name("FILE");
  app.add_option("--robot-description", options.robot_description,
                 "URDF of the parameter robot_description: of the scene's robot, or of the robot alone")
      ->type_name("FILE");
  tools::addDescriptionOption(app, options.descriptions, "URDF or SRDF of another parameter");
  app.add_option("--mesh-search-path", options.node.mesh_search_folders,
                 "folder to search for meshes that are not found; once for each")
      ->type_name("DIR");
  for (const char* parameter : {"reference_frame", "geometry", "skip_overlapping_pairs", "stale_after",
                                "tf_cache", "tf_future_tolerance", "threads"}) {
    tools::addParameter(app, nodeParameterTable(), parameter, options.node);
  }
  for (const Parameter<PairSettings>& parameter : pairParameters()) {
    if (parameter.info.is_expert || parameter.info.name == "time_budget") continue;
    tools::addParameter(app, parameter, options.node.pair);
  }
}

}  // namespace

void addBagOptions(CLI::App& app, BagOptions& options) {
  app.add_option("--bag", options.bags.paths, "bag; several are played as one, as by rosbag play")
      ->required()
      ->type_name("FILE");
  app.add_option("--start", options.bags.start, "seconds after the begin of the bags")->type_name("S");
  app.add_option("--duration", options.bags.duration, "seconds from there (to the end)")->type_name("S");
  app.add_option("--tf-topic", options.bags.moving_topics,
                 "topic of transforms that move; once for each (/tf)")
      ->type_name("NAME");
  app.add_option("--tf-static-topic", options.bags.fixed_topics,
                 "topic of transforms that stand; once for each (/tf_static)")
      ->type_name("NAME");
  addSceneOptions(app, options);
  app.add_option("--pairs", options.pairs,
                 "only pairs of this name or pattern, as 'gripper/*'; once for each")
      ->type_name("PATTERN");
  app.add_option("--output", options.output, BagReport::kColumns)->required()->type_name("FILE");
  app.add_option("--niches-output", options.niches_output,
                 std::string(BagReport::kNicheColumns) + "; without it no niches are computed")
      ->type_name("FILE");
  app.add_option("--plot", options.plot, "picture of the distances over time (.png, .pdf, .svg; matplotlib)")
      ->type_name("FILE");
}

void requireDistinctFiles(const BagOptions& options) {
  std::vector<NamedPath> inputs = {{"--scene", options.node.scene_file},
                                   {"--robot-description", options.robot_description}};
  for (const std::string& path : options.bags.paths) inputs.push_back({"--bag", path});
  for (const std::string& description : options.descriptions) {
    inputs.push_back({"--description", tools::assignment("--description", description).second});
  }
  requireDistinctFiles(
      inputs,
      {{"--output", options.output}, {"--niches-output", options.niches_output}, {"--plot", options.plot}});
}

void checkBagOptions(const CLI::App& app, BagOptions& options) {
  options.bags.are_topics_given = app.count("--tf-topic") + app.count("--tf-static-topic") > 0;
  if (app.count("--tf-topic") == 0 && app.count("--tf-static-topic") > 0) options.bags.moving_topics.clear();
  if (app.count("--tf-static-topic") == 0 && app.count("--tf-topic") > 0) options.bags.fixed_topics.clear();
  options.node.reference_frame = requireFrameName(options.node.reference_frame, "--reference-frame");
  options.node.automatic_cutoff = options.node.scene_file.empty() && app.count("--cutoff") == 0;
  for (const std::string& pattern : options.pairs) detail::requirePatternLength(pattern, "--pairs");
  if (options.bags.duration && !(*options.bags.duration > 0.0)) {
    throw Error("--duration", "it is " + numberText(*options.bags.duration) + " s", "give seconds above 0");
  }
  if (!(options.bags.start >= 0.0)) {
    throw Error("--start", "it is " + numberText(options.bags.start) + " s", "give seconds from 0 on");
  }
}

}  // namespace concave_distance
