// The program itself, as a user runs it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "concave_distance/mesh/import/export_mesh.h"
#include "support/concave_shapes.h"
#include "support/csv_table.h"
#include "support/painted_boxes.h"
#include "support/plain_shapes.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace concave_distance::distance_query_test {
namespace {

using Eigen::Vector3d;
using test::number;
using test::readTable;
using test::Row;

Vector3d point(const Row& row, const std::string& body) {
  return {number(row, body + "x"), number(row, body + "y"), number(row, body + "z")};
}

class DistanceQuery : public testing::Test {
 protected:
  void SetUp() override {
    exportMesh(test::makeCuboid(Vector3d(-0.5, -0.5, -0.5), Vector3d(0.5, 0.5, 0.5)),
               folder_.path("box.stl"));
    exportMesh(test::makeCuboid(Vector3d(-100, -100, -100), Vector3d(100, 100, 100)),
               folder_.path("small_box_in_mm.stl"));
    exportMesh(test::makeComb(3), folder_.path("comb.stl"));
    folder_.write("poses.csv",
                  "t,x,y,z,qx,qy,qz,qw\n"
                  "0,0,0,1,0,0,0,1\n"
                  "0.1,1.5,0,0,0,0,0,1\n"
                  "0.2,0,0,0.9,0,0,0,2\n"
                  "0.3,nan,0,0.9,0,0,0,1\n"
                  "0.4,0,0,0.55,0,0,0,1\n"
                  "0.5,0.9,0.9,0.9,0,0,0,1.0005\n"
                  "0.6,0,0,0.1,0,0,0,1\n");
  }

  /// Exit status; what it prints goes to the file "log".
  int run(const std::string& arguments) {
    return test::runIn(folder_, CONCAVE_DISTANCE_DISTANCE_QUERY, arguments);
  }
  int runBoxes(const std::string& further) {
    return run(
        "--mesh-a box.stl --mesh-b small_box_in_mm.stl --scale-b 0.001 --poses poses.csv --output out.csv " +
        further);
  }
  std::string log() const { return test::contentOf(folder_.path("log")); }
  std::vector<Row> answers() const { return readTable(folder_.path("out.csv")); }
  std::vector<Row> niches() const { return readTable(folder_.path("niches.csv")); }

  test::TemporaryFolder folder_;
};

/// Writes ASCII STL and OBJ as other programs do: every triangle with corners of its own.
void writeFiles(const TriangleSoup& soup, const test::TemporaryFolder& folder, const std::string& name) {
  std::ostringstream stl;
  std::ostringstream obj;
  stl.precision(17);
  obj.precision(17);
  stl << "solid union\n";
  for (const Vector3d& v : soup.vertices) obj << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const auto& t : soup.triangles) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t k : t) {
      const Vector3d& v = soup.vertices[k];
      stl << "vertex " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    stl << "endloop\nendfacet\n";
    obj << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  stl << "endsolid union\n";
  folder.write(name + ".stl", stl.str());
  folder.write(name + ".obj", obj.str());
}

TEST_F(DistanceQuery, TakesAFileOfStackedBoxesForOneSolid) {
  TriangleSoup stack;
  for (const double x : {0.0, 1.0, 2.0}) {
    const Vector3d low(x, 0.0, 0.0);
    test::addBox(stack, test::Box(low, low + Vector3d::Ones()), 0, false);
  }
  writeFiles(stack, folder_, "stack");
  TriangleSoup cube;
  test::addBox(cube, test::Box(Vector3d::Constant(-0.1), Vector3d::Constant(0.1)), 0, false);
  writeFiles(cube, folder_, "cube");
  // In the first box, across the first wall, in the third box, beside the stack.
  folder_.write("poses.csv",
                "t,x,y,z,qx,qy,qz,qw\n0,0.5,0.5,0.5,0,0,0,1\n1,1,0.5,0.5,0,0,0,1\n2,2.5,0.5,0.5,0,0,0,1\n"
                "3,1.5,0.5,1.5,0,0,0,1\n");
  for (const std::string format : {".stl", ".obj"}) {
    for (const std::string level : {"nodes", "refined", "certified", "complete"}) {
      for (const std::string further : {"", " --niches-output niches.csv", " --tracking"}) {
        for (const bool swapped : {false, true}) {
          // The reflection of the poses: the stack seen from the cube.
          if (swapped) {
            folder_.write("seen.csv",
                          "t,x,y,z,qx,qy,qz,qw\n0,-0.5,-0.5,-0.5,0,0,0,1\n1,-1,-0.5,-0.5,0,0,0,1\n"
                          "2,-2.5,-0.5,-0.5,0,0,0,1\n3,-1.5,-0.5,-1.5,0,0,0,1\n");
          }
          const std::string a = (swapped ? "cube" : "stack") + format;
          const std::string b = (swapped ? "stack" : "cube") + format;
          ASSERT_EQ(run("--mesh-a " + a + " --mesh-b " + b + " --poses " + (swapped ? "seen" : "poses") +
                        ".csv --output out.csv --accuracy " + level + further),
                    0)
              << log();
          const std::vector<Row> rows = answers();
          ASSERT_EQ(rows.size(), 4U);
          for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(rows[i].at("status"), "penetrating") << format << ' ' << level << further << i;
            EXPECT_EQ(number(rows[i], "distance"), 0.0);
          }
          EXPECT_EQ(rows[3].at("status"), "ok");
          // The cube's 0.1 passes through single precision on its way from the file.
          EXPECT_GE(number(rows[3], "distance"), 0.4 - 6e-8 * 0.1);
        }
      }
    }
  }
}

TEST_F(DistanceQuery, ConcavePolygonsAreTheBodyThatIsCutByHand) {
  const std::string cases = CONCAVE_DISTANCE_TEST_DATA "/mesh/cases/";
  const auto query = [&](const std::string& mesh) {
    EXPECT_EQ(run("--mesh-a " + cases + mesh + " --mesh-b " + cases + "probe.obj --poses " + cases +
                  "poses.csv --output out.csv"),
              0)
        << log();
    return answers();
  };
  // A cube of side 0.02 beside an L of boxes: closed form.
  const std::vector<Row> by_hand = query("L_triangles.obj");
  ASSERT_EQ(by_hand.size(), 6U);
  EXPECT_NEAR(number(by_hand[0], "distance"), 0.24, 1e-12);
  EXPECT_NEAR(number(by_hand[5], "distance"), 0.19, 1e-12);
  for (const std::string mesh : {"concave_L.obj", "concave_L.ply"}) {
    const std::vector<Row> rows = query(mesh);
    ASSERT_EQ(rows.size(), by_hand.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_NEAR(number(rows[i], "distance"), number(by_hand[i], "distance"), 1e-12) << mesh << " " << i;
      EXPECT_EQ(rows[i].at("status"), by_hand[i].at("status")) << mesh << " " << i;
    }
  }
}

TEST_F(DistanceQuery, AnswersEveryLineInOrder) {
  ASSERT_EQ(runBoxes(""), 0) << log();
  const std::string text = test::contentOf(folder_.path("out.csv"));
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "index,distance,lower_bound,ax,ay,az,bx,by,bz,niche_count,status,time_us,triangle_a,triangle_b");
  const std::vector<Row> rows = answers();
  ASSERT_EQ(rows.size(), 7U);
  const double corner = std::sqrt(3.0 * 0.3 * 0.3);
  // Half sides 0.5 and 0.1: gap along one axis, refused twice, crossing, corner to corner, swallowed.
  const std::vector<std::string> status = {"ok",          "ok", "invalid_pose", "invalid_pose",
                                           "penetrating", "ok", "penetrating"};
  const std::vector<double> distance = {0.4, 0.9, NAN, NAN, 0.0, corner, 0.0};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("index"), std::to_string(i));
    EXPECT_EQ(rows[i].at("status"), status[i]);
    EXPECT_EQ(rows[i].at("lower_bound").empty(), std::isnan(distance[i])) << "the level is certified";
    if (!std::isnan(distance[i])) {
      EXPECT_LE(number(rows[i], "lower_bound"), number(rows[i], "distance"));
      EXPECT_NEAR(number(rows[i], "lower_bound"), distance[i], 1e-12);
    }
    EXPECT_EQ(rows[i].at("niche_count"), "");
    EXPECT_EQ(rows[i].at("triangle_a").empty(), i != 4) << i;
    EXPECT_EQ(rows[i].at("triangle_b").empty(), i != 4) << i;
    if (std::isnan(distance[i])) {
      EXPECT_EQ(rows[i].at("distance"), "");
      EXPECT_EQ(rows[i].at("ax"), "");
      EXPECT_EQ(rows[i].at("time_us"), "");
      continue;
    }
    EXPECT_NEAR(number(rows[i], "distance"), distance[i], 1e-12);
    EXPECT_GT(number(rows[i], "time_us"), 0.0);
    if (status[i] == "ok") {
      EXPECT_NEAR((point(rows[i], "b") - point(rows[i], "a")).norm(), distance[i], 1e-12);
      EXPECT_NEAR(point(rows[i], "a").cwiseAbs().maxCoeff(), 0.5, 1e-12);
    }
  }
}

TEST_F(DistanceQuery, ListsNichesWhenAsked) {
  folder_.write("poses.csv",
                "t,x,y,z,qx,qy,qz,qw\n"
                "0,0.72,0.75,0,0,0,1,0\n"
                "1,0.72,0.75,0,0,0,1,0\n");
  const std::string combs =
      "--mesh-a comb.stl --mesh-b comb.stl --poses poses.csv --output out.csv --max-edge 0.05 ";
  ASSERT_EQ(run(combs + "--niches-output niches.csv"), 0) << log();
  const std::vector<Row> listed = niches();
  const std::vector<Row> rows = answers();
  ASSERT_EQ(rows.size(), 2U);
  ASSERT_EQ(number(rows[0], "niche_count") + number(rows[1], "niche_count"),
            static_cast<double>(listed.size()));
  ASSERT_GT(listed.size(), 2U);
  EXPECT_EQ(listed[0].at("index"), "0");
  EXPECT_EQ(listed[0].at("niche"), "0");
  EXPECT_EQ(listed[0].at("distance"), rows[0].at("distance"));
  for (const Row& niche : listed) {
    EXPECT_NEAR((point(niche, "b") - point(niche, "a")).norm(), number(niche, "distance"), 1e-8);
  }
  // Cold and independent: the same pose, the same answer.
  EXPECT_EQ(rows[0].at("distance"), rows[1].at("distance"));
  EXPECT_EQ(rows[0].at("ax"), rows[1].at("ax"));
  EXPECT_EQ(rows[0].at("niche_count"), rows[1].at("niche_count"));

  ASSERT_EQ(run(combs + "--niches-output niches.csv --cutoff 1e-6"), 0) << log();
  EXPECT_TRUE(niches().empty());
  EXPECT_EQ(answers()[0].at("niche_count"), "0");
}

TEST_F(DistanceQuery, TracksPersistentNiches) {
  std::string poses = "t,x,y,z,qx,qy,qz,qw\n";
  for (int i = 0; i < 30; ++i) {
    poses += std::to_string(0.01 * i) + ",0.72," + std::to_string(0.8 - 0.002 * i) + ",0,0,0,1,0\n";
  }
  folder_.write("poses.csv", poses);
  const std::string combs =
      "--mesh-a comb.stl --mesh-b comb.stl --poses poses.csv --output out.csv --max-edge 0.05 ";
  ASSERT_EQ(run(combs + "--tracking --niches-output niches.csv"), 0) << log();
  const std::vector<Row> rows = answers();
  ASSERT_EQ(rows.size(), 30U);
  std::map<std::string, std::string> nearest;  // the id of the nearest niche of each line
  for (const Row& niche : niches()) {
    nearest.emplace(niche.at("index"), niche.at("niche"));
  }
  for (const auto& [index, id] : nearest) {
    EXPECT_EQ(id, nearest.at("0")) << "line " << index;
  }
  for (const Row& row : rows) {
    EXPECT_EQ(row.at("status"), "ok");
  }
}

TEST_F(DistanceQuery, NodesOverestimateByNoMoreThanTheGridAllows) {
  ASSERT_EQ(runBoxes("--accuracy nodes --max-edge 0.1"), 0) << log();
  const std::vector<Row> nodes = answers();
  EXPECT_GE(number(nodes[0], "distance"), 0.4 - 1e-12);
  EXPECT_LE(number(nodes[0], "distance"), 0.4 + 0.2 / std::sqrt(3.0));
}

TEST_F(DistanceQuery, OneSeedGivesOneAnswer) {
  ASSERT_EQ(runBoxes("--niches-output niches.csv --seed 7"), 0) << log();
  const std::string first = test::contentOf(folder_.path("niches.csv"));
  ASSERT_EQ(runBoxes("--niches-output niches.csv --seed 7"), 0) << log();
  EXPECT_EQ(test::contentOf(folder_.path("niches.csv")), first);
}

TEST_F(DistanceQuery, ProvesTheDistanceAtLevelCertified) {
  const double corner = std::sqrt(3.0 * 0.3 * 0.3);
  const std::vector<std::string> status = {"ok",          "ok", "invalid_pose", "invalid_pose",
                                           "penetrating", "ok", "penetrating"};
  const std::vector<double> distance = {0.4, 0.9, NAN, NAN, 0.0, corner, 0.0};
  for (const std::string further : {"", "--tracking", "--niches-output niches.csv"}) {
    ASSERT_EQ(runBoxes("--accuracy certified " + further), 0) << log();
    const std::vector<Row> rows = answers();
    ASSERT_EQ(rows.size(), 7U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].at("status"), status[i]);
      EXPECT_EQ(rows[i].at("niche_count").empty(),
                further != "--niches-output niches.csv" || std::isnan(distance[i]));
      EXPECT_EQ(rows[i].at("triangle_a").empty(), i != 4)
          << "crossing names the triangles, swallowed does not";
      if (std::isnan(distance[i])) {
        EXPECT_EQ(rows[i].at("lower_bound"), "");
        continue;
      }
      EXPECT_NEAR(number(rows[i], "distance"), distance[i], 1e-12);
      EXPECT_LE(number(rows[i], "lower_bound"), distance[i]);
      EXPECT_GE(number(rows[i], "lower_bound"), distance[i] - 1e-12);
    }
  }
}

TEST_F(DistanceQuery, StopsAProofAtATolerance) {
  folder_.write("poses.csv",
                "t,x,y,z,qx,qy,qz,qw\n"
                "0,0.72,0.75,0,0,0,1,0\n"
                "1,0.72,0.85,0.1,0,0,0.6,0.8\n");
  const std::string combs = "--mesh-a comb.stl --mesh-b comb.stl --poses poses.csv --output out.csv ";
  ASSERT_EQ(run(combs + "--accuracy certified"), 0) << log();
  const std::vector<Row> proven = answers();
  for (const std::string tolerance : {"--tolerance 0.01", "--relative-tolerance 0.5", "--time-budget 10"}) {
    ASSERT_EQ(run(combs + "--accuracy certified " + tolerance), 0) << log();
    const std::vector<Row> rows = answers();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_TRUE(rows[i].at("status") == "ok" || rows[i].at("status") == "tolerance");
      EXPECT_LE(number(rows[i], "lower_bound"), number(proven[i], "distance"));
      EXPECT_GE(number(rows[i], "distance"), number(proven[i], "distance") - 1e-12);
      const double below = number(rows[i], "distance") - number(rows[i], "lower_bound");
      EXPECT_LE(below, std::max(0.01, 0.5 * number(rows[i], "distance")) + 1e-12);
    }
  }
  ASSERT_EQ(run(combs + "--accuracy certified --time-budget 1e-9"), 0) << log();
  for (const Row& row : answers()) {
    // The clock is looked at every few microseconds: an easy proof may be done by then.
    EXPECT_TRUE(row.at("status") == "budget" || row.at("status") == "ok");
    EXPECT_LE(number(row, "lower_bound"), number(row, "distance"));
  }
}

TEST_F(DistanceQuery, ListsEveryNicheAtLevelComplete) {
  // Teeth of 0.1 in gaps of 0.15, in the middle: two slits of 0.025 at each tooth between two others, with
  // walls 0.2 x 0.2 in common.
  folder_.write("poses.csv",
                "t,x,y,z,qx,qy,qz,qw\n"
                "0,0.725,0.6,0,0,0,1,0\n"
                "1,0.725,0.6,0,0,0,1,0\n");
  const std::string combs =
      "--mesh-a comb.stl --mesh-b comb.stl --poses poses.csv --output out.csv --niches-output niches.csv ";
  for (const std::string tracking : {"", "--tracking "}) {
    ASSERT_EQ(run(combs + tracking + "--accuracy complete --cutoff 0.03 --prominence-limit none"), 0)
        << log();
    for (const Row& row : answers()) {
      EXPECT_EQ(row.at("status"), "ok");
      EXPECT_EQ(row.at("niche_count"), "5");
      EXPECT_NEAR(number(row, "distance"), 0.025, 1e-7);  // STL has single precision
      EXPECT_LE(number(row, "lower_bound"), number(row, "distance"));
      EXPECT_NEAR(number(row, "lower_bound"), number(row, "distance"), 1e-12);
    }
    const std::vector<Row> rows = niches();
    ASSERT_EQ(rows.size(), 10U);
    for (const Row& row : rows) {
      EXPECT_EQ(row.at("kind"), "patch");
      EXPECT_NEAR(number(row, "extent"), std::hypot(0.2, 0.2), 1e-6);
      EXPECT_EQ(row.at("outward"), "outward");
      EXPECT_EQ(row.at("visible"), "1");
      EXPECT_TRUE(row.at("niche") != "0" || tracking.empty());
    }
  }
}

TEST_F(DistanceQuery, TakesMarginsFromDistances) {
  ASSERT_EQ(runBoxes("--niches-output niches.csv --margin-a 0.1 --margin-b 0.25"), 0) << log();
  const std::vector<Row> rows = answers();
  EXPECT_NEAR(number(rows[0], "distance"), 0.05, 1e-12);
  EXPECT_NEAR(number(rows[0], "signed_distance"), 0.05, 1e-12);
  EXPECT_NEAR(number(rows[0], "az"), 0.6, 1e-12);
  EXPECT_NEAR(number(rows[0], "bz"), 0.65, 1e-12);
  EXPECT_EQ(rows[2].at("status"), "invalid_pose");
  EXPECT_EQ(rows[4].at("status"), "penetrating");
  EXPECT_EQ(rows[6].at("signed_distance"), "");
  EXPECT_EQ(number(niches()[0], "signed_distance"), number(rows[0], "signed_distance"));
  ASSERT_EQ(runBoxes("--margin-a 0.15 --margin-b 0.3"), 0) << log();
  EXPECT_EQ(number(answers()[0], "distance"), 0.0);
  EXPECT_NEAR(number(answers()[0], "signed_distance"), -0.05, 1e-12);
  EXPECT_EQ(answers()[0].at("status"), "penetrating");
}

TEST_F(DistanceQuery, RefusesMarginsThatCannotBeMeant) {
  for (const std::string margin : {"-0.1", "nan", "inf", "thick"}) {
    EXPECT_EQ(runBoxes("--margin-a " + margin), 2) << log();
    EXPECT_NE(log().find("--margin-a"), std::string::npos) << log();
  }
  EXPECT_EQ(runBoxes("--margin-b 0.4"), 1);
  EXPECT_NE(log().find("--margin-b: margin 0.4 m is larger than the body"), std::string::npos) << log();
  EXPECT_NE(log().find("metres"), std::string::npos) << log();
}

TEST_F(DistanceQuery, RefusesWhatThisVersionCannotDo) {
  EXPECT_EQ(runBoxes("--accuracy exact"), 2);
  EXPECT_NE(log().find("'exact' (allowed: nodes, refined, certified, complete)"), std::string::npos) << log();
  EXPECT_EQ(runBoxes("--accuracy refined --time-budget 1000"), 0) << log();
  EXPECT_EQ(runBoxes("--accuracy refined --time-budget -1"), 2) << log();
  for (const std::string option : {"--tolerance", "--relative-tolerance"}) {
    EXPECT_EQ(runBoxes("--accuracy refined " + option + " 0.001"), 2);
    EXPECT_NE(log().find(option), std::string::npos) << log();
    EXPECT_NE(log().find("--accuracy refined proves no bound"), std::string::npos) << log();
    EXPECT_EQ(runBoxes("--accuracy certified " + option + " -1"), 2) << log();
  }
  EXPECT_EQ(runBoxes("--max-edge 0"), 2);
  EXPECT_EQ(runBoxes("--cutoff -1"), 2);
  EXPECT_EQ(run("--mesh-a box.stl"), 2);
  EXPECT_NE(log().find("--mesh-b is required"), std::string::npos) << log();
}

TEST_F(DistanceQuery, PrintsItsVersions) {
  EXPECT_EQ(run("--version"), 0);
  EXPECT_EQ(log().find("concave_distance "), 0U) << log();
  for (const char* part : {"\ncompiler ", "\nEigen 3.", "\nTBB ", "\nC library "})
    EXPECT_NE(log().find(part), std::string::npos) << log();
}

TEST_F(DistanceQuery, RefusesAnOutputThatIsAnInputOrTheOtherOutputAndWritesNothing) {
  const std::string poses = test::contentOf(folder_.path("poses.csv"));
  const std::string mesh = test::contentOf(folder_.path("box.stl"));
  for (const std::string output : {"poses.csv", "./poses.csv", "box.stl"}) {
    EXPECT_EQ(run("--mesh-a box.stl --mesh-b box.stl --poses poses.csv --output " + output), 1);
    EXPECT_NE(log().find("--output is the same file as"), std::string::npos) << log();
  }
  EXPECT_EQ(runBoxes("--niches-output poses.csv"), 1);
  EXPECT_EQ(runBoxes("--niches-output ./out.csv"), 1);
  EXPECT_EQ(test::contentOf(folder_.path("poses.csv")), poses);
  EXPECT_EQ(test::contentOf(folder_.path("box.stl")), mesh);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out.csv")));
}

TEST_F(DistanceQuery, EndsWithAnErrorWhenADeviceIsFullAndLeavesNoCutFile) {
  EXPECT_EQ(runBoxes("--niches-output /dev/full"), 1);
  EXPECT_NE(log().find("/dev/full"), std::string::npos) << log();
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out.csv")));
}

TEST_F(DistanceQuery, CallsPosesBeyondTheLimitInvalid) {
  folder_.write("poses.csv",
                "t,x,y,z,qx,qy,qz,qw\n0,1e200,0,0,0,0,0,1\n1,-1.1e18,0,0,0,0,0,1\n2,1e18,0,0,0,0,0,1\n");
  ASSERT_EQ(runBoxes(""), 0) << log();
  EXPECT_EQ(answers()[0].at("status"), "invalid_pose");
  EXPECT_EQ(answers()[0].at("distance"), "");
  EXPECT_EQ(answers()[1].at("status"), "invalid_pose");
  EXPECT_EQ(answers()[2].at("status"), "ok");
  EXPECT_NEAR(number(answers()[2], "distance"), 1e18, 1e18 * 0x1p-46);
}

TEST_F(DistanceQuery, NamesTheFileThatIsAtFault) {
  EXPECT_EQ(run("--mesh-a missing.stl --mesh-b box.stl --poses poses.csv --output out.csv"), 1);
  EXPECT_NE(log().find("missing.stl"), std::string::npos) << log();
  EXPECT_EQ(run("--mesh-a box.stl --mesh-b box.stl --poses no.csv --output out.csv"), 1);
  EXPECT_NE(log().find("no.csv"), std::string::npos) << log();
  EXPECT_EQ(run("--mesh-a box.stl --mesh-b box.stl --poses poses.csv --output nowhere/out.csv"), 1);
  EXPECT_NE(log().find("nowhere/out.csv"), std::string::npos) << log();
  folder_.write("bad.csv", "t,x,y,z,qx,qy,qz,qw\n0,0,0,1,0,0,0,1\n0,0,0,1,0,0,0\n");
  EXPECT_EQ(run("--mesh-a box.stl --mesh-b box.stl --poses bad.csv --output out.csv"), 1);
  EXPECT_NE(log().find("bad.csv:3: it has 7 cells"), std::string::npos) << log();
}

}  // namespace
}  // namespace concave_distance::distance_query_test
