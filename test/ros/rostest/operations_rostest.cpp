// apply_scene and scene_moves of a running node: a part is picked, carried and put down; bodies of all
// shapes; nonsense.
#include <concave_distance/Alert.h>
#include <concave_distance/ApplyScene.h>
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/Nearest.h>
#include <concave_distance/SceneMoves.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "node_access.h"
#include "operation_messages.h"
#include "tf_player.h"

namespace concave_distance::operations_rostest {
namespace {

shape_msgs::SolidPrimitive primitive(std::uint8_t type, const std::vector<double>& dimensions) {
  shape_msgs::SolidPrimitive message;
  message.type = type;
  message.dimensions = dimensions;
  return message;
}

SceneOperation addition(const std::string& body, double x, double y = 0.0) {
  SceneOperation message = operation(SceneOperation::ADD, body);
  message.frame_id = "world";
  message.pose = at(x, y);
  return message;
}
SceneOperation box(const std::string& body, double x, double y = 0.0) {
  SceneOperation message = addition(body, x, y);
  message.primitives = {primitive(shape_msgs::SolidPrimitive::BOX, {1.0, 1.0, 1.0})};
  return message;
}

/// A tetrahedron of side 1 along the axes.
shape_msgs::Mesh tetrahedron() {
  shape_msgs::Mesh mesh;
  for (const auto& pose : {at(0), at(1), at(0, 1), at(0, 0, 1)}) mesh.vertices.push_back(pose.position);
  for (const auto& corners : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    mesh.triangles.emplace_back();
    std::copy(corners.begin(), corners.end(), mesh.triangles.back().vertex_indices.begin());
  }
  return mesh;
}

ApplySceneResponse apply(const std::vector<SceneOperation>& operations) {
  ApplySceneRequest request;
  request.operations = operations;
  return call<ApplyScene>(kNode + "apply_scene", request);
}
void applyWell(const std::vector<SceneOperation>& operations) {
  const ApplySceneResponse response = apply(operations);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_TRUE(response.faults.empty());
}

double distanceOf(const std::string& a, const std::string& b) {
  GetDistanceRequest request;
  request.query.body_a = a;
  request.query.body_b = b;
  const auto response = call<GetDistance>(kNode + "get_distance", request);
  EXPECT_TRUE(response.success) << response.message;
  return response.result.nearest.distance;
}

const PairDistance* find(const Distances& distances, const std::string& pair) {
  const auto found = std::find_if(distances.pairs.begin(), distances.pairs.end(),
                                  [&](const PairDistance& distance) { return distance.pair == pair; });
  return found == distances.pairs.end() ? nullptr : &*found;
}

class Operations : public ::testing::Test {
 protected:
  Operations() {
    player.place("base", -20.0);
    player.place("tip", 0.0);
    EXPECT_TRUE(eventually([] { return call<ListBodies>(kNode + "list_bodies", {}).ready != 0; }));
    EXPECT_TRUE(eventually([] { return std::abs(distanceOf("base", "tip") - 19.0) < 1e-9; }));
  }

  bool shows(const std::string& pair, double distance) {
    return distances.waitFor([&](const Distances& message) {
      const PairDistance* found = find(message, pair);
      return found != nullptr && std::abs(found->distance - distance) < 1e-9;
    });
  }
  bool hides(const std::string& pair, std::uint64_t revision) {
    return distances.waitFor([&](const Distances& message) {
      return message.scene_revision >= revision && find(message, pair) == nullptr;
    });
  }
  bool alerts(const std::string& pair, std::uint8_t state) {
    return alerts_
        .match([&](const Alert& alert) { return alert.state == state && alert.nearest.pair == pair; })
        .has_value();
  }
  void moveTip(double x, double y) {
    alerts_.clear();
    player.place("tip", x, y);
  }
  ApplySceneResponse edit(const SceneOperation& one) {
    alerts_.clear();
    const ApplySceneResponse response = apply({one});
    EXPECT_TRUE(response.success) << response.message;
    return response;
  }

  TfPlayer player;
  Collector<Distances> distances{kNode + "distances"};
  Collector<Alert> alerts_{kNode + "alerts"};
};

/// Where the boxes of edge 1 are, and what the robot holds: the answers without the node.
struct Boxes {
  using Centre = std::array<double, 2>;  ///< x and y; all have z = 0
  std::map<std::string, Centre> centres{{"base", {-20.0, 0.0}}, {"tip", {0.0, 0.0}}, {"shelf", {1.6, 5.0}}};
  std::set<std::string> robot{"base", "tip"};

  double between(const std::string& a, const std::string& b) const {
    const auto gap = [&](std::size_t axis) {
      return std::max(0.0, std::abs(centres.at(a)[axis] - centres.at(b)[axis]) - 1.0);
    };
    return std::hypot(gap(0), gap(1));
  }
  /// The nearest two of which the robot is, or holds, one.
  std::pair<std::set<std::string>, double> nearestToRobot() const {
    std::pair<std::set<std::string>, double> nearest{{}, std::numeric_limits<double>::infinity()};
    for (const auto& [a, centre_a] : centres) {
      for (const auto& [b, centre_b] : centres) {
        if (robot.count(a) == 0 || robot.count(b) != 0 || between(a, b) >= nearest.second) continue;
        nearest = {{a, b}, between(a, b)};
      }
    }
    return nearest;
  }
};

/// Asks besides what the node says of the group `robot` after each step.
class Picking : public Operations {
 protected:
  /// The group's nearest pair is that of the boxes, and the group's alerts since the last step are these.
  void expectRobot(const std::vector<std::uint8_t>& states) {
    const auto [bodies, distance] = boxes.nearestToRobot();
    EXPECT_TRUE(nearest.waitFor([&, bodies = bodies, distance = distance](const Nearest& message) {
      return std::set<std::string>{message.body_a, message.body_b} == bodies && message.is_minimum != 0 &&
             std::abs(message.distance - distance) < 1e-9 && std::abs(message.lower_bound - distance) < 1e-9;
    })) << distance;
    if (!states.empty()) {
      EXPECT_TRUE(
          robot_alerts.match([&](const Alert& alert) { return alert.state == states.back(); }).has_value());
    }
    const std::vector<Alert> alerts = robot_alerts.all();
    ASSERT_EQ(alerts.size(), states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      EXPECT_EQ(alerts[i].group, "robot");
      EXPECT_EQ(alerts[i].state, states[i]);
      if (states[i] != Alert::WARNING) continue;
      EXPECT_EQ((std::set<std::string>{alerts[i].nearest.body_a, alerts[i].nearest.body_b}), bodies);
      EXPECT_NEAR(alerts[i].nearest.distance, distance, 1e-9);
    }
    robot_alerts.clear();
  }
  void move(double x, double y) {
    const Boxes::Centre by = {x - boxes.centres["tip"][0], y - boxes.centres["tip"][1]};
    for (const std::string& name : boxes.robot) {
      if (name == "base") continue;
      boxes.centres[name][0] += by[0];
      boxes.centres[name][1] += by[1];
    }
    moveTip(x, y);
  }

  Boxes boxes;
  Collector<Nearest> nearest{kNode + "groups/robot/nearest"};
  Collector<Alert> robot_alerts{kNode + "groups/robot/alerts"};
};

TEST_F(Picking, PickAPartCarryItAndPutItDown) {
  edit(box("part", 1.6));
  boxes.centres["part"] = {1.6, 0.0};
  EXPECT_TRUE(shows("part/tip", 0.6));
  expectRobot({});
  move(0.4, 0.0);
  EXPECT_TRUE(alerts("part/tip", Alert::WARNING));
  EXPECT_TRUE(shows("part/tip", 0.2));
  expectRobot({Alert::WARNING});

  const ApplySceneResponse attached = edit(operation(SceneOperation::ATTACH, "part", "tip"));
  boxes.robot.insert("part");
  EXPECT_TRUE(alerts("part/tip", Alert::CLEAR)) << "what is gripped may be touched";
  EXPECT_TRUE(hides("part/tip", attached.revision));
  EXPECT_TRUE(shows("part/shelf", 4.0)) << "it can reach the shelf from now on";
  expectRobot({Alert::CLEAR});
  for (const BodyInfo& body : call<ListBodies>(kNode + "list_bodies", {}).bodies) {
    if (body.name != "part") continue;
    EXPECT_EQ(body.frame_id, "tip");
    EXPECT_EQ(body.attached_to, "tip");
    EXPECT_NEAR(body.pose.position.x, 1.2, 1e-12);
  }

  move(0.4, 3.8);
  EXPECT_TRUE(alerts("part/shelf", Alert::WARNING));
  EXPECT_TRUE(shows("part/shelf", 0.2));
  expectRobot({Alert::WARNING});

  edit(operation(SceneOperation::DETACH, "part"));
  boxes.robot.erase("part");
  EXPECT_TRUE(alerts("part/shelf", Alert::CLEAR)) << "neither moves any more";
  EXPECT_TRUE(alerts("part/tip", Alert::WARNING)) << "as before it was gripped";
  EXPECT_TRUE(shows("part/tip", 0.2));
  expectRobot({});  // it was in warning, and is

  move(-3.0, 3.8);
  EXPECT_TRUE(alerts("part/tip", Alert::CLEAR));
  EXPECT_NEAR(distanceOf("part", "shelf"), 0.2, 1e-9) << "it stays where it was put";
  expectRobot({Alert::CLEAR});

  move(0.4, 3.8);
  EXPECT_TRUE(alerts("part/tip", Alert::WARNING));
  expectRobot({Alert::WARNING});
  edit(operation(SceneOperation::REMOVE, "part"));
  boxes.centres.erase("part");
  EXPECT_TRUE(alerts("part/tip", Alert::CLEAR));
  expectRobot({Alert::CLEAR});
}

TEST_F(Operations, AddBodiesOfManyShapes) {
  SceneOperation pin = addition("pin", 10.0);  // a cone whose apex is at x = 8, on a cylinder
  pin.primitives = {primitive(shape_msgs::SolidPrimitive::CONE, {2.0, 0.5}),
                    primitive(shape_msgs::SolidPrimitive::CYLINDER, {1.0, 0.5})};
  pin.primitive_poses = {at(-1.0), at(0.5)};
  for (auto& pose : pin.primitive_poses) {
    pose.orientation.y = -std::sqrt(0.5);
    pose.orientation.w = std::sqrt(0.5);
  }
  SceneOperation wedge = addition("wedge", 0.0, 3.0);
  wedge.meshes = {tetrahedron(), tetrahedron()};
  wedge.mesh_poses = {at(0), at(0, 0, 4)};
  SceneOperation ball = addition("ball", 0.0, -3.0);
  ball.primitives = {primitive(shape_msgs::SolidPrimitive::SPHERE, {0.5})};
  SceneOperation blocks = addition("blocks", 0.0, 9.0);
  blocks.mesh_resources = {"package://concave_distance/test/ros/rostest/meshes/two_blocks.obj"};
  applyWell({pin, wedge, ball, blocks, operation(SceneOperation::ALLOW_CONTACT, "ball", "robot"),
             operation(SceneOperation::DISALLOW_CONTACT, "ball", "tip")});
  EXPECT_NEAR(distanceOf("pin", "tip"), 7.5, 1e-9);
  EXPECT_NEAR(distanceOf("wedge", "tip"), 2.5, 1e-9);
  EXPECT_NEAR(distanceOf("ball", "tip"), 2.0, 1e-9) << "the very sphere";
  EXPECT_NEAR(distanceOf("blocks", "tip"), distanceOf("tip", "blocks"), 1e-12);
  EXPECT_TRUE(shows("ball/tip", 2.0));
  EXPECT_EQ(find(*distances.last(), "ball/base"), nullptr);

  SceneOperation wider = operation(SceneOperation::SET_MARGIN, "bal?");
  wider.margin = 0.25;
  applyWell({wider});
  EXPECT_TRUE(shows("ball/tip", 1.75));
  applyWell({operation(SceneOperation::REMOVE, "pin"), operation(SceneOperation::REMOVE, "wedge"),
             operation(SceneOperation::REMOVE, "ball"), operation(SceneOperation::REMOVE, "blocks")});
}

TEST_F(Operations, RefuseABatchWithOneThatIsWrongAndNameEach) {
  const std::size_t bodies = call<ListBodies>(kNode + "list_bodies", {}).bodies.size();
  const std::uint64_t revision = apply({}).revision;
  SceneOperation no_triangle = addition("a", 0.0);
  no_triangle.meshes.emplace_back();
  SceneOperation bad_index = addition("b", 0.0);
  bad_index.meshes = {tetrahedron()};
  bad_index.meshes[0].triangles[0].vertex_indices[0] = 9;
  SceneOperation not_finite = addition("c", 0.0);
  not_finite.meshes = {tetrahedron()};
  not_finite.meshes[0].vertices[0].x = std::numeric_limits<double>::quiet_NaN();
  SceneOperation no_type = addition("d", 0.0);
  no_type.primitives = {primitive(9, {1.0})};
  SceneOperation too_few_poses = box("e", 0.0);
  too_few_poses.primitives.push_back(too_few_poses.primitives[0]);
  too_few_poses.primitive_poses = {at(0)};
  SceneOperation bad_pose = operation(SceneOperation::MOVE, "shelf");
  bad_pose.pose = at(std::numeric_limits<double>::infinity());
  SceneOperation no_frame = box("f", 0.0);
  no_frame.frame_id = "";
  SceneOperation wrong_file = addition("g", 0.0);
  wrong_file.mesh_resources = {"package://concave_distance/no_such.stl"};
  const std::vector<SceneOperation> operations = {box("good", 30.0),
                                                  no_triangle,
                                                  bad_index,
                                                  not_finite,
                                                  no_type,
                                                  too_few_poses,
                                                  bad_pose,
                                                  no_frame,
                                                  wrong_file,
                                                  addition("h", 0.0),
                                                  box("robot", 0.0),
                                                  box("shelf", 0.0),
                                                  operation(SceneOperation::MOVE, "tip"),
                                                  operation(SceneOperation::ATTACH, "shelf", "nobody"),
                                                  operation(SceneOperation::DETACH, "shelf"),
                                                  operation(77, "shelf")};
  const std::vector<std::string> expected = {"meshes[0]: it has no triangle",
                                             "body 'b'",
                                             "body 'c'",
                                             "primitives[0].type: the value is 9",
                                             "1 poses for 2 primitives",
                                             "pose.position",
                                             "frame_id",
                                             "no_such.stl",
                                             "the body has none",
                                             "there is a group 'robot'",
                                             "there is a body 'shelf' already",
                                             "link of a robot, which tf moves",
                                             "neither a body nor a tf frame 'nobody'",
                                             "it is not attached",
                                             "operation: the value is 77"};
  const ApplySceneResponse response = apply(operations);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("15 of 16 operations are wrong, nothing was changed"), std::string::npos)
      << response.message;
  ASSERT_EQ(response.faults.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(response.faults[i].operation, i + 1);
    EXPECT_EQ(response.faults[i].body, operations[i + 1].body);
    EXPECT_NE(response.faults[i].message.find(expected[i]), std::string::npos) << response.faults[i].message;
  }
  EXPECT_EQ(response.revision, revision);
  EXPECT_EQ(call<ListBodies>(kNode + "list_bodies", {}).bodies.size(), bodies);
}

TEST_F(Operations, FollowAStreamOfMovesAndCountThoseThatAreWrong) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ros::Publisher publisher = ros::NodeHandle().advertise<SceneMoves>(kNode + "scene_moves", 1000);
  ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; }));
  applyWell({box("drum", 10.0)});
  SceneMoves moves;
  moves.bodies = {"drum"};
  moves.poses = {at(10.0)};
  for (int i = 1; i <= 60; ++i) {
    moves.poses[0] = at(10.0 - 0.1 * i);
    publisher.publish(moves);
    ros::WallDuration(0.005).sleep();
  }
  EXPECT_TRUE(shows("drum/tip", 3.0));
  EXPECT_TRUE(shows("drum/shelf", std::hypot(1.4, 4.0))) << "what moves is watched against its frame";

  moves.bodies = {"nobody", "drum", "tip", "drum"};
  moves.poses = {at(0), at(6.0), at(1.0), at(0, std::numeric_limits<double>::quiet_NaN())};
  publisher.publish(moves);
  moves.poses.pop_back();
  publisher.publish(moves);
  moves.header.frame_id = "moon";
  moves.bodies = {"drum"};
  moves.poses = {at(0)};
  publisher.publish(moves);
  EXPECT_TRUE(diagnostics.waitFor([](const diagnostic_msgs::DiagnosticArray& message) {
    return counted(message, "moves refused since the start") == 5.0;
  })) << "three of the first, the second, the third";
  EXPECT_TRUE(shows("drum/tip", 5.0)) << "the one that is right was applied";
  applyWell({operation(SceneOperation::REMOVE, "drum")});
}

}  // namespace
}  // namespace concave_distance::operations_rostest
