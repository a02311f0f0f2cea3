// The program itself, as a user runs it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "support/csv_table.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace concave_distance::simulate_test {
namespace {

using test::number;
using test::readTable;
using test::Row;

constexpr const char* kScene =
    "bodies:\n"
    "  - {name: ground, box: {size: [1, 1, 0.1]}, pose: {xyz: [0, 0, -0.05]}, max_edge_length: 1}\n"
    "  - {name: cube, box: {size: [0.2, 0.2, 0.2]}, max_edge_length: 1}\n"
    "pairs:\n"
    "  - between: [ground, cube]\n"
    "    name: cube_ground\n"
    "    effects: {normal_force: {model: elastic_foundation, foundation_stiffness: 1e6}}\n"
    "simulation:\n"
    "  duration: 0.1\n"
    "  log_rate: 200\n"
    "  bodies:\n"
    "    - {body: cube, mass: 2, pose: {xyz: [0, 0, 0.105]}, velocity: [0.1, 0, -0.5]}\n";

class Simulate : public testing::Test {
 protected:
  void SetUp() override { folder.write("scene.yaml", kScene); }

  /// Exit status; what it prints goes to the file "log".
  int run(const std::string& arguments) { return test::runIn(folder, CONCAVE_DISTANCE_SIMULATE, arguments); }
  std::string log() const { return test::contentOf(folder.path("log")); }
  bool logHas(const std::string& part) const { return log().find(part) != std::string::npos; }

  test::TemporaryFolder folder;
};

TEST_F(Simulate, WritesTrajectoryContactsAndNiches) {
  ASSERT_EQ(run("scene.yaml --output out.csv --contacts contacts.csv --niches niches.csv --progress"), 0)
      << log();
  const std::vector<Row> rows = readTable(folder.path("out.csv"));
  ASSERT_EQ(rows.size(), 21U);
  EXPECT_EQ(number(rows[0], "t"), 0.0);
  EXPECT_EQ(number(rows[20], "t"), 0.1);
  EXPECT_EQ(number(rows[0], "cube.z"), 0.105);
  EXPECT_NEAR(number(rows[20], "cube.x"), 0.01, 1e-6);  // frictionless
  EXPECT_NEAR(number(rows[0], "cube_ground.distance"), 0.005, 1e-15);
  double forces = 0.0;
  for (const Row& row : rows) forces += number(row, "cube_ground.normal_force");
  EXPECT_GT(forces, 0.0);
  const std::vector<Row> contacts = readTable(folder.path("contacts.csv"));
  ASSERT_FALSE(contacts.empty());
  EXPECT_GT(number(contacts[0], "depth"), 0.0);
  EXPECT_NEAR(number(contacts[0], "contact_area"), 0.04, 1e-9);
  EXPECT_NEAR(number(contacts[0], "normal_z"), 1.0, 1e-9);
  EXPECT_FALSE(readTable(folder.path("niches.csv")).empty());
  for (const char* part : {"real-time factor", "share of time: solve", "balance error", "held back by"}) {
    EXPECT_TRUE(logHas(part)) << part << "\n" << log();
  }
}

TEST_F(Simulate, OptionsReplaceTheScenesValues) {
  ASSERT_EQ(
      run("scene.yaml --output out.csv --duration 0.05 --largest-step 0.0005 --tracking single_minimum"), 0)
      << log();
  const std::vector<Row> rows = readTable(folder.path("out.csv"));
  ASSERT_EQ(rows.size(), 11U);
  EXPECT_GE(number(rows[10], "steps"), 100.0);
  EXPECT_LE(number(rows[10], "cube_ground.niches"), 1.0);  // the closest pair alone
}

TEST_F(Simulate, FailsWhereTheEnergyIsNotBalanced) {
  EXPECT_EQ(run("scene.yaml --output out.csv --energy-tolerance 1e-9"), 4);
  for (const char* part :
       {"the energy balance is off by", "allowed: 1e-07 %", "make step_fraction smaller"}) {
    EXPECT_TRUE(logHas(part)) << part << "\n" << log();
  }
  EXPECT_EQ(readTable(folder.path("out.csv")).size(), 21U);
}

TEST_F(Simulate, NamesABodyThatNothingCanHold) {
  ASSERT_EQ(run("scene.yaml --output out.csv"), 0) << log();
  EXPECT_FALSE(logHas("warning")) << log();
  std::string scene = kScene;
  const std::string force = "{normal_force: {model: elastic_foundation, foundation_stiffness: 1e6}}";
  scene.replace(scene.find(force), force.size(), "{interference: true}");
  folder.write("scene.yaml", scene);
  ASSERT_EQ(run("scene.yaml --output out.csv"), 0) << log();
  EXPECT_TRUE(logHas("warning: scene.yaml:12, simulation.bodies[0]: body 'cube' falls for good")) << log();
}

// Steel that rolls: its depth under its weight is 0.2 nm, which is as far as a point may move in a step.
TEST_F(Simulate, SaysWhichContactHoldsItBackBelowATenthOfRealTime) {
  ASSERT_EQ(run("scene.yaml --output out.csv"), 0) << log();
  EXPECT_FALSE(logHas("of real time: ")) << log();
  folder.write(
      "hard.yaml",
      "bodies:\n"
      "  - {name: ground, box: {size: [1, 1, 0.1]}, pose: {xyz: [0, 0, -0.05]}, max_edge_length: 1}\n"
      "  - {name: bead, sphere: {radius: 0.001}, material: {youngs_modulus: 2e11}}\n"
      "  - {name: far, box: {size: [0.1, 0.1, 0.1]}, pose: {xyz: [5, 0, 0]}, max_edge_length: 1}\n"
      "defaults: {effects: {normal_force: hertz, friction: bristle}}\n"
      "pairs:\n"
      "  - {between: [far, bead]}\n"
      "  - {between: [ground, bead]}\n"
      "simulation:\n"
      "  duration: 1e-5\n"
      "  bodies:\n"
      "    - {body: bead, density: 7850, pose: {xyz: [0, 0, 0.001]}, velocity: [1, 0, 0],"
      " angular_velocity: [0, 1000, 0]}\n");
  ASSERT_EQ(run("hard.yaml --output hard.csv"), 0) << log();
  EXPECT_TRUE(logHas("of real time: contact 'ground/bead' held it back: ")) << log();
  EXPECT_TRUE(logHas("youngs_modulus")) << log();
}

// The scenes that doc/effects.md begins with.
TEST_F(Simulate, RunsTheScenesOfTheDocument) {
  const std::string page = test::contentOf(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/doc/effects.md");
  const std::string fence = "```yaml\n";
  int count = 0;
  for (std::size_t begin = page.find(fence); begin != std::string::npos; begin = page.find(fence, begin)) {
    begin += fence.size();
    const std::size_t end = page.find("```", begin);
    folder.write("ready.yaml", page.substr(begin, end - begin));
    EXPECT_EQ(run("ready.yaml --output ready.csv"), 0) << log();
    EXPECT_FALSE(logHas("warning")) << log();
    EXPECT_EQ(number(readTable(folder.path("ready.csv")).back(), "t"), 2.0);
    begin = end + 3;
    ++count;
  }
  EXPECT_EQ(count, 3);
}

TEST_F(Simulate, RefusesASceneOfWhichABodyIsMissing) {
  std::string scene = kScene;
  scene.replace(scene.find("box: {size: [1, 1, 0.1]}"), 24, "mesh: file:///nowhere/ground.stl");
  folder.write("lost.yaml", scene);
  EXPECT_EQ(run("lost.yaml --output lost.csv"), 1);
  EXPECT_TRUE(logHas("ground.stl")) << log();
  EXPECT_TRUE(logHas("needs the whole scene")) << log();
}

TEST_F(Simulate, SaysWhatIsWrong) {
  folder.write("bare.yaml", "bodies: []\n");
  EXPECT_EQ(run("bare.yaml --output out.csv"), 1);
  EXPECT_TRUE(logHas("bare.yaml: there is no section `simulation`")) << log();
  EXPECT_EQ(run("nowhere.yaml --output out.csv"), 1);
  EXPECT_EQ(run("scene.yaml --output no/such/folder/out.csv"), 1);
  EXPECT_TRUE(logHas("cannot be written")) << log();
  EXPECT_EQ(run("scene.yaml --output scene.yaml"), 1);
  EXPECT_TRUE(logHas("the same file as the scene")) << log();
  EXPECT_EQ(run("scene.yaml --output out.csv --contacts out.csv"), 1);
  EXPECT_EQ(run("scene.yaml --output /dev/full"), 1);
  EXPECT_TRUE(logHas("not everything could be written")) << log();
  EXPECT_EQ(run("scene.yaml"), 2);
  EXPECT_EQ(run("scene.yaml --output out.csv --duration -1"), 2);
  EXPECT_EQ(run("scene.yaml --output out.csv --tracking some"), 2);
}

}  // namespace
}  // namespace concave_distance::simulate_test
