// The program itself, as a user runs it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/csv_table.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace concave_distance::clearance_query_test {
namespace {

using test::number;
using test::readTable;
using test::Row;

/// A ball of 0.1 m on an arm of 1 m that turns about z, and one of 0.2 m at 1.5 m from the axis.
constexpr const char* kUrdf =
    "<robot name='arm'><link name='base'/>"
    "<link name='bob'><collision><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/></geometry></collision>"
    "</link><joint name='swing' type='revolute'><parent link='base'/><child link='bob'/><axis xyz='0 0 1'/>"
    "<limit lower='-1.5' upper='1.5' effort='1' velocity='1'/></joint></robot>";
constexpr const char* kScene =
    "robots:\n  - {description: arm}\n"
    "bodies:\n"
    "  - {name: post, frame: world, sphere: {radius: 0.2}, pose: {xyz: [1.5, 0, 0]}}\n"
    "  - {name: ball, frame: ball, sphere: {radius: 0.25}}\n";

class ClearanceQuery : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("scene.yaml", kScene);
    folder.write("arm.urdf", kUrdf);
    folder.write("swing.csv", "t,swing\n0,-1\n1,2\n");
    folder.write("path.csv", "t,x,y,z,qx,qy,qz,qw\n0,0,1,0,0,0,0,1\n2,3,1,0,0,0,0,1\n");
  }

  /// Exit status; what it prints goes to the file "log".
  int run(const std::string& arguments) {
    return test::runIn(folder, CONCAVE_DISTANCE_CLEARANCE_QUERY,
                       "--scene scene.yaml --description arm=arm.urdf " + arguments);
  }
  std::string log() const { return test::contentOf(folder.path("log")); }
  bool logHas(const std::string& part) const { return log().find(part) != std::string::npos; }

  test::TemporaryFolder folder;
};

TEST_F(ClearanceQuery, WritesTheLeastDistanceOfAMotionOfJoints) {
  ASSERT_EQ(
      run("--motion swing.csv --tolerance 1e-6 --threshold 0.3 --output out.csv --pairs-output pairs.csv "
          "--niches-output niches.csv --progress"),
      0)
      << log();
  const std::vector<Row> rows = readTable(folder.path("out.csv"));
  ASSERT_EQ(rows.size(), 1U);
  const Row& row = rows[0];
  EXPECT_EQ(row.at("status"), "ok");
  EXPECT_NEAR(number(row, "distance"), 0.2, 1e-6);
  EXPECT_LE(number(row, "lower_bound"), 0.2);
  EXPECT_NEAR(number(row, "time"), 1.0 / 3.0, 1e-3);
  EXPECT_EQ(row.at("body_a"), "bob");
  EXPECT_EQ(row.at("body_b"), "post");
  EXPECT_NEAR(number(row, "bx") - number(row, "ax"), 0.2, 1e-4);
  const double first = (1.0 - std::acos((1.0 + 1.5 * 1.5 - 0.36) / 3.0)) / 3.0;
  EXPECT_LE(number(row, "proven_until"), first);
  EXPECT_GE(number(row, "first_time"), first);
  EXPECT_EQ(readTable(folder.path("pairs.csv")).size(), 1U);
  const std::vector<Row> niches = readTable(folder.path("niches.csv"));
  ASSERT_EQ(niches.size(), 1U);
  EXPECT_EQ(number(niches[0], "distance"), number(row, "distance"));
  EXPECT_TRUE(logHas("joint 'swing' leaves the range")) << log();
  EXPECT_TRUE(logHas("nothing is proven of 'ball'")) << log();
}

TEST_F(ClearanceQuery, WritesTheLeastDistanceOfAPathOfPoses) {
  ASSERT_EQ(run("--motion path.csv --body ball --position swing=1.5 --output out.csv --each-pair "
                "--pairs-output pairs.csv"),
            0)
      << log();
  const Row row = readTable(folder.path("out.csv")).at(0);
  // The arm stands at 1.5 rad, its ball at (0.07, 1.00).
  const double near_bob = std::abs(1.0 - std::sin(1.5)) - 0.35;
  EXPECT_LT(near_bob, 0.0);
  EXPECT_EQ(row.at("status"), "penetrating");
  EXPECT_EQ(number(row, "distance"), 0.0);
  EXPECT_EQ(number(row, "first_time"), 0.0);
  bool has_post = false;
  for (const Row& pair : readTable(folder.path("pairs.csv"))) {
    if (pair.at("body_a") != "post" && pair.at("body_b") != "post") continue;
    has_post = true;
    EXPECT_NEAR(number(pair, "distance"), 1.0 - 0.45, 1e-3);
    EXPECT_NEAR(number(pair, "time"), 1.0, 0.1);
  }
  EXPECT_TRUE(has_post);
}

TEST_F(ClearanceQuery, RefusesWhatItCannotRead) {
  EXPECT_EQ(run("--motion path.csv"), 1);
  EXPECT_TRUE(logHas("no --body is named")) << log();
  EXPECT_EQ(run("--motion swing.csv --body ball"), 1);
  EXPECT_TRUE(logHas("it is no path of poses")) << log();
  folder.write("other.csv", "t,wing\n0,0\n");
  EXPECT_EQ(run("--motion other.csv"), 1);
  EXPECT_TRUE(logHas("no robot of the scene has it")) << log();
  folder.write("timeless.csv", "swing\n0\n");
  EXPECT_EQ(run("--motion timeless.csv"), 1);
  EXPECT_TRUE(logHas("its first column is no time")) << log();
  EXPECT_EQ(run("--motion swing.csv --tolerance 0"), 1);
  EXPECT_TRUE(logHas("tolerance: the value is 0")) << log();
  EXPECT_EQ(run("--motion swing.csv --position swing=a"), 1);
  EXPECT_TRUE(logHas("write a number")) << log();
  EXPECT_EQ(run("--motion swing.csv --position leg=1"), 1);
  EXPECT_TRUE(logHas("the scene's joints are swing")) << log();
  EXPECT_EQ(run("--motion swing.csv --output swing.csv"), 1);
  EXPECT_EQ(run("--motion swing.csv --outptu out.csv"), 2);
}

}  // namespace
}  // namespace concave_distance::clearance_query_test
