#include "ros/node/node_parameters.h"

#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "concave_distance/base/error.h"
#include "ros/node/reconfiguration.h"
#include "ros/node/simulation_runner.h"

namespace concave_distance::node_parameters_test {
namespace {

NodeParameters parse(const XmlRpc::XmlRpcValue& values) {
  std::vector<std::string> unknown;
  return parseNodeParameters(values, unknown);
}

// The message of the Error, empty when there was none.
std::string refusal(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue values;
  values[name] = value;
  try {
    parse(values);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(NodeParameters, HaveDefaultsWhenNothingIsSet) {
  const NodeParameters parameters = parse(XmlRpc::XmlRpcValue());
  EXPECT_EQ(parameters.reference_frame, "world");
  EXPECT_EQ(parameters.robot_description, "robot_description");
  EXPECT_TRUE(std::isinf(parameters.pair.tracker.cutoff));
  EXPECT_FALSE(parameters.pair.warning_distance.has_value());
}

TEST(NodeParameters, ReadWholeNumbersAsLengthsAndStripTheOldLeadingSlash) {
  XmlRpc::XmlRpcValue values;
  values["rate"] = 100;
  values["cutoff"] = 2;
  values["warning_distance"] = 0.25;
  values["reference_frame"] = "/odom";
  values["geometry"] = "visual";
  values["accuracy"] = "nodes";
  values["show_bodies"] = false;
  const NodeParameters parameters = parse(values);
  EXPECT_EQ(parameters.rate, 100.0);
  EXPECT_EQ(parameters.pair.tracker.cutoff, 2.0);
  EXPECT_EQ(parameters.pair.warning_distance, 0.25);
  EXPECT_EQ(parameters.reference_frame, "odom");
  EXPECT_EQ(parameters.geometry, GeometrySource::Visual);
  EXPECT_EQ(parameters.pair.tracker.accuracy, AccuracyLevel::Nodes);
  EXPECT_FALSE(parameters.show_bodies);
}

TEST(NodeParameters, ReadTheCertifiedLevelWithItsTolerances) {
  XmlRpc::XmlRpcValue values;
  values["accuracy"] = "certified";
  values["absolute_tolerance"] = 0.001;
  values["relative_tolerance"] = 0.5;
  values["time_budget"] = 0.002;
  const TrackerParameters tracker = parse(values).pair.tracker;
  EXPECT_EQ(tracker.accuracy, AccuracyLevel::Certified);
  EXPECT_EQ(tracker.absolute_tolerance, 0.001);
  EXPECT_EQ(tracker.relative_tolerance, 0.5);
  EXPECT_EQ(tracker.time_budget, 0.002);
  EXPECT_TRUE(std::isinf(parse(XmlRpc::XmlRpcValue()).pair.tracker.time_budget));
  EXPECT_NE(refusal("relative_tolerance", 1.5), "");
  for (const double seconds : {std::nan(""), -1.0, 0.0, -HUGE_VAL}) {
    const std::string message = refusal("time_budget", seconds);
    EXPECT_NE(message.find("time_budget"), std::string::npos) << seconds << message;
    EXPECT_NE(message.find("greater than 0 (s)"), std::string::npos) << message;
  }
}

TEST(NodeParameters, RefuseWithNameValueAndRange) {
  const std::string message = refusal("rate", 0.0);
  EXPECT_NE(message.find("~rate"), std::string::npos) << message;
  EXPECT_NE(message.find("from 0.1 to 2000"), std::string::npos) << message;
  EXPECT_NE(refusal("rate", "fast").find("fast"), std::string::npos);
  EXPECT_NE(refusal("rate", std::nan("")), "");
  EXPECT_NE(refusal("threads", 1.5).find("whole number"), std::string::npos);
  EXPECT_NE(refusal("threads", -1), "");
  EXPECT_NE(refusal("geometry", "convex").find("collision, visual"), std::string::npos);
  EXPECT_NE(refusal("reference_frame", ""), "");
  EXPECT_NE(refusal("reference_frame", 3), "");
  for (const char* frame : {"/", "///", "a b", "a\nb"}) {
    EXPECT_NE(refusal("reference_frame", frame), "") << frame;
  }
  for (const double period : {-5.0, 0.0, 1e300, std::nan("")}) {
    EXPECT_NE(refusal("diagnostic_period", period), "") << period;
  }
  EXPECT_NE(refusal("diagnostic_period", "abc"), "");
  EXPECT_NE(refusal("show_bodies", "yes"), "");
  EXPECT_NE(refusal("warm_population_size", 20).find("~expert/warm/population_size"), std::string::npos);
  XmlRpc::XmlRpcValue experts;
  experts["warm"]["population_size"] = 21;
  EXPECT_NE(refusal("expert", experts).find("an even number"), std::string::npos);
  EXPECT_NE(refusal("marker_far", -1.0), "");
  XmlRpc::XmlRpcValue crossed;
  crossed["marker_near"] = 0.2;
  crossed["marker_far"] = 0.1;
  EXPECT_THROW(parse(crossed), Error) << "not above marker_near";
}

TEST(NodeParameters, TheBudgetOfACycleIsAShareOfThePeriodUnlessItIsSet) {
  XmlRpc::XmlRpcValue values;
  values["rate"] = 100.0;
  const auto seconds = [&] {
    const NodeParameters parameters = parse(values);
    return cycleBudget(parameters.cycle_budget, parameters.rate);
  };
  EXPECT_DOUBLE_EQ(seconds(), 0.008);
  values["cycle_budget"] = "auto";
  EXPECT_DOUBLE_EQ(seconds(), 0.008);
  values["cycle_budget"] = 0.01;
  EXPECT_EQ(seconds(), 0.01) << "all of the period";
  for (const XmlRpc::XmlRpcValue& none : {XmlRpc::XmlRpcValue(0), XmlRpc::XmlRpcValue(0.0)}) {
    values["cycle_budget"] = none;
    EXPECT_TRUE(std::isinf(seconds()));
  }
}

TEST(NodeParameters, ABudgetThatNoCycleCanHaveIsRefusedWithARemedy) {
  for (const double seconds : {std::nan(""), -0.001, -1e300, 11.0, 1e300, HUGE_VAL, -HUGE_VAL}) {
    const std::string message = refusal("cycle_budget", seconds);
    EXPECT_NE(message.find("~cycle_budget"), std::string::npos) << seconds << message;
    EXPECT_NE(message.find("allowed: from 0 to 10 (s), or auto"), std::string::npos) << message;
  }
  for (const char* text : {"none", "0.8", "", "0,01"}) EXPECT_NE(refusal("cycle_budget", text), "") << text;
  EXPECT_NE(refusal("cycle_budget", true), "");
  const std::string message = refusal("cycle_budget", 0.021);
  for (const char* part : {"~cycle_budget", "0.021 s, longer than the period of 0.02 s (~rate 50)", "auto",
                           "0 for cycles without an end"}) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
  }
  EXPECT_THROW(cycleBudget(0.015, 100.0), Error) << "the rate was raised while the node runs";
  EXPECT_EQ(cycleBudget(0.015, 50.0), 0.015);
}

TEST(NodeParameters, TellNamesNobodyKnows) {
  XmlRpc::XmlRpcValue values;
  values["ratte"] = 5.0;
  values["diagnostic_period"] = 1.0;
  values["rate"] = 5.0;
  values["expert"]["cold"]["generation_gap"] = 0.5;  // of experiments
  std::vector<std::string> unknown;
  parseNodeParameters(values, unknown);
  EXPECT_EQ(std::set<std::string>(unknown.begin(), unknown.end()),
            (std::set<std::string>{"ratte", "expert/cold/generation_gap"}));
}

TEST(NodeParameters, ReadPatternsOfPairsAsAListOrAsOneText) {
  EXPECT_FALSE(parse(XmlRpc::XmlRpcValue()).pair_topics.has_value());
  XmlRpc::XmlRpcValue values;
  values["pair_topics"] = "arm/*";
  EXPECT_EQ(parse(values).pair_topics, std::vector<std::string>{"arm/*"});
  XmlRpc::XmlRpcValue two;
  two["pair_topics"][0] = "arm/*";
  two["pair_topics"][1] = "cup/table";
  EXPECT_EQ(parse(two).pair_topics->size(), 2U);
  XmlRpc::XmlRpcValue none;
  none["pair_topics"].setSize(0);
  EXPECT_TRUE(parse(none).pair_topics->empty()) << "none at all";
  EXPECT_NE(refusal("pair_topics", 3).find("a list of texts"), std::string::npos);
  two["pair_topics"][1] = 5;
  EXPECT_NE(refusal("pair_topics", two["pair_topics"]).find("~pair_topics"), std::string::npos);
}

TEST(NodeParameters, ReadTheLimitsBelowTheirOwnName) {
  XmlRpc::XmlRpcValue values;
  values["limits"]["service_queue"] = 3;
  values["limits"]["query_seconds"] = 2;
  values["limits"]["query_secnods"] = 2;
  std::vector<std::string> unknown;
  const NodeLimits limits = parseNodeParameters(values, unknown).limits;
  EXPECT_EQ(limits.service_queue, 3U);
  EXPECT_EQ(limits.query_seconds, 2.0);
  EXPECT_EQ(limits.service_threads, NodeLimits().service_threads);
  EXPECT_EQ(unknown, std::vector<std::string>{"limits/query_secnods"});
  XmlRpc::XmlRpcValue wrong;
  wrong["service_threads"] = 0;
  EXPECT_NE(refusal("limits", wrong).find("~limits/service_threads"), std::string::npos);
  EXPECT_NE(refusal("limits", wrong).find("from 1 to 64"), std::string::npos);
  EXPECT_NE(refusal("limits", 5).find("~limits"), std::string::npos);
}

TEST(Reconfiguration, BeginsWithTheDefaultsOfTheNode) {
  const ConcaveDistanceConfig ours = toConfig(NodeParameters());
  const ConcaveDistanceConfig generated = ConcaveDistanceConfig::__getDefault__();
  EXPECT_FALSE(concernsPairs(ours, generated));
  EXPECT_EQ(ours.rate, generated.rate);
  EXPECT_EQ(ours.marker_rate, generated.marker_rate);
  EXPECT_EQ(ours.publish_markers, generated.publish_markers);
}

// As dynamic_reconfigure leaves it on the parameter server.
XmlRpc::XmlRpcValue onTheServer(const ConcaveDistanceConfig& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  XmlRpc::XmlRpcValue values;
  for (const auto& value : message.strs) values[value.name] = value.value;
  for (const auto& value : message.doubles) values[value.name] = value.value;
  for (const auto& value : message.ints) values[value.name] = static_cast<int>(value.value);
  for (const auto& value : message.bools) values[value.name] = value.value != 0;
  return values;
}

TEST(Reconfiguration, IsReadAtTheNextStart) {
  for (const std::string text :
       {"0.5", "5", "none", "1e-3", "+2", "0", "-1", "", "far", " 1", "0x1", "inf"}) {
    for (const bool of_cutoff : {true, false}) {
      ConcaveDistanceConfig config = ConcaveDistanceConfig::__getDefault__();
      (of_cutoff ? config.cutoff : config.time_budget) = text;
      bool is_accepted = true;
      try {
        checkConfig(config);
      } catch (const Error&) {
        is_accepted = false;
      }
      try {
        const NodeParameters read = parse(onTheServer(config));
        EXPECT_TRUE(is_accepted) << text;
        PairSettings applied;
        applyChanges(ConcaveDistanceConfig::__getDefault__(), config, applied);
        EXPECT_EQ(read.pair.tracker.cutoff, applied.tracker.cutoff) << text;
        EXPECT_EQ(read.pair.tracker.time_budget, applied.tracker.time_budget) << text;
      } catch (const Error& error) {
        EXPECT_FALSE(is_accepted) << text << ": " << error.what();
      }
    }
  }
  ConcaveDistanceConfig all = ConcaveDistanceConfig::__getDefault__();
  all.rate = 12.5;
  all.marker_rate = 7.0;
  all.publish_markers = all.publish_contact_markers = false;
  all.absolute_tolerance = 0.25;
  all.relative_tolerance = 0.125;
  all.least_prominence = 3.0;
  all.largest_niche_count = 2147483647;
  const ConcaveDistanceConfig read = toConfig(parse(onTheServer(all)));
  EXPECT_EQ(onTheServer(read), onTheServer(all));
}

TEST(Reconfiguration, ChangesWhatDiffersAndNothingElse) {
  ConcaveDistanceConfig before = ConcaveDistanceConfig::__getDefault__();
  ConcaveDistanceConfig after = before;
  after.cutoff = "0.5";
  PairSettings settings;
  settings.tracker.least_prominence = 0.123;  // of a scene file
  applyChanges(before, after, settings);
  EXPECT_EQ(settings.tracker.cutoff, 0.5);
  EXPECT_EQ(settings.tracker.least_prominence, 0.123);
  applyChanges(after, before, settings);
  EXPECT_TRUE(std::isinf(settings.tracker.cutoff)) << "none";
  after = before;
  after.time_budget = "0.01";
  after.absolute_tolerance = 0.001;
  EXPECT_TRUE(concernsPairs(before, after));
  applyChanges(before, after, settings);
  EXPECT_EQ(settings.tracker.time_budget, 0.01);
  EXPECT_EQ(settings.tracker.absolute_tolerance, 0.001);
  applyChanges(after, before, settings);
  EXPECT_TRUE(std::isinf(settings.tracker.time_budget)) << "none";
  after = before;
  after.rate = 10.0;
  EXPECT_FALSE(concernsPairs(before, after));
  after.largest_niche_count = 3;
  EXPECT_TRUE(concernsPairs(before, after));
  applyChanges(before, after, settings);
  EXPECT_EQ(settings.tracker.largest_niche_count, 3U);
}

std::string simulationRefusal(const std::string& name, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue values;
  values["scene_file"] = "scene.yaml";
  values[name] = value;
  try {
    parseSimulationParameters(values);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SimulationNodeParameters, AreReadAndTheirSceneIsRequired) {
  XmlRpc::XmlRpcValue values;
  values["scene_file"] = "scene.yaml";
  values["speed"] = 0;
  values["at_end"] = "loop";
  const SimulationNodeParameters parameters = parseSimulationParameters(values);
  EXPECT_EQ(parameters.scene_file, "scene.yaml");
  EXPECT_EQ(parameters.speed, 0.0);
  EXPECT_EQ(parameters.at_end, SimulationEnd::Loop);
  EXPECT_TRUE(parameters.publish_clock);
  EXPECT_NE(simulationRefusal("scene_file", "").find("~scene_file"), std::string::npos);
}

TEST(SimulationNodeParameters, WrongNamesAndValuesAreRefused) {
  EXPECT_EQ(simulationRefusal("rate", 50.0), "");
  EXPECT_NE(simulationRefusal("rate", 0.0).find("~rate"), std::string::npos);
  EXPECT_NE(simulationRefusal("at_end", "stop").find("allowed: hold, loop, exit"), std::string::npos);
  EXPECT_NE(simulationRefusal("sped", 1.0).find("~sped"), std::string::npos);
}

TEST(NodeParameters, MeshRootsArePackagesAndTheScenesFolderUnlessTheyAreListed) {
  XmlRpc::XmlRpcValue values;
  MeshRoots roots = parse(values).mesh_access.roots.value();
  EXPECT_TRUE(roots.every_package);
  EXPECT_TRUE(roots.folders.empty());
  values["scene_file"] = "/cell/scene.yaml";
  roots = parse(values).mesh_access.roots.value();
  EXPECT_TRUE(roots.every_package);
  EXPECT_EQ(roots.folders, std::vector<std::string>{"/cell"});
  values["mesh_roots"][0] = "package://arm";
  values["mesh_roots"][1] = "/data/parts/";
  roots = parse(values).mesh_access.roots.value();
  EXPECT_FALSE(roots.every_package);
  EXPECT_EQ(roots.packages, std::vector<std::string>{"arm"});
  EXPECT_EQ(roots.folders, std::vector<std::string>{"/data/parts"});
  XmlRpc::XmlRpcValue none;
  none.setSize(0);
  values["mesh_roots"] = none;
  roots = parse(values).mesh_access.roots.value();
  EXPECT_FALSE(roots.every_package || !roots.packages.empty() || !roots.folders.empty());

  XmlRpc::XmlRpcValue relative;
  relative[0] = "meshes";
  EXPECT_NE(refusal("mesh_roots", relative).find("absolute folder"), std::string::npos);
  EXPECT_NE(refusal("mesh_roots", 5).find("a list of texts"), std::string::npos);
}

TEST(NodeParameters, LimitsOfTheImportReachIt) {
  XmlRpc::XmlRpcValue values;
  values["limits"]["import_memory_mb"] = 300;
  values["limits"]["import_seconds"] = 2.5;
  values["limits"]["largest_triangle_count"] = 1000;
  const MeshImportLimits limits = parse(values).mesh_access.limits;
  EXPECT_EQ(limits.memory, 300'000'000U);
  EXPECT_EQ(limits.seconds, 2.5);
  EXPECT_EQ(limits.largest_triangle_count, 1000U);
}

}  // namespace
}  // namespace concave_distance::node_parameters_test
