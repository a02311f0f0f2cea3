// get_scene, save_scene and reload of a running node: a second node builds the same scene; a tool is changed
// while all else goes on; nonsense.
#include <concave_distance/ApplyScene.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetScene.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/Niches.h>
#include <concave_distance/Reload.h>
#include <concave_distance/SaveScene.h>
#include <gtest/gtest.h>
#include <ros/package.h>
#include <ros/param.h>
#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "node_access.h"
#include "operation_messages.h"
#include "started_node.h"
#include "support/temporary_folder.h"
#include "tf_player.h"

namespace concave_distance::state_rostest {
namespace {

const std::string kSecond = "/second/";

/// A tetrahedron whose corners no single precision holds.
SceneOperation wedge(const std::string& body) {
  SceneOperation message = operation(SceneOperation::ADD, body);
  message.frame_id = "world";
  message.pose = at(3.1, 0.7);
  message.pose.orientation.z = std::sin(0.3);
  message.pose.orientation.w = std::cos(0.3);
  message.meshes.resize(1);
  for (const auto& pose : {at(0.1), at(1.0 / 3.0), at(0, 0.7), at(0, 0, 0.9)})
    message.meshes[0].vertices.push_back(pose.position);
  for (const auto& corners : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    message.meshes[0].triangles.emplace_back();
    std::copy(corners.begin(), corners.end(), message.meshes[0].triangles.back().vertex_indices.begin());
  }
  return message;
}

SceneOperation capsule(const std::string& body) {
  SceneOperation message = operation(SceneOperation::ADD, body);
  message.frame_id = "world";
  message.pose = at(-3.0);
  message.primitives.resize(1);
  message.primitives[0].type = SceneOperation::CAPSULE;
  message.primitives[0].dimensions = {0.6, 0.2};
  message.margin = 0.01;
  return message;
}

void apply(const std::vector<SceneOperation>& operations) {
  ApplySceneRequest request;
  request.operations = operations;
  const auto response = call<ApplyScene>(kNode + "apply_scene", request);
  EXPECT_TRUE(response.success) << response.message;
}

double distanceOf(const std::string& node, const std::string& a, const std::string& b) {
  GetDistanceRequest request;
  request.query.body_a = a;
  request.query.body_b = b;
  const auto response = call<GetDistance>(node + "get_distance", request);
  EXPECT_TRUE(response.success) << response.message;
  return response.result.nearest.distance;
}

GetSceneResponse getScene(const std::string& node = kNode, bool with_meshes = true) {
  GetSceneRequest request;
  request.with_meshes = static_cast<std::uint8_t>(with_meshes);
  const auto response = call<GetScene>(node + "get_scene", request);
  EXPECT_TRUE(response.success) << response.message;
  return response;
}

const BodyState& find(const GetSceneResponse& state, const std::string& body) {
  const auto found = std::find_if(state.bodies.begin(), state.bodies.end(),
                                  [&](const BodyState& one) { return one.info.name == body; });
  EXPECT_NE(found, state.bodies.end()) << body;
  return found == state.bodies.end() ? state.bodies.front() : *found;
}

ReloadResponse reload(bool drop_edits = false) {
  ReloadRequest request;
  request.drop_edits = static_cast<std::uint8_t>(drop_edits);
  return call<Reload>(kNode + "reload", request);
}

SaveSceneResponse save(const std::string& path, bool overwrite = false) {
  SaveSceneRequest request;
  request.path = path;
  request.overwrite = static_cast<std::uint8_t>(overwrite);
  return call<SaveScene>(kNode + "save_scene", request);
}

void expectRefused(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

std::string urdf() {
  return test::contentOf(ros::package::getPath("concave_distance") + "/test/ros/rostest/tool_changer.urdf");
}

class State : public ::testing::Test {
 protected:
  State() {
    player.place("base", 0.0);
    player.place("tip", 0.0, 3.0);
    EXPECT_TRUE(eventually([] { return call<ListBodies>(kNode + "list_bodies", {}).ready != 0; }));
    EXPECT_TRUE(eventually([] { return std::abs(distanceOf(kNode, "base", "tip") - 2.0) < 1e-9; }));
  }
  ~State() override {
    ros::param::set("/robot_description", urdf());
    EXPECT_TRUE(reload(true).success);
  }

  /// Niches' ids of a pair in a message that comes from now on.
  std::vector<std::uint64_t> idsOf(const std::string& pair) {
    std::vector<std::uint64_t> ids;
    niches.clear();
    EXPECT_TRUE(niches.waitFor([&](const Niches& message) {
      for (const PairNiches& one : message.pairs) {
        if (one.nearest.pair != pair || one.niches.empty()) continue;
        ids.clear();
        for (const Niche& niche : one.niches) ids.push_back(niche.id);
        return true;
      }
      return false;
    })) << pair;
    return ids;
  }
  bool diagnoses(const std::string& parameter) {
    diagnostics.clear();
    return diagnostics.waitFor([&](const diagnostic_msgs::DiagnosticArray& message) {
      return !message.status.empty() && diagnosed(message, "changed description") == parameter;
    });
  }

  TfPlayer player;
  Collector<Niches> niches{kNode + "niches"};
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics{"/diagnostics"};
  Collector<rosgraph_msgs::Log> log{"/rosout"};
};

TEST_F(State, GetSceneSaysWhereEachBodyIsAndHowToMakeItAgain) {
  apply({wedge("wedge"), capsule("pill"), operation(SceneOperation::ALLOW_CONTACT, "wedge", "base"),
         operation(SceneOperation::ALLOW_CONTACT, "wedge", "ti*")});
  SceneOperation gripped = operation(SceneOperation::ATTACH, "pill", "tip");
  gripped.touch_links = {"base"};
  apply({gripped});
  const double before = distanceOf(kNode, "wedge", "base");
  const GetSceneResponse state = getScene();
  EXPECT_EQ(state.reference_frame, "world");
  EXPECT_EQ(state.cutoff, 1000.0);
  ASSERT_EQ(state.bodies.size(), 5U);
  EXPECT_TRUE(find(state, "tip").is_robot_link);
  EXPECT_EQ(find(state, "tip").pose_now.position.y, 3.0);
  const BodyState& pill = find(state, "pill");
  EXPECT_EQ(pill.info.attached_to, "tip");
  EXPECT_EQ(pill.touch_links, std::vector<std::string>{"base"});
  EXPECT_EQ(pill.info.margin, 0.01);
  EXPECT_NEAR(pill.pose_now.position.x, -3.0, 1e-12);
  EXPECT_NEAR(pill.info.pose.position.y, -3.0, 1e-12) << "in the frame of the tip";
  ASSERT_EQ(pill.add.primitives.size(), 1U);
  EXPECT_EQ(pill.add.primitives[0].dimensions, (std::vector<double>{0.6, 0.2}));
  const auto switched_off = [](const std::vector<PairInfo>& pairs, const std::string& name) {
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](const PairInfo& pair) { return pair.name == name && pair.enabled == 0; });
  };
  EXPECT_TRUE(switched_off(state.named_pairs, "wedge/base"));
  EXPECT_TRUE(switched_off(state.named_pairs, "wedge/tip"))
      << "few pairs have topics of their own, so they are named";
  EXPECT_TRUE(state.allowed_contacts.empty());
  ASSERT_EQ(state.groups.size(), 1U);
  EXPECT_EQ(state.groups[0].name, "changer");
  ASSERT_EQ(state.files.size(), 2U);
  EXPECT_EQ(state.files[0].name, "scene.yaml");
  EXPECT_NE(state.files[0].text.find(state.files[1].name), std::string::npos);
  EXPECT_EQ(getScene(kNode, false).files.size(), 1U);

  apply({operation(SceneOperation::REMOVE, "wedge"), find(state, "wedge").add});
  EXPECT_NEAR(distanceOf(kNode, "wedge", "base"), before, 1e-12);
}

TEST_F(State, ASavedSceneIsTheSameInASecondNode) {
  apply({wedge("wedge"), capsule("pill"), operation(SceneOperation::ATTACH, "pill", "tip")});
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/cell.yaml";
  const SaveSceneResponse saved = save(path);
  ASSERT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(saved.files.size(), 2U);
  const std::string original =
      test::contentOf(ros::package::getPath("concave_distance") + "/test/ros/rostest/tool_changer.yaml");
  EXPECT_NE(test::contentOf(path).find(original), std::string::npos) << "with its comments";

  expectRefused(save(path).message, "the file is there already");
  EXPECT_TRUE(save(path, true).success);
  expectRefused(save("/etc/cell.yaml", true).message, "is not below");
  expectRefused(save(folder.path() + "/cell.obj").message, "ends in .yaml");
  expectRefused(save(folder.path() + "/none/cell.yaml").message, "there is no folder");
  expectRefused(save("").message, "ends in .yaml");
  folder.write("mine.yaml", "bodies: []\n");
  expectRefused(save(folder.path() + "/mine.yaml", true).message, "no scene that save_scene has written");

  const StartedNode node({"__name:=second", "_scene_file:=" + path, "_stale_after:=10"});
  ASSERT_TRUE(eventually([] { return call<ListBodies>(kSecond + "list_bodies", {}).ready != 0; }));
  const std::vector<std::string> bodies = {"base", "tip", "shelf", "wedge", "pill"};
  ASSERT_TRUE(eventually([] { return std::abs(distanceOf(kSecond, "base", "tip") - 2.0) < 1e-9; }));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(distanceOf(kNode, bodies[i], bodies[j]), distanceOf(kSecond, bodies[i], bodies[j]))
          << bodies[i] << " " << bodies[j];
    }
  }
  const auto enabled = [](const GetSceneResponse& state) {
    std::set<std::string> names;
    for (const PairInfo& pair : state.named_pairs) {
      if (pair.enabled != 0) names.insert(pair.name);
    }
    return names;
  };
  EXPECT_EQ(enabled(getScene()), enabled(getScene(kSecond)));
}

TEST_F(State, AChangedToolIsNoticedAndTakenByReloadWhileTheRestGoesOn) {
  apply({capsule("pill"), operation(SceneOperation::ATTACH, "pill", "tip")});
  const std::vector<std::uint64_t> ids = idsOf("base/shelf");
  EXPECT_TRUE(diagnoses(""));
  log.clear();
  std::string other = urdf();
  other.replace(other.rfind("1 1 1"), 5, "2 2 2");
  ros::param::set("/robot_description", other);
  EXPECT_TRUE(diagnoses("robot_description"));
  const auto said = [&] {
    const std::vector<rosgraph_msgs::Log> all = log.all();
    return std::count_if(all.begin(), all.end(), [](const rosgraph_msgs::Log& entry) {
      return entry.msg.find("'robot_description' has changed") != std::string::npos &&
             entry.msg.find("/concave_distance/reload") != std::string::npos;
    });
  };
  EXPECT_TRUE(eventually([&] { return said() == 1; }));
  EXPECT_NEAR(distanceOf(kNode, "base", "tip"), 2.0, 1e-9) << "nobody has reloaded";

  const ReloadResponse response = reload();
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.kept, (std::vector<std::string>{"base", "shelf"}));
  EXPECT_EQ(response.replaced, std::vector<std::string>{"tip"});
  EXPECT_EQ(response.kept_edits, std::vector<std::string>{"pill"});
  EXPECT_TRUE(response.dropped.empty());
  EXPECT_NEAR(distanceOf(kNode, "base", "tip"), 1.5, 1e-9);
  EXPECT_EQ(idsOf("base/shelf"), ids);
  EXPECT_EQ(find(getScene(), "pill").info.attached_to, "tip");
  EXPECT_TRUE(diagnoses(""));
  EXPECT_EQ(said(), 1);
}

TEST_F(State, AReloadOfABrokenDescriptionChangesNothingAndNamesEachFault) {
  apply({capsule("pill")});
  const std::uint64_t revision = getScene().revision;
  const auto expect_unchanged = [&](const ReloadResponse& response, const std::string& part) {
    EXPECT_FALSE(response.success);
    expectRefused(response.message, part);
    EXPECT_EQ(response.revision, revision);
    const GetSceneResponse state = getScene();
    EXPECT_EQ(state.revision, revision);
    EXPECT_EQ(state.bodies.size(), 4U);
    EXPECT_NEAR(distanceOf(kNode, "base", "tip"), 2.0, 1e-9);
  };
  ros::param::set("/robot_description", std::string("<robot name='x'><link"));
  const ReloadResponse no_xml = reload();
  EXPECT_EQ(no_xml.problems.size(), 1U);
  expect_unchanged(no_xml, "nothing was changed");

  std::string missing = urdf();
  for (int i = 0; i < 2; ++i) {
    const std::string box = "<box size=\"1 1 1\"/>";
    missing.replace(missing.find(box), box.size(),
                    "<mesh filename=\"package://concave_distance/none.stl\"/>");
  }
  ros::param::set("/robot_description", missing);
  const ReloadResponse no_mesh = reload();
  EXPECT_EQ(no_mesh.problems.size(), 2U) << "each link";
  expect_unchanged(no_mesh, "2 parts cannot be loaded");

  ros::param::del("/robot_description");
  expect_unchanged(reload(), "there is no parameter 'robot_description'");
}

}  // namespace
}  // namespace concave_distance::state_rostest
