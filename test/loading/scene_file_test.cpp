#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "scene/pair_parameters.h"
#include "search/genetic_parameter_table.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"
#include "support/scene_fixture.h"
#include "tracking/tracker_parameter_table.h"

namespace concave_distance::scene_file_test {
namespace {

using test::bodyNames;
using test::mentions;

/// A body that nothing is wrong with, to hang something wrong on.
const std::string kBall = "bodies:\n  - name: ball\n    sphere: {radius: 1}\n    max_edge_length: 100\n";

class SceneFile : public test::SceneTest {
 protected:
  /// Expects the refusal to begin with the place and to hold what is said of the value and what is allowed.
  void expectRefused(const std::string& yaml, const std::string& place, const std::string& seen,
                     const std::string& allowed) const {
    const std::string text = refusal(yaml);
    EXPECT_EQ(text.substr(0, place.size() + 2), place + ": ") << text << "\n" << yaml;
    EXPECT_TRUE(mentions(text, seen)) << text << "\n" << yaml;
    EXPECT_TRUE(mentions(text, allowed)) << text << "\n" << yaml;
  }
  void expectBodyRefused(const std::string& key, const std::string& value, const std::string& seen,
                         const std::string& allowed) const {
    expectRefused("bodies:\n  - name: b\n    mesh: b.stl\n    " + key + ": " + value + "\n",
                  "scene.yaml:4, bodies[0]." + key, seen, allowed);
  }
  void expectSettingRefused(const std::string& key, const std::string& value,
                            const std::string& allowed) const {
    expectRefused("defaults:\n  " + key + ": " + value + "\n" + kBall, "scene.yaml:2, defaults." + key,
                  "the value is", allowed);
    expectRefused(kBall + "pairs:\n  - between: ['*', '*']\n    " + key + ": " + value + "\n",
                  "scene.yaml:7, pairs[0]." + key, "the value is", allowed);
  }
  void expectExpertRefused(const std::string& key, const std::string& value,
                           const std::string& allowed) const {
    expectRefused("defaults:\n  expert:\n    " + key + ": " + value + "\n",
                  "scene.yaml:3, defaults.expert." + key, "the value is", allowed);
  }
  void expectRefusedIn(const std::string& phase, const std::string& key, const std::string& value,
                       const std::string& allowed) const {
    expectRefused("defaults:\n  expert:\n    " + phase + ":\n      " + key + ": " + value + "\n",
                  "scene.yaml:4, defaults.expert." + phase + "." + key, "the value is", allowed);
  }
  void expectGeneticRefused(const std::string& key, const std::string& value,
                            const std::string& allowed) const {
    expectRefusedIn("cold", key, value, allowed);
    expectRefusedIn("warm", key, value, allowed);
  }
};

TEST_F(SceneFile, EmptySceneIsAScene) {
  const Scene scene = load("bodies: []\n");
  EXPECT_TRUE(scene.bodies.empty());
  EXPECT_TRUE(allPairs(scene).empty());
  EXPECT_TRUE(scene.problems.empty());
}

TEST_F(SceneFile, WhatIsNoMapIsRefused) {
  expectRefused("", "scene.yaml:1", "the value is empty", "a map with robots");
  expectRefused("- 1\n", "scene.yaml:1", "a list of 1", "a map with robots");
  expectRefused("bodies: []\n---\nbodies: []\n", "scene.yaml:3", "'operations' is missing", "give a list");
  expectRefused("? [a]\n: 1\n", "scene.yaml:1", "a key that is no text", "write key: value");
}

TEST_F(SceneFile, BrokenYamlIsRefusedWithItsLine) {
  expectRefused("bodies:\n  - name: a\n   box: 3\n", "scene.yaml:3", "no YAML", "mend the syntax");
  expectRefused("bodies: [1, 2\n", "scene.yaml:2", "no YAML", "mend the syntax");
}

TEST_F(SceneFile, MoreThanAMillionValuesAreRefused) {
  std::string list = "bodies: [a";
  for (int i = 0; i < 1'000'000; ++i) list += ",a";
  expectRefused(list + "]\n", "scene.yaml", "more than 1000000 values", "leave out");
}

TEST_F(SceneFile, UnknownKeysAreRefusedEverywhere) {
  expectRefused("bodys: []\n", "scene.yaml:1, bodys", "key 'bodys' is not known",
                "robots, bodies, clouds, groups");
  expectRefused("defaults:\n  cutof: 1\n", "scene.yaml:2, defaults.cutof", "not known", "cutoff");
  expectRefused("defaults:\n  expert:\n    cold:\n      generation_gap: 1\n",
                "scene.yaml:4, defaults.expert.cold.generation_gap", "not known", "population_size");
  expectRefused("bodies:\n  - name: a\n    box: {size: [1, 1, 1]}\n    color: [1, 1, 1]\n",
                "scene.yaml:4, bodies[0].color", "not known", "colour");
  expectRefused("bodies:\n  - name: a\n    box: {size: [1, 1, 1], radius: 1}\n",
                "scene.yaml:3, bodies[0].box.radius", "not known", "size");
  expectRefused("bodies:\n  - name: a\n    mesh: a.stl\n    pose: {xyz: [1, 1, 1], yaw: 1}\n",
                "scene.yaml:4, bodies[0].pose.yaw", "not known", "xyz, rpy, quaternion");
  expectRefused("robots:\n  - description: d\n    tf_prefix: a\n", "scene.yaml:3, robots[0].tf_prefix",
                "not known", "prefix");
  expectRefused(kBall + "pairs:\n  - between: [ball, ball]\n    effect: contact\n",
                "scene.yaml:7, pairs[0].effect", "not known", "effects");
  expectRefused(kBall + "pairs:\n  - between: ['*', '*']\n    max_edge_length: 1\n",
                "scene.yaml:7, pairs[0].max_edge_length", "not known", "cutoff");
}

TEST_F(SceneFile, KeysThatStandTwiceAreRefused) {
  expectRefused("bodies: []\ngroups: {}\nbodies: []\n", "scene.yaml:3, bodies",
                "stands twice, first in line 1", "remove one");
  expectRefused("groups:\n  a: []\n  a: []\n", "scene.yaml:3, groups.a", "stands twice", "remove one");
}

TEST_F(SceneFile, NamesThatStandTwiceAreRefused) {
  const std::string other = "  - {name: ball, box: {size: [1, 1, 1]}}\n";
  expectRefused(kBall + other, "scene.yaml:5, bodies[1]",
                "the name 'ball' is taken by the body at scene.yaml:2, bodies[0]", "another name");
  expectRefused(kBall + "groups:\n  ball: ['*']\n", "scene.yaml:6, groups.ball", "taken by the body",
                "another name");
  expectRefused("robots:\n  - {name: r, description: d}\n  - {name: r, description: e}\n",
                "scene.yaml:3, robots[1]", "taken by the robot", "another name");
  options.descriptions["d"] = test::robot(test::boxLink("ball"));
  expectRefused("robots: [{description: d}]\n" + kBall, "scene.yaml:3, bodies[0]",
                "the body name 'ball' is taken by parameter d, link 'ball'", "another name");
  expectRefused("robots: [{description: d}, {description: d}]\n", "scene.yaml:1, robots[1]",
                "'ball' is taken", "prefix");
  expectRefused("robots: [{description: d}]\ngroups:\n  ball: []\n", "scene.yaml:3, groups.ball",
                "taken by a body", "another name");
  const std::string pair = "  - {between: [ball, box], name: p}\n";
  expectRefused(kBall + "  - {name: box, box: {size: [1, 1, 1]}}\npairs:\n" + pair + pair,
                "scene.yaml:8, pairs[1]", "taken by the pair", "another name");
}

TEST_F(SceneFile, BodyNeedsANameAndOneGeometry) {
  expectRefused("bodies:\n  - box: {size: [1, 1, 1]}\n", "scene.yaml:2, bodies[0]", "'name' is missing",
                "name");
  expectRefused("bodies:\n  - name: a\n", "scene.yaml:2, bodies[0]", "no geometry", "mesh, box");
  expectRefused("bodies:\n  - name: a\n    mesh: a.stl\n    sphere: {radius: 1}\n",
                "scene.yaml:4, bodies[0].sphere", "a second geometry", "give one of");
  expectRefused("bodies:\n  - name: 'a*'\n    mesh: a.stl\n", "scene.yaml:2, bodies[0].name", "'a*'",
                "without *");
  expectRefused("bodies:\n  - a\n", "scene.yaml:2, bodies[0]", "'a'", "a map with name");
  expectRefused("bodies: {a: 1}\n", "scene.yaml:1, bodies", "a map of 1", "a list of bodies");
  expectRefused("bodies:\n  - name:\n    mesh: a.stl\n", "scene.yaml:2, bodies[0].name", "empty", "a text");
}

TEST_F(SceneFile, ValuesOfBodiesAreChecked) {
  expectBodyRefused("scale", "0", "'0'", "not 0");
  expectBodyRefused("scale", "[1, 0, 1]", "a list of 3", "not 0");
  expectBodyRefused("scale", "[1, 1]", "a list of 2", "a list of three");
  expectBodyRefused("scale", ".inf", "'.inf'", "a number");
  expectBodyRefused("scale", "big", "'big'", "a number");
  expectBodyRefused("colour", "[1, 1]", "a list of 2", "three or four");
  expectBodyRefused("colour", "red", "'red'", "three or four");
  expectBodyRefused("max_edge_length", "0", "'0'", "greater than 0, metres, or auto");
  expectBodyRefused("max_edge_length", "-1", "'-1'", "greater than 0");
  expectBodyRefused("max_edge_length", "'0.1'", "quoted, so a text", "greater than 0");
  expectBodyRefused("chord_error", ".nan", "'.nan'", "greater than 0");
  for (const char* margin : {"-0.01", ".nan", ".inf", "-.inf", "thick"}) {
    expectBodyRefused("margin", margin, "'" + std::string(margin) + "'", "a number from 0, metres");
  }
  expectBodyRefused("frame", "", "empty", "a text");
  expectBodyRefused("frame", "[a]", "a list of 1", "a text");
  const auto in_body = [&](const std::string& line, const std::string& place, const std::string& seen,
                           const std::string& allowed) {
    expectRefused("bodies:\n  - name: b\n    " + line + "\n", "scene.yaml:3, bodies[0]." + place, seen,
                  allowed);
  };
  in_body("box: {size: [1, 1]}", "box.size", "a list of 2", "three lengths");
  in_body("box: {size: [1, 1, 0]}", "box.size", "a list of 3", "greater than 0");
  in_body("box: {size: [1, 1, x]}", "box.size[2]", "'x'", "a finite number");
  in_body("box: {}", "box", "'size' is missing", "size: [x, y, z]");
  in_body("box: [1, 1, 1]", "box", "a list of 3", "a map of dimensions");
  in_body("sphere: {radius: -1}", "sphere.radius", "'-1'", "greater than 0");
  in_body("cylinder: {radius: 1}", "cylinder", "'length' is missing", "metres");
  in_body("capsule: {radius: 1, length: .inf}", "capsule.length", "'.inf'", "greater than 0");
  const auto in_pose = [&](const std::string& pose, const std::string& place, const std::string& seen,
                           const std::string& allowed) {
    expectRefused("bodies:\n  - name: b\n    mesh: b.stl\n    pose: " + pose + "\n",
                  "scene.yaml:4, bodies[0].pose" + place, seen, allowed);
  };
  in_pose("[1, 2, 3]", "", "a list of 3", "xyz and rpy");
  in_pose("{xyz: [1, 2]}", ".xyz", "a list of 2", "three numbers");
  in_pose("{xyz: [1, 2, .inf]}", ".xyz[2]", "'.inf'", "a finite number");
  in_pose("{rpy: 3}", ".rpy", "'3'", "three angles");
  in_pose("{rpy: [0, 0, 0], quaternion: [0, 0, 0, 1]}", ".quaternion", "both 'rpy' and 'quaternion'",
          "give one");
  in_pose("{quaternion: [0, 0, 0, 1.1]}", ".quaternion", "the norm is 1.1", "norm 1");
  in_pose("{quaternion: [0, 0, 0]}", ".quaternion", "a list of 3", "four numbers");
  expectRefused("bodies:\n  - name: b\n    sphere: {radius: 1}\n    scale: 2\n",
                "scene.yaml:4, bodies[0].scale", "a primitive has no scale", "dimensions");
}

TEST_F(SceneFile, PoseScaleAndDimensionsAreApplied) {
  folder.write("my meshes/t.stl", test::tetrahedronStl());
  const Scene scene = load(
      "bodies:\n"
      "  - {name: t, frame: world, mesh: my meshes/t.stl, scale: 2, max_edge_length: 100,\n"
      "     pose: {xyz: [10, 0, 0], rpy: [0, 0, 1.5707963267948966]}}\n"
      "  - {name: u, mesh: my meshes/t.stl, scale: [1, -1, 1], max_edge_length: 100,\n"
      "     pose: {quaternion: [0, 0, 0.7071067811865476, 0.7071067811865476]}, colour: [0.1, 0.2, 0.3, "
      "0.4]}\n"
      "  - {name: box, box: {size: [1, 2, 3]}, max_edge_length: 100, colour: [1, 0, 0]}\n"
      "  - {name: capsule, capsule: {radius: 1, length: 2}, chord_error: 0.1, max_edge_length: 100}\n");
  ASSERT_EQ(bodyNames(scene), (std::vector<std::string>{"t", "u", "box", "capsule"}));
  const auto expect_box = [&](std::size_t body, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                              double tolerance) {
    const Eigen::AlignedBox3d& box = scene.bodies[body].mesh->surface().boundingBox();
    EXPECT_LT((box.min() - low).norm(), tolerance) << box.min().transpose();
    EXPECT_LT((box.max() - high).norm(), tolerance) << box.max().transpose();
    EXPECT_GT(test::signedVolume(scene.bodies[body].mesh->surface()), 0.0);
    EXPECT_TRUE(scene.bodies[body].bounds.centre.isApprox(box.center()));
  };
  expect_box(0, {6, 0, 0}, {10, 2, 6}, 1e-12);
  expect_box(1, {0, 0, 0}, {2, 1, 3}, 1e-12);
  expect_box(2, {-0.5, -1, -1.5}, {0.5, 1, 1.5}, 1e-12);
  expect_box(3, {-1, -1, -2}, {1, 1, 2}, 0.2);
  EXPECT_EQ(scene.bodies[0].frame, "world");
  EXPECT_EQ(scene.bodies[1].frame, "u");
  EXPECT_EQ(scene.bodies[1].colour, Eigen::Vector4d(0.1, 0.2, 0.3, 0.4));
  EXPECT_EQ(scene.bodies[2].colour, Eigen::Vector4d(1, 0, 0, 1));
  EXPECT_EQ(gridOf(*scene.bodies[0].mesh).nodes().max_edge_length, 100.0);
}

TEST_F(SceneFile, BodiesAndRobotsHaveMargins) {
  options.descriptions["d"] = test::robot(test::boxLink("hand"));
  const Scene scene = load(
      "defaults: {max_edge_length: 100}\n"
      "robots: [{description: d, margin: 2.5}]\n"
      "bodies:\n"
      "  - {name: box, box: {size: [1, 1, 1]}, margin: 0.25}\n"
      "  - {name: bare, box: {size: [1, 1, 1]}}\n"
      "  - {name: thick, box: {size: [1, 1, 1]}, margin: 2.5}\n");
  ASSERT_EQ(bodyNames(scene), (std::vector<std::string>{"hand", "box", "bare"}));
  EXPECT_EQ(scene.bodies[0].margin, 2.5) << "all links of a robot have its margin, small ones too";
  EXPECT_EQ(scene.bodies[1].margin, 0.25);
  EXPECT_EQ(scene.bodies[2].margin, 0.0);
  ASSERT_EQ(scene.problems.size(), 1U);
  const std::string& message = scene.problems.front().message;
  EXPECT_TRUE(mentions(message, "thick")) << message;
  EXPECT_TRUE(mentions(message, "margin 2.5 m is larger than the body, whose diagonal is 1.73")) << message;
  EXPECT_TRUE(mentions(message, "metres")) << message;
  expectRefused("robots: [{description: d, margin: -1}]\n", "scene.yaml:1, robots[0].margin", "'-1'",
                "a number from 0, metres");
}

TEST_F(SceneFile, EdgeLengthOfABodyGoesBeforeTheDefaultAndAutoTakesTheDefaultBack) {
  const Scene scene = load(
      "bodies:\n"
      "  - {name: a, box: {size: [1, 1, 1]}}\n"
      "  - {name: b, box: {size: [1, 1, 1]}, max_edge_length: 0.7}\n"
      "  - {name: c, box: {size: [1, 1, 1]}, max_edge_length: auto}\n"
      "defaults: {max_edge_length: 0.9}\n");
  EXPECT_EQ(gridOf(*scene.bodies[0].mesh).nodes().max_edge_length, 0.9);
  EXPECT_EQ(gridOf(*scene.bodies[1].mesh).nodes().max_edge_length, 0.7);
  const BodyMesh automatic("c", scene.bodies[2].mesh->surface(), BodyMeshOptions{});
  EXPECT_EQ(gridOf(*scene.bodies[2].mesh).nodes().max_edge_length, gridOf(automatic).nodes().max_edge_length);
  EXPECT_EQ(gridOf(*scene.bodies[2].mesh).graph().nodeCount(), gridOf(automatic).graph().nodeCount());
}

TEST_F(SceneFile, RobotNeedsOneDescription) {
  expectRefused("robots:\n  - {}\n", "scene.yaml:2, robots[0]", "neither of 'description' and 'urdf'", "one");
  expectRefused("robots:\n  - description: d\n    urdf: a.urdf\n", "scene.yaml:3, robots[0].urdf",
                "both 'description' and 'urdf'", "one");
  expectRefused("robots:\n  - description: d\n    srdf: a\n    semantic_description: b\n",
                "scene.yaml:3, robots[0].srdf", "both", "one");
  expectRefused("robots:\n  - description: gone\n", "scene.yaml:2, robots[0]", "there is no parameter 'gone'",
                "set it");
  expectRefused("robots:\n  - description: d\n    geometry: hull\n", "scene.yaml:3, robots[0].geometry",
                "'hull'", "collision, visual");
  expectRefused("robots:\n  - description: d\n    skip_links: a\n", "scene.yaml:3, robots[0].skip_links",
                "'a'", "a list");
  expectRefused("robots:\n  - description: d\n    prefix: 'a*'\n", "scene.yaml:3, robots[0].prefix", "'a*'",
                "without");
  expectRefused("robots:\n  - description: d\n    name: 'a*'\n", "scene.yaml:3, robots[0].name", "'a*'",
                "without");
}

/// Values, as YAML writes them, that a parameter does not allow.
std::vector<std::string> wrongValues(const ParameterInfo& info) {
  std::vector<std::string> wrong{"''", "[1]", "many"};
  if (info.type != ParameterType::Number && info.type != ParameterType::Count) return wrong;
  wrong.insert(wrong.end(), {"-1", "-.inf", ".nan", "1e999"});
  if (info.type == ParameterType::Count) wrong.insert(wrong.end(), {"2.5", "18446744073709551616"});
  if (info.above_lowest || info.lowest > 0.0) wrong.emplace_back("0");
  if (info.highest <= 1.0) wrong.emplace_back("1.5");
  if (info.is_even) wrong.emplace_back("51");
  return wrong;
}

/// Returns what a refusal by the scene file says is allowed.
std::string allowedBy(const ParameterInfo& info) {
  return info.type == ParameterType::Flag ? "true or false" : allowedValues(info);
}

TEST_F(SceneFile, EverySettingOutOfRangeIsRefusedInDefaultsAndPairs) {
  for (const Parameter<PairSettings>& parameter : pairParameters()) {
    const ParameterInfo& info = parameter.info;
    for (const std::string& value : wrongValues(info)) {
      if (info.is_expert) {
        expectExpertRefused(info.name, value, allowedBy(info));
      } else {
        expectSettingRefused(info.name, value, allowedBy(info));
      }
    }
  }
  for (const Parameter<GeneticParameters>& parameter : geneticParameters()) {
    for (const std::string& value : wrongValues(parameter.info))
      expectGeneticRefused(parameter.info.name, value, allowedBy(parameter.info));
  }
}

TEST_F(SceneFile, WhatIsAllowedIsSaidInWords) {
  expectSettingRefused("accuracy", "exact", "nodes, refined");
  expectSettingRefused("cutoff", "1 m", "greater than 0 (m), or none");
  expectSettingRefused("largest_niche_count", "4294967296", "a whole number 1 or more");
  expectSettingRefused("hidden", "2", "true or false");
  expectSettingRefused("warning_distance", "never", "0 or more (m), or none");
  expectExpertRefused("facet_pair_limit", "999", "a whole number 1000 or more");
  expectExpertRefused("search_share", "1.5", "from 0 to 1");
  expectExpertRefused("sharing_radius", "0", "greater than 0 (m), or auto");
  expectExpertRefused("mating_radius", "-1", "greater than 0 (m), or auto");
  expectExpertRefused("niche_radius", "wide", "greater than 0 (m), or auto");
  expectExpertRefused("cold", "3", "a map of parameters");
  expectExpertRefused("warm", "[]", "a map of parameters");
  expectGeneticRefused("population_size", "51", "an even number 2 or more");
  expectGeneticRefused("mutation_probability", "-0.1", "from 0 to 1, or auto");
}

TEST_F(SceneFile, SettingsForExpertsAreRefusedAmongTheOthers) {
  EXPECT_TRUE(mentions(refusal("defaults: {random_starts: 3}\n"), "expert: {random_starts: ...}"));
}

TEST_F(SceneFile, NumbersAreReadAsYamlWritesThem) {
  const auto cutoff_of = [&](const std::string& text) {
    return allPairs(load(kBall + "  - {name: box, box: {size: [1, 1, 1]}}\ndefaults: {cutoff: " + text +
                         ", max_edge_length: 9}\n"))
        .at(0)
        .settings.tracker.cutoff;
  };
  EXPECT_EQ(cutoff_of("2"), 2.0);
  EXPECT_EQ(cutoff_of(".5"), 0.5);
  EXPECT_EQ(cutoff_of("+2.5e-1"), 0.25);
  EXPECT_EQ(cutoff_of("none"), std::numeric_limits<double>::infinity());
  for (const char* text : {"+-2", "++2", "+", "2,5", "0x10", "inf", "2 3", "1e400"}) {
    expectSettingRefused("cutoff", text, "greater than 0");
  }
}

TEST_F(SceneFile, DefaultsOfBodiesAreChecked) {
  expectRefused("defaults:\n  max_edge_length: 0\n", "scene.yaml:2, defaults.max_edge_length", "'0'",
                "greater than 0");
  expectRefused("defaults:\n  chord_error: 0\n", "scene.yaml:2, defaults.chord_error", "'0'",
                "greater than 0");
  expectRefused("defaults:\n  geometry: x\n", "scene.yaml:2, defaults.geometry", "'x'", "collision, visual");
  expectRefused("metric_memory_limit_mb: -1\n", "scene.yaml:1, metric_memory_limit_mb", "'-1'", "megabytes");
}

TEST_F(SceneFile, SettingsThatDoNotGoTogetherAreRefused) {
  expectRefused("defaults:\n  cutoff: 0.5\n  warning_distance: 1\n", "scene.yaml:2, defaults",
                "warning_distance 1 m is beyond the cutoff of 0.5 m", "raise cutoff");
  expectRefused(kBall +
                    "  - {name: box, box: {size: [1, 1, 1]}}\ndefaults: {warning_distance: 1}\npairs:\n"
                    "  - {between: [box, ball], cutoff: 0.5}\n",
                "scene.yaml:8, pairs[0]", "beyond the cutoff", "raise cutoff");
}

TEST_F(SceneFile, EverySettingReachesItsParameter) {
  const Scene scene =
      load(kBall +
           "  - {name: box, box: {size: [1, 1, 1]}, max_edge_length: 100}\n"
           "pairs:\n"
           "  - between: [box, ball]\n"
           "    accuracy: nodes\n    cutoff: 2\n    least_prominence: 0.25\n"
           "    largest_niche_count: 7\n    hidden: true\n    seed: "
           "18446744073709551615\n"
           "    warning_distance: 0.125\n    warning_hysteresis: 0.5\n"
           "    expert:\n"
           "      inherited_per_niche: 4.5\n      inherited_limit: 11\n      random_starts: 5\n"
           "      search_share: 0.5\n      keep_through_material: true\n"
           "      sharing_radius: 0.3\n      mating_radius: 0.4\n      niche_radius: 0.2\n"
           "      cold:\n        population_size: 80\n        max_generations: 9\n"
           "        crossover_probability: 0.75\n        mutation_probability: 0.0625\n"
           "        exchange_probability: 0.25\n"
           "        sharing_radius: auto\n        random_immigrants: 4\n"
           "      warm: {population_size: 10}\n");
  ASSERT_EQ(allPairs(scene).size(), 1U);
  const PairSettings settings = allPairs(scene)[0].settings;
  const TrackerParameters& tracker = settings.tracker;
  EXPECT_EQ(tracker.accuracy, AccuracyLevel::Nodes);
  EXPECT_EQ(tracker.cutoff, 2.0);
  EXPECT_EQ(tracker.least_prominence, 0.25);
  EXPECT_EQ(tracker.largest_niche_count, 7U);
  EXPECT_TRUE(tracker.hidden);
  EXPECT_TRUE(tracker.keep_through_material);
  EXPECT_EQ(tracker.inherited_per_niche, 4.5);
  EXPECT_EQ(tracker.inherited_limit, 11U);
  EXPECT_EQ(tracker.random_starts, 5U);
  EXPECT_EQ(tracker.search_share, 0.5);
  EXPECT_EQ(tracker.seed, 18446744073709551615ULL);
  EXPECT_EQ(settings.warning_distance, 0.125);
  EXPECT_EQ(settings.warning_hysteresis, 0.5);
  const GeneticParameters& cold = tracker.cold;
  EXPECT_EQ(cold.population_size, 80U);
  EXPECT_EQ(cold.max_generations, 9U);
  EXPECT_EQ(cold.crossover_probability, 0.75);
  EXPECT_EQ(cold.exchange_probability, 0.25);
  EXPECT_EQ(cold.mutation_probability, 0.0625);
  EXPECT_EQ(cold.random_immigrants, 4U);
  EXPECT_EQ(cold.sharing_radius, std::nullopt);
  EXPECT_EQ(cold.mating_radius, 0.4);
  EXPECT_EQ(tracker.warm.sharing_radius, 0.3);
  EXPECT_EQ(tracker.warm.mating_radius, 0.4);
  EXPECT_EQ(tracker.warm.niche_radius, 0.2);
  EXPECT_EQ(tracker.warm.population_size, 10U);
  EXPECT_EQ(tracker.warm.max_generations, TrackerParameters().warm.max_generations);
}

// The YAML blocks of the documentation, each a file of its own.
TEST_F(SceneFile, ExamplesOfTheDocumentationAreAccepted) {
  const std::string documentation = test::contentOf(CONCAVE_DISTANCE_SOURCE_DIR "/doc/scene_file.md");
  options.descriptions["robot_description"] = test::robot(
      test::boxLink("base_link") + test::boxLink("upper_arm") + test::boxLink("forearm") +
      test::boxLink("gripper") + test::boxLink("camera_mount") +
      test::joint("revolute", "base_link", "upper_arm") + test::joint("revolute", "upper_arm", "forearm") +
      test::joint("revolute", "forearm", "gripper") + test::joint("fixed", "gripper", "camera_mount"));
  options.descriptions["robot_description_semantic"] = "<robot name='arm'/>";
  const std::string fence = "```";
  int blocks = 0;
  for (std::size_t at = documentation.find(fence + "yaml"); at != std::string::npos;
       at = documentation.find(fence + "yaml", at + 1)) {
    const std::size_t begin = documentation.find('\n', at) + 1;
    const std::string example = documentation.substr(begin, documentation.find(fence, begin) - begin);
    EXPECT_EQ(refusal(example), "accepted") << example;
    ++blocks;
  }
  EXPECT_GE(blocks, 2);
}

TEST_F(SceneFile, WordsStandForNothing) {
  options.default_settings.warning_distance = 0.5;
  options.default_settings.tracker.cold.mutation_probability = 0.5;
  options.default_settings.tracker.cutoff = 3.0;
  const Scene scene = load(
      kBall +
      "  - {name: box, box: {size: [1, 1, 1]}, max_edge_length: 100}\n"
      "defaults: {warning_distance: none, cutoff: none, expert: {cold: {mutation_probability: auto}}}\n");
  const PairSettings settings = allPairs(scene).at(0).settings;
  EXPECT_EQ(settings.warning_distance, std::nullopt);
  EXPECT_EQ(settings.tracker.cutoff, std::numeric_limits<double>::infinity());
  EXPECT_EQ(settings.tracker.cold.mutation_probability, std::nullopt);
}

TEST_F(SceneFile, IsReadFromItsOwnFolder) {
  folder.write("scenes/t.stl", test::tetrahedronStl());
  const std::string path =
      folder.write("scenes/scene.yaml", "bodies: [{name: t, mesh: t.stl, max_edge_length: 9}]\n");
  EXPECT_EQ(bodyNames(loadSceneFile(path, options)), std::vector<std::string>{"t"});
  EXPECT_THROW(loadSceneFile(folder.path("gone.yaml"), options), Error);
  EXPECT_THROW(loadSceneFile(folder.path("scenes"), options), Error);
}

TEST_F(SceneFile, NamesTheParametersItNeeds) {
  const std::string path = folder.write("scene.yaml",
                                        "robots:\n"
                                        "  - {description: left, semantic_description: both, prefix: l_}\n"
                                        "  - {description: right, semantic_description: both, prefix: r_}\n"
                                        "  - {urdf: a.urdf, srdf: a.srdf}\n");
  EXPECT_EQ(descriptionsOfSceneFile(path), (std::vector<std::string>{"left", "both", "right"}));
}

}  // namespace
}  // namespace concave_distance::scene_file_test
