// A scene that is loaded again while it is edited and tracked: what the files left alone and what operations
// have made goes on; what the files changed is new; operations that no longer fit are named.
#include "scene/reload_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "concave_distance/scene/scene_tracker.h"
#include "scene/apply_operations.h"
#include "scene/equal_settings.h"
#include "support/scene_fixture.h"

namespace concave_distance::reload_scene_test {
namespace {

using Eigen::Isometry3d;
using namespace detail;
using test::mentions;
using Names = std::vector<std::string>;

Isometry3d at(double x, double y = 0.0, double z = 0.0) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

std::string boxOf(const std::string& name, double size) {
  const std::string edge = std::to_string(size);
  return "<link name='" + name + "'><collision><geometry><box size='" + edge + " " + edge + " " + edge +
         "'/></geometry></collision></link>";
}

/// A robot with a tool of this size; no tool for 0.
std::string armWith(double tool) {
  std::string content = test::boxLink("base") + test::boxLink("arm") + test::boxLink("hand") +
                        test::joint("revolute", "base", "arm") + test::joint("revolute", "arm", "hand");
  if (tool > 0.0) content += boxOf("tool", tool) + test::joint("revolute", "hand", "tool");
  return test::robot(content);
}

const std::string kCell = R"(
defaults: {max_edge_length: 0.5, cutoff: 50, expert: {cold: {population_size: 40}}}
robots: [{description: robot_description}]
bodies:
  - {name: shelf, frame: world, box: {size: [1, 1, 1]}, pose: {xyz: [0, 6, 0]}}
  - {name: part, frame: world, box: {size: [0.5, 0.5, 0.5]}, placed: {xyz: [3, 3, 3]}}
pairs:
  - {between: ['*', '*']}
  - {between: [hand, shelf], least_prominence: 0.02}
)";

/// Frames of tf by their poses in the world.
const std::map<std::string, Isometry3d> kFrames = {{"world", at(0)},       {"base", at(0)},
                                                   {"arm", at(2.5)},       {"hand", at(2.5, 2.5)},
                                                   {"tool", at(2.5, 4.5)}, {"old", at(7)}};
const FramesNow kNow = {"world", [](const std::string& target, const std::string& source) {
                          std::optional<FrameRelation> relation;
                          if (kFrames.count(target) == 0 || kFrames.count(source) == 0) return relation;
                          relation = FrameRelation{kFrames.at(target).inverse() * kFrames.at(source), false};
                          return relation;
                        }};

class ReloadSceneTest : public test::SceneTest {
 protected:
  ReloadSceneTest() {
    options.descriptions["robot_description"] = armWith(0.5);
    scene = load(kCell);
    tracker.setScene(scene);
  }

  void edit(std::vector<SceneOperation> operations) {
    const AppliedOperations applied = applyOperations(scene, operations, kNow);
    for (const OperationFault& fault : applied.faults) ADD_FAILURE() << fault.error.what();
    tracker.setScene(scene, false);
  }
  SceneOperation addition(const std::string& name, const std::string& frame, const Isometry3d& pose) const {
    BodyDescription description;
    description.name = name;
    description.frame = frame;
    description.primitive = "box";
    description.dimensions = {0.2, 0.2, 0.2};
    SceneOperation one = operation(OperationKind::Add, name);
    one.added = loadBody(description, "", options.package_locator, scene.pool);
    one.added->frame_from_body = pose;
    return one;
  }
  static SceneOperation operation(OperationKind kind, const std::string& body,
                                  const std::string& other = "") {
    SceneOperation one;
    one.kind = kind;
    one.body = body;
    one.other = other;
    one.frame = kind == OperationKind::Move ? "world" : "";
    one.frame_from_body = at(3, 3, 4);
    return one;
  }

  /// Serves what the files say now.
  ReloadReport reload(const std::string& yaml = kCell, bool drop_edits = false) {
    options.pool = scene.pool;
    ReloadReport report;
    scene = reloadedScene(scene, load(yaml), drop_edits, report);
    tracker.setScene(scene, true);
    return report;
  }

  void cycle() { cycle(tracker); }
  void cycle(SceneTracker& with) {
    time_ += 0.05;
    std::vector<std::optional<Isometry3d>> poses;
    for (const SceneBody& body : scene.bodies) {
      poses.emplace_back(kFrames.at(body.frame) * body.frame_from_body);
    }
    with.update(poses, time_);
  }

  struct Seen {
    std::vector<std::uint64_t> ids;
    const PairTracker* tracker = nullptr;
    double distance = 0.0;
    bool warm = false;
  };
  /// By the names of the pairs.
  std::map<std::string, Seen> seen() const { return seen(tracker); }
  static std::map<std::string, Seen> seen(const SceneTracker& of) {
    std::map<std::string, Seen> all;
    for (const auto& pair : of.pairs()) {
      Seen& one = all[pair->origin->name];
      one.tracker = pair->tracker();
      one.distance = pair->solution.distance;
      one.warm = pair->solution.warm;
      for (const TrackedNiche& niche : pair->solution.niches) one.ids.push_back(niche.id);
      std::sort(one.ids.begin(), one.ids.end());
    }
    return all;
  }

  const SceneBody& body(const std::string& name) const { return scene.bodies.at(*scene.findBody(name)); }
  bool watches(const std::string& a, const std::string& b) const {
    const auto pair = pairOf(scene, *scene.findBody(a), *scene.findBody(b));
    return pair && pair->enabled;
  }

  /// Bodies, rules and listed pairs are those of a scene that was loaded from nothing.
  void expectAsFresh(const std::string& yaml) {
    options.pool = nullptr;
    const Scene fresh = load(yaml);
    ASSERT_EQ(test::bodyNames(scene), test::bodyNames(fresh));
    EXPECT_EQ(test::pairNames(scene), test::pairNames(fresh));
    for (std::size_t i = 0; i < fresh.bodies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto pair = pairOf(scene, i, j);
        const auto other = pairOf(fresh, i, j);
        ASSERT_EQ(pair.has_value(), other.has_value());
        if (!pair) continue;
        EXPECT_EQ(pair->enabled, other->enabled) << pair->name;
        EXPECT_TRUE(haveEqualSettings(pair->settings, other->settings)) << pair->name;
      }
    }
  }

  Scene scene;
  SceneTracker tracker{{1, nullptr}};
  double time_ = 0.0;
};

TEST_F(ReloadSceneTest, ASwappedToolIsNewAndAllElseGoesOnWarm) {
  for (int i = 0; i < 3; ++i) cycle();
  const auto before = seen();
  options.descriptions["robot_description"] = armWith(0.8);
  const ReloadReport report = reload();
  EXPECT_EQ(report.kept, (Names{"base", "arm", "hand", "shelf", "part"}));
  EXPECT_EQ(report.replaced, Names{"tool"});
  EXPECT_TRUE(report.added.empty() && report.removed.empty() && report.dropped.empty());
  cycle();
  const auto after = seen();
  ASSERT_EQ(after.size(), before.size());
  int warm = 0;
  for (const auto& [name, now] : after) {
    const Seen& then = before.at(name);
    if (mentions(name, "tool")) {
      EXPECT_FALSE(now.warm) << name;
      EXPECT_NE(now.distance, then.distance) << name;
    } else {
      EXPECT_EQ(now.tracker, then.tracker) << name;
      EXPECT_EQ(now.ids, then.ids) << name;
      ++warm;
    }
  }
  EXPECT_EQ(warm, 7) << "of base, arm and hand with shelf and part, and base with hand";
  expectAsFresh(kCell);
}

TEST_F(ReloadSceneTest, OfFilesThatAreTheSameChangesNothing) {
  edit({addition("crate", "hand", at(0, 0, 1)), operation(OperationKind::Attach, "part", "tool"),
        operation(OperationKind::AllowContact, "crate", "shelf"),
        operation(OperationKind::AllowContact, "ba*", "part")});
  cycle();
  const auto before = seen();
  const Names pairs = test::pairNames(scene);
  const ReloadReport report = reload();
  EXPECT_EQ(report.kept_edits, Names{"crate"});
  EXPECT_TRUE(report.dropped.empty());
  cycle();
  const auto after = seen();
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [name, now] : after) {
    EXPECT_EQ(now.tracker, before.at(name).tracker) << name;
    EXPECT_EQ(now.ids, before.at(name).ids) << name;
  }
  EXPECT_EQ(test::pairNames(scene), pairs);
  EXPECT_FALSE(watches("crate", "shelf"));
  EXPECT_FALSE(watches("base", "part"));
  EXPECT_EQ(body("part").frame, "tool");
}

TEST_F(ReloadSceneTest, KeepsWhatIsAttachedToAToolThatWasSwapped) {
  edit({operation(OperationKind::Attach, "part", "tool"), addition("crate", "world", at(9))});
  options.descriptions["robot_description"] = armWith(0.8);
  reload();
  ASSERT_TRUE(body("part").attachment);
  EXPECT_EQ(body("part").attachment->parent_serial, body("tool").serial);
  EXPECT_FALSE(watches("part", "tool")) << "it moves with it";
  EXPECT_TRUE(watches("crate", "tool")) << "the new one, too";
}

TEST_F(ReloadSceneTest, PutsBackAndNamesWhatWasAttachedToALinkThatIsGone) {
  edit({operation(OperationKind::Attach, "part", "tool"), addition("crate", "world", at(9)),
        operation(OperationKind::Attach, "crate", "part")});
  options.descriptions["robot_description"] = armWith(0.0);
  const ReloadReport report = reload();
  EXPECT_EQ(report.removed, Names{"tool"});
  ASSERT_EQ(report.dropped.size(), 1U);
  EXPECT_EQ(report.dropped[0],
            "attach 'part': body 'part': there is no body 'tool', which it was attached to (attach it to "
            "another one: it is where it was before)");
  EXPECT_FALSE(body("part").attachment);
  EXPECT_EQ(body("part").frame, "world");
  EXPECT_EQ(body("part").frame_from_body.translation(), Eigen::Vector3d(3, 3, 3));
  ASSERT_TRUE(body("crate").attachment);
  EXPECT_EQ(body("crate").frame, "world");
  EXPECT_NEAR((body("crate").frame_from_body.matrix() - at(9).matrix()).norm(), 0.0, 1e-14);
}

TEST_F(ReloadSceneTest, TakesWhatTheFileChangedAndKeepsWhatEditsChanged) {
  SceneOperation wider = operation(OperationKind::SetMargin, "shelf");
  wider.margin = 0.1;
  edit({operation(OperationKind::Move, "part"), wider,
        operation(OperationKind::AllowContact, "base", "shelf"),
        operation(OperationKind::AllowContact, "arm", "par*")});
  SceneOperation warning = operation(OperationKind::SetWarningDistance, "");
  warning.pair = "hand/*";
  warning.warning_distance = 0.3;
  edit({warning});
  std::string changed = kCell;
  changed.replace(changed.find("cutoff: 50"), 10, "cutoff: 40");
  changed.replace(changed.find("[0, 6, 0]"), 9, "[0, 7, 0]");
  changed.replace(changed.find("[3, 3, 3]"), 9, "[5, 5, 5]");
  changed.replace(changed.find("least_prominence: 0.02"), 22, "least_prominence: 0.03");
  changed += "disable: [[base, part]]\n";
  const ReloadReport report = reload(changed);
  EXPECT_EQ(report.replaced, Names{"shelf"}) << "its pose is that of its geometry";
  EXPECT_EQ(report.kept, (Names{"base", "arm", "hand", "tool", "part"}));
  EXPECT_EQ(body("part").frame_from_body.translation(), Eigen::Vector3d(3, 3, 4)) << "where it was moved to";
  EXPECT_EQ(body("shelf").margin, 0.1);
  EXPECT_FALSE(watches("base", "shelf"));
  EXPECT_FALSE(watches("arm", "part"));
  EXPECT_FALSE(watches("base", "part")) << "as the file says now";
  EXPECT_TRUE(watches("arm", "shelf"));
  const auto settings = [&](const std::string& a, const std::string& b) {
    return pairOf(scene, *scene.findBody(a), *scene.findBody(b))->settings;
  };
  EXPECT_EQ(settings("hand", "shelf").warning_distance, 0.3);
  EXPECT_EQ(settings("hand", "shelf").tracker.cutoff, 40.0);
  EXPECT_EQ(settings("hand", "shelf").tracker.least_prominence, 0.03);
  EXPECT_EQ(settings("arm", "shelf").warning_distance, std::nullopt);
  EXPECT_EQ(settings("arm", "shelf").tracker.cutoff, 40.0);
}

TEST_F(ReloadSceneTest, CanDropAllEdits) {
  SceneOperation wider = operation(OperationKind::SetMargin, "shelf");
  wider.margin = 0.1;
  edit({operation(OperationKind::Move, "part"), wider, addition("crate", "hand", at(0)),
        operation(OperationKind::AllowContact, "base", "shelf"),
        operation(OperationKind::Attach, "part", "arm")});
  const std::uint64_t serial = body("part").serial;
  const ReloadReport report = reload(kCell, true);
  EXPECT_EQ(report.dropped, Names{"add 'crate': a service had added it"});
  EXPECT_TRUE(scene.operations.empty());
  EXPECT_EQ(body("part").serial, serial);
  EXPECT_EQ(body("shelf").margin, 0.0);
  expectAsFresh(kCell);
}

TEST_F(ReloadSceneTest, KeepsBodiesRemovedAndGivesWayToNewOnesOfTheSameName) {
  edit({operation(OperationKind::Remove, "part"), addition("crate", "hand", at(0)),
        addition("shelf2", "world", at(9))});
  const ReloadReport report = reload(kCell + "  # the end\n");
  EXPECT_EQ(scene.findBody("part"), std::nullopt) << "an edit has removed it";
  EXPECT_EQ(report.kept_edits, (Names{"part", "crate", "shelf2"}));
  std::string changed = kCell;
  changed.insert(changed.find("pairs:"), "  - {name: crate, frame: world, box: {size: [2, 2, 2]}}\n");
  const ReloadReport second = reload(changed);
  EXPECT_EQ(second.added, Names{"crate"});
  ASSERT_EQ(second.dropped.size(), 1U);
  EXPECT_TRUE(mentions(second.dropped[0], "add 'crate': name: there is a body 'crate' already"))
      << second.dropped[0];
  EXPECT_EQ(body("crate").frame, "world");
  // What does not fit is said once.
  EXPECT_TRUE(reload(changed).dropped.empty());
}

TEST_F(ReloadSceneTest, PairsWhoseBodiesChangePlacesAreRightAfterwards) {
  for (int i = 0; i < 2; ++i) cycle();
  std::string changed = kCell;
  const std::string shelf =
      "  - {name: shelf, frame: world, box: {size: [1, 1, 1]}, pose: {xyz: [0, 6, 0]}}\n";
  changed.erase(changed.find(shelf), shelf.size());
  changed.insert(changed.find("pairs:"), shelf);
  std::string urdf = armWith(0.5);
  const std::string hand = test::boxLink("hand");
  urdf.erase(urdf.find(hand), hand.size());
  urdf.insert(urdf.find(test::boxLink("base")), hand);
  options.descriptions["robot_description"] = urdf;
  const ReloadReport report = reload(changed);
  EXPECT_EQ(report.kept.size(), 6U);
  cycle();
  const auto after = seen();
  SceneTracker fresh({1, nullptr});
  fresh.setScene(scene);
  cycle(fresh);
  const auto expected = seen(fresh);
  ASSERT_EQ(after.size(), expected.size());
  for (const auto& [name, now] : after) EXPECT_NEAR(now.distance, expected.at(name).distance, 1e-12) << name;
}

TEST_F(ReloadSceneTest, LeavesOutAdditionsBeyondTheLimitOfBodies) {
  edit({addition("crate", "hand", at(0))});
  options.limits.bodies = 6;
  const ReloadReport report = reload();
  ASSERT_EQ(report.dropped.size(), 1U);
  EXPECT_TRUE(mentions(report.dropped[0], "add 'crate': scene: it has 6 bodies, the limit"))
      << report.dropped[0];
  EXPECT_EQ(scene.bodies.size(), 6U);
}

TEST_F(ReloadSceneTest, AChangedMeshFileIsReadAnew) {
  folder.write("part.stl", test::tetrahedronStl());
  std::string cell = kCell;
  cell.insert(cell.find("pairs:"), "  - {name: cast, frame: world, mesh: part.stl}\n");
  reload(cell);
  const double size = body("cast").mesh->diameter();
  EXPECT_EQ(reload(cell).kept.size(), 7U) << "the file is as it was";
  std::string larger = test::tetrahedronStl();
  for (std::size_t at = larger.find("0 0 3"); at != std::string::npos; at = larger.find("0 0 3"))
    larger.replace(at, 5, "0 0 5");
  folder.write("part.stl", larger);
  const ReloadReport report = reload(cell);
  EXPECT_EQ(report.replaced, Names{"cast"});
  EXPECT_GT(body("cast").mesh->diameter(), size);
}

TEST_F(ReloadSceneTest, NamesEachOperationThatNoLongerFits) {
  SceneOperation wide = operation(OperationKind::SetMargin, "shelf");
  wide.margin = 1.0;
  SceneOperation warning = operation(OperationKind::SetWarningDistance, "");
  warning.pair = "hand/shelf";
  warning.warning_distance = 45.0;
  SceneOperation pattern = operation(OperationKind::DisablePairs, "");
  pattern.pair = "too*/part";
  edit({wide, warning, pattern, operation(OperationKind::AllowContact, "tool", "shelf"),
        operation(OperationKind::Move, "part")});
  options.descriptions["robot_description"] = armWith(0.0);
  std::string changed = kCell;
  changed.replace(changed.find("[1, 1, 1]"), 9, "[.1, .1, .1]");
  changed.replace(changed.find("cutoff: 50"), 10, "cutoff: 40");
  const Names dropped = reload(changed).dropped;
  const Names expected = {
      "set_margin 'shelf'",
      "set_warning_distance 'hand/shelf': pair 'hand/shelf': warning_distance 45 m is beyond",
      "disable_pairs 'too*/part': pair: there is no pair 'too*/part'",
      "allow_contact 'tool': body_a: there is no body 'tool'"};
  ASSERT_EQ(dropped.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(dropped[i].rfind(expected[i], 0), 0U) << dropped[i];
  EXPECT_EQ(body("part").frame_from_body.translation(), Eigen::Vector3d(3, 3, 4)) << "what fits stays";
  EXPECT_EQ(pairOf(scene, *scene.findBody("hand"), *scene.findBody("shelf"))->settings.warning_distance,
            std::nullopt)
      << "what does not fit changes nothing";
}

}  // namespace
}  // namespace concave_distance::reload_scene_test
