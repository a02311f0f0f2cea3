// A scene that was edited at random, saved and loaded again is the same scene: bodies, rules and answers to
// the last bit. What cannot be written, and nonsense in what can.
#include "loading/saved_scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "base/random_engine.h"
#include "concave_distance/scene/scene_tracker.h"
#include "loading/scene_files.h"
#include "loading/set_effects.h"
#include "scene/apply_operations.h"
#include "scene/equal_settings.h"
#include "scene/journal.h"
#include "support/body_motions.h"
#include "support/random_solids.h"
#include "support/scene_fixture.h"
#include "support/solution_bytes.h"

namespace concave_distance::saved_scene_test {
namespace {

using Eigen::Isometry3d;
using namespace detail;
using test::mentions;
using Names = std::vector<std::string>;

// Two links that a fixed joint joins, two that move, one without geometry between them.
const std::string kUrdf = test::robot(
    test::boxLink("base") + test::boxLink("foot") + test::boxLink("arm") + test::bareLink("wrist") +
    test::boxLink("hand") + test::joint("fixed", "base", "foot") + test::joint("revolute", "base", "arm") +
    test::joint("revolute", "arm", "wrist") + test::joint("revolute", "wrist", "hand"));
const std::string kSrdf =
    "<robot name='arm'><group name='tool'><link name='hand'/></group>"
    "<disable_collisions link1='base' link2='hand' reason='never'/></robot>";
const std::string kScene = R"(
defaults: {max_edge_length: 0.5, cutoff: 4.0, warning_distance: 0.2, expert: {cold: {population_size: 40}}}
robots:
  - {description: robot_description, semantic_description: semantics, margin: 0.01, skip_links: ['bar?en']}
bodies:
  - {name: table, frame: world, box: {size: [2, 1, 0.1]}, pose: {xyz: [0.1, 0.2, -1], rpy: [0.1, 0.2, 0.3]}}
  - {name: "a cup", frame: world, cylinder: {radius: 0.2, length: 0.3}, pose: {xyz: [1, 2, 0.3]}, colour: [1, 0, 0]}
  - {name: "a:cup", frame: world, mesh: part.stl, scale: [0.5, -0.25, 0.3], margin: 0.002, material: {youngs_modulus: 1.0e9}}
  - {name: bracket, frame: hand, mesh: "package://arm_description/part.stl", scale: 0.3}
groups: {cell: [table, "a cup"], all: ['*'], none: []}
pairs:
  - {between: ['*', '*']}
  - {between: [tool, cell], cutoff: 5.0, least_prominence: 0.02}
  - {between: ["a cup", bracket], name: cup_at_bracket, warning_distance: none}
  - {between: [foot, arm], enabled: false}
disable: [[arm, "a:cup"]]
)";

const Isometry3d kHere = Isometry3d::Identity();
const std::vector<std::string> kFrames = {"world", "base", "arm", "hand", "bench"};

/// Poses of frames in the world; bench stands still in it.
struct Frames {
  std::map<std::string, Isometry3d> world_from;

  Frames(std::uint64_t seed, double time) {
    RandomEngine engine(seed);
    for (const char* frame : {"base", "arm", "hand"}) world_from[frame] = test::randomMotion(engine).at(time);
    world_from["foot"] = world_from["base"];
    world_from["world"] = kHere;
    world_from["bench"] = Isometry3d(Eigen::Translation3d(0.4, 0.3, 0.1));
  }
  FramesNow now() const {
    return {"world", [this](const std::string& target, const std::string& source) {
              std::optional<FrameRelation> relation;
              if (world_from.count(target) == 0 || world_from.count(source) == 0) return relation;
              const auto stands = [](const std::string& frame) {
                return frame == "world" || frame == "bench";
              };
              relation.emplace();
              relation->target_from_source = world_from.at(target).inverse() * world_from.at(source);
              relation->is_fixed = stands(target) && stands(source);
              return relation;
            }};
  }
  std::vector<std::optional<Isometry3d>> posesOf(const Scene& scene) const {
    std::vector<std::optional<Isometry3d>> poses;
    for (const SceneBody& body : scene.bodies) {
      const auto frame = world_from.find(body.frame);
      poses.emplace_back(frame == world_from.end()
                             ? std::nullopt
                             : std::optional<Isometry3d>(frame->second * body.frame_from_body));
    }
    return poses;
  }
};

class SavedSceneTest : public test::SceneTest {
 protected:
  SavedSceneTest() {
    folder.write("part.stl", test::tetrahedronStl());
    std::string urdf = kUrdf;
    urdf.insert(urdf.find("<joint"), test::boxLink("barren"));
    urdf.insert(urdf.find("<joint"), test::joint("revolute", "base", "barren"));
    options.descriptions = {{"robot_description", urdf}, {"semantics", kSrdf}};
  }

  Scene start() const { return load(kScene); }

  /// Saves it to a folder of its own and loads that.
  Scene reload(const Scene& scene) {
    const std::string path = folder.path() + "/saved" + std::to_string(++saved_) + "/cell.yaml";
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    writeScene(path, savedScene(scene, stemOf(path)), false);
    return loadSceneFile(path, options);
  }

  SceneOperation addition(const std::string& name, BodyDescription description, RandomEngine& engine,
                          const Scene& scene) const {
    description.name = name;
    description.frame = kFrames[engine() % kFrames.size()];
    if (description.frame == "base") description.frame = "bench";  // frames of links move
    description.max_edge_length = scene.defaults.max_edge_length;
    SceneOperation operation;
    operation.kind = OperationKind::Add;
    operation.body = name;
    operation.added = loadBody(description, folder.path(), options.package_locator, scene.pool);
    operation.added->frame_from_body = test::randomMotion(engine).at(1.0);
    operation.added->colour[0] = uniformUnit(engine);
    operation.added->margin = engine() % 3 == 0 ? 0.01 * uniformUnit(engine) : 0.0;
    return operation;
  }

  static std::shared_ptr<const TriangleSoup> soupOf(const SurfaceMesh& mesh) {
    auto soup = std::make_shared<TriangleSoup>();
    soup->vertices = mesh.vertices();
    for (const TriangleNodes& t : mesh.triangles())
      soup->triangles.push_back({t[0].value, t[1].value, t[2].value});
    soup->triangles.push_back({0, 0, 1});  // degenerate, and a vertex that nobody uses
    soup->vertices.emplace_back(0.1, 0.2, 0.3);
    return soup;
  }

  static BodyDescription randomShape(RandomEngine& engine) {
    BodyDescription shape;
    const Isometry3d pose = engine() % 2 == 0 ? kHere : test::randomMotion(engine).at(0.3);
    shape.frame_from_geometry = pose;
    switch (engine() % 5) {
      case 0:
        shape.primitive = "capsule";
        shape.dimensions = {0.1 + 0.1 * uniformUnit(engine), 0.3};
        break;
      case 1:
        shape.mesh_resource = "part.stl";
        shape.scale = Eigen::Vector3d(0.3, 0.2, 0.1 + uniformUnit(engine));
        break;
      case 2:
        shape.primitive = "box";
        shape.dimensions = {0.3, 0.2, 0.1 + uniformUnit(engine)};
        shape.other_shapes.emplace_back();
        shape.other_shapes.back().triangles = soupOf(test::randomStar(engine));
        shape.other_shapes.back().frame_from_geometry = test::randomMotion(engine).at(0.1);
        break;
      default:
        shape.triangles = soupOf(test::randomStar(engine));
    }
    return shape;
  }

  /// One edit of any kind; some are refused, which changes nothing.
  void edit(Scene& scene, RandomEngine& engine) {
    const Frames frames(7, uniformUnit(engine));
    const auto any = [&] { return scene.bodies[engine() % scene.bodies.size()].name; };
    const auto any_side = [&]() -> std::string {
      const Names sides = {
          any(), any(), any(), any(), any(), "cell", "tool", "b*", engine() % 4 == 0 ? "*" : "a*"};
      return sides[engine() % sides.size()];
    };
    SceneOperation one;
    switch (engine() % 12) {
      case 0:
      case 1:
        ++added_;
        one = addition("b" + std::to_string(added_) + (added_ % 4 == 0 ? "/part" : ""), randomShape(engine),
                       engine, scene);
        if (engine() % 3 == 0) one.partners.names = {any(), "cell"};
        if (one.partners.names.empty() && engine() % 3 == 0) one.partners.may_touch = {any_side()};
        if (one.partners.names.empty() && engine() % 5 == 0) {
          one.partners.may_touch.clear();
          one.partners.none = true;
        }
        if (engine() % 3 == 0) one.warning_distance = 0.1 * static_cast<double>(engine() % 3);
        break;
      case 2:
        one.kind = OperationKind::Remove;
        one.body = any();
        one.allow_robot_link = engine() % 4 == 0;
        break;
      case 3:
      case 4:
        one.kind = OperationKind::Move;
        one.body = any();
        one.frame = kFrames[engine() % kFrames.size()];
        one.frame_from_body = test::randomMotion(engine).at(0.7);
        break;
      case 5:
      case 6:
        one.kind = OperationKind::Attach;
        one.body = any();
        one.other = engine() % 4 == 0 ? "bench" : any();
        one.touch_links = {any_side()};
        break;
      case 7:
        one.kind = OperationKind::Detach;
        one.body = any();
        break;
      case 8:
      case 9:
        one.kind = engine() % 2 == 0 ? OperationKind::AllowContact : OperationKind::DisallowContact;
        one.body = any_side();
        one.other = any_side();
        break;
      case 10:
        one.kind = OperationKind::SetMargin;
        one.body = any_side();
        one.margin = 0.01 * uniformUnit(engine);
        break;
      default:
        editSettings(scene, engine);
        return;
    }
    Scene edited = scene;
    if (applyOperations(edited, {one}, frames.now()).faults.empty()) {
      scene = std::move(edited);
      ++applied_;
    }
  }

  static void editSettings(Scene& scene, RandomEngine& engine) {
    Scene edited = scene;
    const Names patterns = {"*/table", "b?/*", "a*", "*", "cup_at_bracket", "arm/table", "*b*/*a*"};
    const std::string& pattern = patterns[engine() % patterns.size()];
    try {
      if (engine() % 2 == 0) {
        SceneOperation warning;
        warning.kind = OperationKind::SetWarningDistance;
        warning.pair = pattern;
        if (engine() % 3 != 0) warning.warning_distance = uniformUnit(engine);
        warning.warning_hysteresis = 0.05;
        applyOperation(edited, warning, {});
      } else {
        setEffects(edited, pattern, engine() % 2 == 0 ? "{normal_force: hertz, friction: bristle}" : "none");
      }
      scene = std::move(edited);
    } catch (const Error&) {
      // No such pair any more.
    }
  }

  int saved_ = 0;
  int added_ = 0;
  int applied_ = 0;
};

std::string nameOf(const Scene& scene, std::uint64_t serial) {
  for (const SceneBody& body : scene.bodies) {
    if (body.serial == serial) return body.name;
  }
  return "";
}

/// Everything of a body but its serials, as one text for messages and bytes to compare.
test::Bytes bytesOf(const Scene& scene, const SceneBody& body) {
  test::Bytes bytes;
  test::appendAll(bytes, body.frame_from_body.matrix(), body.margin, body.colour, body.is_robot_link,
                  body.in_robot_model, body.material.youngs_modulus, body.mesh->surface().triangleCount());
  for (const Eigen::Vector3d& vertex : body.mesh->surface().vertices()) test::appendAll(bytes, vertex);
  std::ostringstream text;
  text << body.name << "|" << body.frame << "|" << body.pairLabel() << "|" << nameOf(scene, body.carrier)
       << "|" << (body.attachment ? body.attachment->parent : "") << "|"
       << (body.attachment ? nameOf(scene, body.attachment->carrier_before) : "");
  for (const char c : text.str()) test::appendAll(bytes, c);
  return bytes;
}

void expectSamePairs(const Scene& scene, const Scene& loaded) {
  const auto listed = [](const Scene& of) {
    std::set<std::string> names;
    for (const ScenePair& pair : of.pairs) names.insert(pair.name);
    return names;
  };
  EXPECT_EQ(listed(scene), listed(loaded));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const std::string both = scene.bodies[i].name + " and " + scene.bodies[j].name;
      const auto pair = pairOf(scene, i, j);
      const auto other = pairOf(loaded, i, j);
      ASSERT_EQ(pair.has_value(), other.has_value()) << both;
      if (!pair) continue;
      EXPECT_EQ(pair->name, other->name);
      EXPECT_EQ(pair->body_a, other->body_a) << both;
      EXPECT_EQ(pair->enabled, other->enabled) << both;
      EXPECT_TRUE(haveEqualSettings(pair->settings, other->settings)) << both;
      EXPECT_EQ(pair->settings.tracker.cold.population_size, other->settings.tracker.cold.population_size);
    }
  }
  EXPECT_EQ(countPairsByRule(scene), countPairsByRule(loaded));
}

void expectSameScene(const Scene& scene, const Scene& loaded) {
  ASSERT_EQ(test::bodyNames(scene), test::bodyNames(loaded));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    EXPECT_EQ(bytesOf(scene, scene.bodies[i]), bytesOf(loaded, loaded.bodies[i])) << scene.bodies[i].name;
  }
  for (const auto& problem : loaded.problems) ADD_FAILURE() << problem.where << ": " << problem.message;
  expectSamePairs(scene, loaded);
}

/// The answers of a fresh tracker over some cycles.
std::map<std::string, test::Bytes> answers(const Scene& scene) {
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  std::map<std::string, test::Bytes> all;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const Frames frames(11, 0.1 * cycle);
    tracker.update(frames.posesOf(scene), 0.1 * cycle);
    for (const auto& pair : tracker.pairs()) {
      if (pair->solved()) test::appendSolution(pair->solution, all[pair->origin->name]);
    }
  }
  return all;
}

TEST_F(SavedSceneTest, IsLoadedAsItWasAfterRandomEdits) {
  std::size_t answered = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    Scene scene = start();
    for (int i = 0; i < 40; ++i) edit(scene, engine);
    const Scene loaded = reload(scene);
    expectSameScene(scene, loaded);
    if (HasFailure()) return;
    const auto expected = answers(scene);
    EXPECT_EQ(expected, answers(loaded));
    answered += expected.size();

    // Both go on alike.
    Scene later = loaded;
    RandomEngine other_engine = engine;
    const int added = added_;
    for (int i = 0; i < 10; ++i) edit(scene, engine);
    added_ = added;
    for (int i = 0; i < 10; ++i) edit(later, other_engine);
    expectSamePairs(scene, later);
  }
  EXPECT_GT(applied_, 200) << "edits that were not refused";
  EXPECT_GT(answered, 100U) << "pairs";
}

TEST_F(SavedSceneTest, SaysTheSameWhenItIsSavedAgain) {
  RandomEngine engine(5);
  Scene scene = start();
  for (int i = 0; i < 40; ++i) edit(scene, engine);
  const Scene once = reload(scene);
  const auto first = savedScene(once, "cell");
  const auto second = savedScene(reload(once), "cell");
  ASSERT_EQ(first.size(), second.size());
  EXPECT_GT(savedScene(scene, "cell").size(), 1U) << "with meshes, which are files from then on";
  EXPECT_EQ(first[0].text, second[0].text);
}

TEST_F(SavedSceneTest, KeepsTheFileAsItWasAndFindsItsMeshesFromElsewhere) {
  for (const std::string& text :
       {"# My cell.\n" + kScene, std::string("{bodies: [{name: cast, mesh: part.stl}]}"),
        std::string("%YAML 1.2\n---\n  bodies:  # indented\n  - {name: cast, mesh: part.stl}"),
        std::string("bodies: []\n...\n"), std::string("{}")}) {
    const Scene scene = load(text);
    const std::string saved = savedScene(scene, "cell").front().text;
    EXPECT_TRUE(mentions(saved, "\n" + text)) << saved;
    const Scene loaded = reload(scene);
    EXPECT_EQ(loaded.file->text,
              std::string(kSavedSceneMark) + "\n" + text + (text.back() == '\n' ? "" : "\n"));
    EXPECT_TRUE(loaded.problems.empty()) << loaded.problems.front().message;
    EXPECT_EQ(test::bodyNames(loaded), test::bodyNames(scene));
  }
}

TEST_F(SavedSceneTest, TellsTheOperationsOfTheFileFromThoseSince) {
  Scene scene = start();
  RandomEngine engine(3);
  BodyDescription box;
  box.primitive = "box";
  box.dimensions = {1, 1, 1};
  const SceneOperation add = addition("crate", box, engine, scene);
  applyOperation(scene, add, {});
  Scene loaded = reload(scene);
  EXPECT_TRUE(loaded.operations.empty());
  ASSERT_EQ(loaded.file->operations.size(), 1U);
  SceneOperation remove;
  remove.kind = OperationKind::Remove;
  remove.body = "crate";
  applyOperation(loaded, remove, {});
  EXPECT_EQ(loaded.operations.size(), 1U);
  EXPECT_TRUE(wholeJournal(loaded).empty()) << "one makes the other void";
}

TEST_F(SavedSceneTest, OfOneRobotWithoutASceneFileLoadsTheSame) {
  options.automatic_cutoff = true;
  options.skip_overlapping_pairs = true;
  options.descriptions["robot_description_semantic"] = kSrdf;
  std::string urdf = kUrdf;
  urdf.insert(urdf.find("</robot>"), test::boxLink("twin") + test::joint("revolute", "wrist", "twin"));
  options.descriptions["robot_description"] = urdf;
  options.default_settings.tracker.cold.population_size = 40;
  const Scene scene = loadRobotScene(urdf, "robot_description", options);
  ASSERT_TRUE(mentions(scene.file->text, "disable:\n")) << "hand and twin are at one place";
  const Scene loaded = reload(scene);
  ASSERT_EQ(test::bodyNames(scene), test::bodyNames(loaded));
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto pair = pairOf(scene, i, j);
      const auto other = pairOf(loaded, i, j);
      EXPECT_EQ(pair && pair->enabled, other && other->enabled);
      if (pair && pair->enabled) {
        EXPECT_TRUE(haveEqualSettings(pair->settings, other->settings));
      }
    }
  }
  EXPECT_EQ(loaded.defaults.pairs.tracker.cutoff, *scene.automatic_cutoff);
}

TEST_F(SavedSceneTest, CannotSayWhatItDoesNotKnow) {
  Scene scene = start();
  RandomEngine engine(3);
  BodyDescription box;
  box.primitive = "box";
  box.dimensions = {1, 1, 1};
  SceneOperation add = addition("crate", box, engine, scene);
  add.added->origin = nullptr;
  applyOperation(scene, add, {});
  const auto refused = [](const Scene& unknown) -> std::string {
    try {
      savedScene(unknown, "cell");
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_TRUE(mentions(refused(scene), "body 'crate': where its shape came from is not known"));
  EXPECT_TRUE(mentions(refused(Scene()), "scene: it was not loaded from a file"));
}

TEST_F(SavedSceneTest, OperationsOfFilesRefuseNonsense) {
  const auto second = [&](const std::string& text) {
    return refusal("bodies:\n  - {name: t, box: {size: [1, 1, 1]}}\n---\n" + text + "\n");
  };
  const auto one = [&](const std::string& fields) { return second("operations:\n  - {" + fields + "}"); };
  EXPECT_EQ(one("operation: set_margin, body: t, margin: 0.1"), "accepted");
  EXPECT_EQ(second("{folder: /tmp, operations: []}"), "accepted");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {second("bodies: []"), "scene.yaml:4: 'operations' is missing"},
      {second("{operations: [], bodies: []}"),
       "scene.yaml:4, bodies: key 'bodies' is not known (allowed: folder, operations)"},
      {second("operations: all"),
       "scene.yaml:4, operations: the value is 'all' (allowed: a list of operations)"},
      {second("- a"), "a map with operations"},
      {second(""), "a map with operations"},
      {second("operations: [{"), ": no YAML"},
      {second("operations: []\n---\noperations: []"), "2 YAML documents or more"},
      {second("operations: [3]"), "operations[0]: the value is '3' (allowed: a map with operation"},
      {one("body: t"), "scene.yaml:5, operations[0]: 'operation' is missing"},
      {one("operation: explode, body: t"),
       "scene.yaml:5, operations[0].operation: the value is 'explode' (allowed: add, move"},
      {one("operation: move, frame_id: w"), "'body' is missing (name the body)"},
      {one("operation: move, body: t"), "'frame_id' is missing"},
      {one("operation: move, body: t, frame_id: 'a b'"), "operations[0].frame_id"},
      {one("operation: move, body: t, frame_id: w, pose: {xyz: [1, 2]}"), "pose.xyz"},
      {one("operation: move, body: t, frame_id: w, margin: 1"),
       "key 'margin' is not known (allowed: operation, body, frame_id, pose)"},
      {one("operation: set_margin, body: t, margin: -1"), "operations[0].margin"},
      {one("operation: add, body: s, frame_id: w"), "'shapes' is missing"},
      {one("operation: add, body: s, frame_id: w, shapes: []"), "a list of at least one shape"},
      {one("operation: add, body: s, frame_id: w, shapes: [{cube: 1}]"), "no geometry"},
      {one("operation: add, body: s, frame_id: w, shapes: [{sphere: {radius: 1}}], pair_with: t"),
       "a list of texts"},
      {one("operation: attach, body: t"), "'other' is missing"},
      {one("operation: allow_contact, body: t"), "'other' is missing (name the other side)"},
      {one("operation: disable_pairs, body: t"), "'pair' is missing"},
      {one("operation: set_effects, pair: '*', effects: {}"), "operations[0].effects"},
      {one("operation: set_effects, pair: '*', effects: '{'"), "operations[0].effects:"},
      {one("operation: set_warning_distance, pair: '*', warning_distance: near"), "warning_distance"},
  };
  for (const auto& [message, part] : expected)
    EXPECT_TRUE(mentions(message, part)) << part << " in: " << message;
  std::string huge = "operations: [";
  for (int i = 0; i < 1'000'000; ++i) huge += "0,";
  EXPECT_TRUE(mentions(second(huge + "]"), "scene.yaml: more than 1000000 values (leave out"));
}

TEST_F(SavedSceneTest, OperationsThatDoNotFitAreProblemsAndTheRestIsServed) {
  const Scene scene = load(
      "bodies:\n  - {name: t, frame: w, box: {size: [1, 1, 1]}}\n  - {name: u, frame: w, box: {size: [1, 1, "
      "1]}}\n---\n"
      "operations:\n"
      "  - {operation: add, body: s, frame_id: w, shapes: [{mesh: none.stl}]}\n"
      "  - {operation: move, body: s, frame_id: w}\n"
      "  - {operation: add, body: t, frame_id: w, shapes: [{sphere: {radius: 1}}]}\n"
      "  - {operation: remove, body: nobody}\n"
      "  - {operation: attach, body: t, other: tool}\n"
      "  - {operation: set_margin, body: t, margin: 100}\n"
      "  - {operation: set_effects, pair: t/u, effects: '{friction: bristle}'}\n"
      "  - {operation: set_warning_distance, pair: a/b, warning_distance: 1}\n"
      "  - {operation: add, body: ball, frame_id: v, shapes: [{sphere: {radius: 1}}], pair_with: [t, s, "
      "gone], "
      "margin: 0.5}\n"
      "  - {operation: detach, body: u, frame_id: v, pose: {xyz: [1, 2, 3]}}\n"
      "  - {operation: set_margin, body: 'v*', margin: 0.1}\n");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"scene.yaml:6, operations[0]", "add 's' is left out: shapes: "},
      {"scene.yaml:8, operations[2]",
       "add 't' is left out: name: there is a body 't' already (remove_body it first)"},
      {"scene.yaml:9, operations[3]", "remove 'nobody' is left out: body: there is no body 'nobody'"},
      {"scene.yaml:10, operations[4]",
       "attach 't' is left out: body 't': there is no body 'tool', which it was attached to"},
      {"scene.yaml:11, operations[5]", "set_margin 't' is left out: body 't'"},
      {"scene.yaml:12, operations[6]", "set_effects 't/u' is left out: "},
      {"scene.yaml:13, operations[7]",
       "set_warning_distance 'a/b' is left out: pair: there is no pair 'a/b'"},
  };
  ASSERT_EQ(scene.problems.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(scene.problems[i].where, expected[i].first);
    EXPECT_EQ(scene.problems[i].message.rfind(expected[i].second, 0), 0U) << scene.problems[i].message;
  }
  EXPECT_TRUE(
      test::hasNote(scene, "scene.yaml:14, operations[8]: add 'ball' names what is no body: s, gone"));
  EXPECT_TRUE(test::hasNote(scene, "scene.yaml:16, operations[10]: set_margin 'v*' is left out: body: 'v*'"));
  EXPECT_EQ(test::bodyNames(scene), (Names{"t", "u", "ball"}));
  EXPECT_EQ(scene.bodies[1].frame_from_body.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scene.file->operations.size(), 2U) << "what does not fit is not saved again";
  options.strict = true;
  EXPECT_TRUE(mentions(refusal("bodies: []\n---\noperations: [{operation: remove, body: t}]"),
                       "remove 't' is left out"));
}

TEST_F(SavedSceneTest, KeysOfSavedScenesRefuseNonsense) {
  const auto of_body = [&](const std::string& more) {
    return refusal(
        "bodies:\n  - {name: t, frame: world, box: {size: [1, 1, 1]}}\n"
        "  - {name: s, frame: world, " +
        more + "}\ngroups: {g: [t]}\n");
  };
  const auto box = [&](const std::string& more) { return of_body("box: {size: [1, 1, 1]}, " + more); };
  EXPECT_EQ(box("placed: {xyz: [1, 2, 3]}, label: one/two"), "accepted");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {of_body("shapes: []"), "a list of at least one shape"},
      {of_body("shapes: [{scale: 2}]"), "no geometry"},
      {of_body("shapes: [{box: {size: [1, 1, 1]}, margin: 1}]"), "shapes[0]"},
      {of_body("shapes: [{box: {size: [1, 1, 1]}}], box: {size: [1, 1, 1]}"), "box"},
      {box("placed: {rotation: [1, 0, 0, 0, 1, 0, 0, 0]}"), "nine numbers"},
      {box("placed: {rotation: [1, 0, 0, 0, 1, 0, 0, 0, -1]}"), "a rotation without mirroring"},
      {box("placed: {rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1.01]}"), "a rotation without mirroring"},
      {box("placed: {rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], rpy: [0, 0, 0]}"), "both 'rotation' and 'rpy'"},
      {box("label: 'a b'"), "letters, digits, _ and single /"},
      {refusal("bodies:\n  - {name: t, label: x, box: {size: [1, 1, 1]}}\n"
               "  - {name: s, label: x, box: {size: [1, 1, 1]}}\n"),
       "the label 'x' is taken"},
      {refusal("robots:\n  - {description: robot_description, links: {wrist: {margin: 1}}}\n"),
       "'wrist' is no link of robot 'arm' that becomes a body"},
      {refusal("robots:\n  - {description: robot_description, links: {arm: {margin: -1}}}\n"), "margin"},
  };
  for (const auto& [message, part] : expected)
    EXPECT_TRUE(mentions(message, part)) << part << " in: " << message;
}

TEST_F(SavedSceneTest, EntriesOfSavedPairsRefuseNonsense) {
  const auto entry = [&](const std::string& text) {
    return refusal(
        "bodies:\n  - {name: s, box: {size: [1, 1, 1]}}\n  - {name: t, box: {size: [1, 1, 1]}}\n"
        "pairs:\n  - {" +
        text + "}\n");
  };
  EXPECT_EQ(entry("between: [[s], [t]]"), "accepted");
  EXPECT_EQ(entry("earlier: [s], later: '*', body_a: later, watched: false, cutoff: 1"), "accepted");
  const std::vector<std::pair<std::string, std::string>> expected = {
      {entry("between: [[], [t]]"), "at least one"},
      {entry("between: [[s], [nobody]]"), "'nobody' is not a body"},
      {entry("between: [[s], [t]], name: x"), "for more than one pair"},
      {entry("earlier: s"), "give the other side of 'earlier'"},
      {entry("earlier: s, later: t, between: [s, t]"), "give one of them"},
      {entry("earlier: s, later: t, body_a: s"), "earlier, later"},
      {entry("earlier: s, later: t, watched: 3"), "watched"},
  };
  for (const auto& [message, part] : expected)
    EXPECT_TRUE(mentions(message, part)) << part << " in: " << message;
}

}  // namespace
}  // namespace concave_distance::saved_scene_test
