#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <set>

#include "ros/bags/bag_fixture.h"

namespace concave_distance::distance_bag_test {
namespace {

using test::atMs;
using test::BagFixture;
using test::BagWriter;
using test::number;
using test::Row;
using test::textOf;
using test::transformOf;

constexpr double kRounding = 1e-12;  // m

class DistanceBag : public BagFixture {
 protected:
  std::vector<std::string> stampsOf(const std::string& pair) const {
    std::vector<std::string> stamps;
    for (const Row& row : answers()) {
      if (row.at("pair") == pair) stamps.push_back(row.at("stamp"));
    }
    return stamps;
  }
};

TEST_F(DistanceBag, AnswersEveryStampInOrderWithTheClosedForm) {
  writeMotion("run.bag");
  ASSERT_EQ(runBoxes("--bag run.bag --niches-output n.csv"), 0) << log();
  const std::vector<Row> found = rows();
  ASSERT_EQ(found.size(), 100U);
  for (int i = 0; i < 100; ++i) {
    const Row& row = found[static_cast<std::size_t>(i)];
    EXPECT_EQ(row.at("stamp"), textOf(atMs(10 * i)));
    EXPECT_EQ(row.at("time"), row.at("stamp"));
    EXPECT_EQ(row.at("pair"), "a/b");
    EXPECT_EQ(row.at("body_a") + row.at("body_b"), "ab");
    EXPECT_EQ(row.at("status"), "ok");
    EXPECT_NEAR(number(row, "distance"), 1.0 + 0.001 * i, kRounding);
    EXPECT_NEAR(number(row, "lower_bound"), 1.0 + 0.001 * i, kRounding);
    EXPECT_NEAR(number(row, "ax"), 0.5, kRounding);
    EXPECT_NEAR(number(row, "bx"), 1.5 + 0.001 * i, kRounding);
    EXPECT_NEAR(number(row, "nx"), 1.0, kRounding);
    EXPECT_EQ(row.at("closing_speed").empty(), i == 0);
    if (i > 0) {
      EXPECT_NEAR(number(row, "closing_speed"), -0.1, 1e-9);
    }
    EXPECT_EQ(row.at("niche_count"), "1");
    EXPECT_EQ(row.at("niche"), found.front().at("niche")) << "it lives on";
    EXPECT_EQ(row.at("message"), "");
  }
  const std::vector<Row> niches = rows("n.csv");
  ASSERT_EQ(niches.size(), 100U);
  EXPECT_EQ(niches[7].at("niche"), found[7].at("niche"));
  EXPECT_EQ(niches[7].at("distance"), found[7].at("distance"));
  EXPECT_EQ(niches[7].at("kind"), "patch");
  EXPECT_EQ(niches[7].at("outward"), "outward");
  EXPECT_NE(log().find("real-time factor"), std::string::npos) << log();
  EXPECT_NE(log().find("100 stamps, 100 rows, 100 distances"), std::string::npos) << log();
}

TEST_F(DistanceBag, WritesTheSameBytesEachTimeForAnyThreadsAndCompression) {
  writeMotion("run.bag");
  writeMotion("bz2.bag", 100, rosbag::compression::BZ2);
  writeMotion("lz4.bag", 100, rosbag::compression::LZ4);
  ASSERT_EQ(runBoxes("--bag run.bag --niches-output n.csv --threads 1"), 0) << log();
  const std::string expected = content("d.csv");
  const std::string expected_niches = content("n.csv");
  for (const std::string further : {"run.bag", "run.bag --threads 3", "bz2.bag", "lz4.bag --threads 2"}) {
    ASSERT_EQ(runBoxes("--niches-output n.csv --bag " + further), 0) << log();
    EXPECT_EQ(content("d.csv"), expected) << further;
    EXPECT_EQ(content("n.csv"), expected_niches) << further;
  }
}

// Positions are linear in time, so that interpolated ones have a closed form: b is at 2 + 0.1 t, a at 0.3 t.
TEST_F(DistanceBag, AnswersTheStampsOfPublishersOfDifferentRates) {
  std::set<int> expected;
  {
    BagWriter writer(folder_.path("run.bag"));
    for (int ms = 0; ms <= 1000; ++ms) {
      if (ms % 10 == 3) writer.move({transformOf("a", 3e-4 * ms, atMs(ms))});
      if (ms % 300 == 50) writer.move({transformOf("b", 2.0 + 1e-4 * ms, atMs(ms))});
      if ((ms % 10 == 3 || ms % 300 == 50) && ms >= 50 && ms <= 950) expected.insert(ms);
    }
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  std::vector<std::string> stamps;
  for (const int ms : expected) stamps.push_back(textOf(atMs(ms)));
  EXPECT_EQ(stampsOf("a/b"), stamps);
  const std::vector<Row> found = answers();
  std::size_t place = 0;
  for (const int ms : expected) {
    EXPECT_NEAR(number(found[place], "distance"), 1.0 - 2e-4 * ms, 1e-9) << ms;
    ++place;
  }
  EXPECT_EQ(rows().front().at("status"), "missing_transform") << "before b is known";
}

TEST_F(DistanceBag, AnswersTheStampsOfManyPublishersAlsoTheLastOnes) {
  constexpr int kBoxes = 9;
  std::string scene = "bodies:\n  - {name: a, frame: world, box: {size: [1, 1, 1]}}\n";
  std::string pairs = "pairs:\n";
  for (int box = 0; box < kBoxes; ++box) {
    const std::string name = "b" + std::to_string(box);
    scene += "  - {name: " + name + ", box: {size: [1, 1, 1]}}\n";
    pairs += "  - {between: [a, " + name + "]}\n";
  }
  folder_.write("many.yaml", scene + pairs);
  {
    BagWriter writer(folder_.path("run.bag"));
    for (int ms = 0; ms < 500; ++ms) {
      if (ms % 20 < kBoxes)
        writer.move({transformOf("b" + std::to_string(ms % 20), 2.0 + 1e-3 * ms, atMs(ms))});
    }
  }
  ASSERT_EQ(run("--scene many.yaml --bag run.bag --output d.csv"), 0) << log();
  for (int box = 0; box < kBoxes; ++box) {
    std::vector<std::string> stamps;
    for (int ms = box; ms < 500; ms += 20) stamps.push_back(textOf(atMs(ms)));
    EXPECT_EQ(stampsOf("a/b" + std::to_string(box)), stamps) << box;
  }
  for (const Row& row : answers()) {
    const double ms = 1e3 * (std::stod(row.at("stamp").substr(7)) - std::stod(textOf(atMs(0)).substr(7)));
    EXPECT_NEAR(number(row, "distance"), 1.0 + 1e-3 * ms, 1e-9);
  }
}

TEST_F(DistanceBag, PlaysSeveralBagsAsOne) {
  {
    BagWriter robot(folder_.path("robot.bag"));
    BagWriter object(folder_.path("object.bag"));
    BagWriter both(folder_.path("both.bag"));
    for (int i = 0; i < 50; ++i) {
      robot.move({transformOf("a", 0.001 * i, atMs(10 * i))});
      both.move({transformOf("a", 0.001 * i, atMs(10 * i))});
      object.move({transformOf("b", 2.0 + 0.002 * i, atMs(10 * i + 5))});
      both.move({transformOf("b", 2.0 + 0.002 * i, atMs(10 * i + 5))});
    }
  }
  ASSERT_EQ(runBoxes("--bag both.bag"), 0) << log();
  const std::string expected = content("d.csv");
  EXPECT_EQ(answers().size(), 98U) << "from b's first stamp to a's last";
  ASSERT_EQ(runBoxes("--bag robot.bag --bag object.bag"), 0) << log();
  EXPECT_EQ(content("d.csv"), expected);
}

TEST_F(DistanceBag, PlaysAPartWithTheStaticTransformsFromBefore) {
  writeMotion("run.bag");
  ASSERT_EQ(runBoxes("--bag run.bag --start 0.25 --duration 0.5"), 0) << log();
  const std::vector<std::string> stamps = stampsOf("a/b");
  ASSERT_EQ(stamps.size(), 51U);
  EXPECT_EQ(stamps.front(), textOf(atMs(250)));
  EXPECT_EQ(stamps.back(), textOf(atMs(750)));
  EXPECT_NEAR(number(answers().front(), "distance"), 1.025, kRounding);
}

TEST_F(DistanceBag, TakesTopicsInANamespace) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.move({transformOf("a", 0.0, atMs(0))}, "/cell/tf_static");
    writer.move({transformOf("b", 2.0, atMs(10))}, "/cell/tf");
    writer.move({transformOf("b", 3.0, atMs(20))}, "/tf");
  }
  ASSERT_EQ(runBoxes("--bag run.bag --tf-topic /cell/tf --tf-static-topic cell/tf_static"), 0) << log();
  EXPECT_EQ(stampsOf("a/b"), std::vector<std::string>{textOf(atMs(10))});
}

TEST_F(DistanceBag, SaysFromWhenOnAPairHasNoAnswer) {
  {
    BagWriter writer(folder_.path("run.bag"));
    for (int i = 0; i < 400; ++i) {
      writer.move({transformOf("a", 0.0, atMs(10 * i))});
      if (i < 50 || i >= 300) writer.move({transformOf("b", 2.0, atMs(10 * i))});
    }
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  std::vector<Row> without;
  for (const Row& row : rows()) {
    if (row.at("distance").empty()) without.push_back(row);
  }
  ASSERT_EQ(without.size(), 1U);
  EXPECT_EQ(without[0].at("status"), "stale_transform");
  EXPECT_EQ(without[0].at("stamp"), textOf(atMs(490)));
  EXPECT_EQ(without[0].at("time"), textOf(atMs(1500))) << "the first stamp of a more than a second later";
  EXPECT_NE(without[0].at("message").find("--stale-after is 1 s"), std::string::npos)
      << without[0].at("message");
  EXPECT_EQ(stampsOf("a/b").size(), 50U + 100U) << "so long a gap is not interpolated";
}

TEST_F(DistanceBag, ChangesStaticTransformsAtTheirTime) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.stand(transformOf("a", 0.0, atMs(0)));
    for (int i = 0; i < 100; ++i) {
      if (i == 60) writer.stand(transformOf("a", -1.0, atMs(596)));
      writer.move({transformOf("b", 2.0, atMs(10 * i))});
    }
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  const std::vector<Row> found = answers();
  ASSERT_EQ(found.size(), 100U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(number(found[i], "distance"), i < 60 ? 1.0 : 2.0, kRounding) << i;
  }
}

TEST_F(DistanceBag, AnswersAPairThatStandsStillOnce) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.stand(transformOf("a", 0.0, atMs(0)));
    writer.stand(transformOf("b", 2.0, atMs(1)));
    writer.stand(transformOf("b", 2.0, atMs(2)));
    for (int i = 1; i < 20; ++i) writer.move({transformOf("elsewhere", i, atMs(10 * i))});
    writer.stand(transformOf("b", 1.25, atMs(300)));
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  const std::vector<Row> found = answers();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(number(found[0], "distance"), 1.0, kRounding);
  EXPECT_NEAR(number(found[1], "distance"), 0.25, kRounding);
}

TEST_F(DistanceBag, HasNoBudgetAndTakesSettingsThatTheSceneLeavesOut) {
  writeMotion("run.bag");
  folder_.write("budget.yaml", "defaults: {time_budget: 1e-9}\n" + content("boxes.yaml") +
                                   "  - {between: [b, a], name: again}\n");
  folder_.write("budget.yaml", "defaults: {time_budget: 1e-9}\n" + content("boxes.yaml"));
  ASSERT_EQ(run("--scene budget.yaml --bag run.bag --output d.csv --cutoff 1.05"), 0) << log();
  const std::vector<Row> found = rows();
  ASSERT_EQ(found.size(), 52U);
  for (std::size_t i = 0; i < 51; ++i) EXPECT_EQ(found[i].at("status"), "ok") << i;
  EXPECT_EQ(found.back().at("status"), "beyond_cutoff");
  EXPECT_NEAR(number(found.back(), "lower_bound"), 1.051, 1e-9);
}

TEST_F(DistanceBag, FollowsThePairsThatAreNamed) {
  folder_.write("three.yaml",
                "bodies:\n"
                "  - {name: a, box: {size: [1, 1, 1]}}\n"
                "  - {name: b, box: {size: [1, 1, 1]}}\n"
                "  - {name: c, frame: world, pose: {xyz: [0, 3, 0]}, box: {size: [1, 1, 1]}}\n"
                "pairs:\n"
                "  - {between: [a, b]}\n  - {between: [a, c]}\n  - {between: [b, c]}\n");
  writeMotion("run.bag", 10);
  ASSERT_EQ(run("--scene three.yaml --bag run.bag --output d.csv --pairs '*c'"), 0) << log();
  EXPECT_EQ(rows().size(), 11U) << "a and c stand";
  ASSERT_EQ(run("--scene three.yaml --bag run.bag --output d.csv"), 0) << log();
  EXPECT_EQ(rows().size(), 21U);
}

TEST_F(DistanceBag, ReportsOverlap) {
  {
    BagWriter writer(folder_.path("run.bag"));
    for (int i = 0; i < 3; ++i) {
      writer.move({transformOf("a", 0.0, atMs(10 * i)), transformOf("b", 1.5 - 0.4 * i, atMs(10 * i))});
    }
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  ASSERT_EQ(rows().size(), 3U);
  EXPECT_EQ(rows()[2].at("status"), "penetrating");
  EXPECT_EQ(number(rows()[2], "distance"), 0.0);
  EXPECT_NE(rows()[2].at("triangle_a"), "");
}

TEST_F(DistanceBag, AnswersARobotAlone) {
  folder_.write(
      "robot.urdf",
      "<robot name='two'>"
      "<link name='base'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
      "<link name='middle'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
      "<link name='tip'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
      "<joint name='j1' type='prismatic'><parent link='base'/><child link='middle'/><axis xyz='1 0 0'/>"
      "<limit lower='0' upper='1' effort='1' velocity='1'/></joint>"
      "<joint name='j2' type='prismatic'><parent link='middle'/><child link='tip'/><axis xyz='1 0 0'/>"
      "<origin xyz='2 0 0'/><limit lower='0' upper='1' effort='1' velocity='1'/></joint></robot>");
  {
    BagWriter writer(folder_.path("run.bag"));
    for (int i = 0; i < 10; ++i) {
      writer.move({transformOf("middle", 0.01 * i, atMs(10 * i), "base"),
                   transformOf("tip", 2.0, atMs(10 * i), "middle")});
    }
  }
  const std::string alone =
      "--robot-description robot.urdf --reference-frame base --bag run.bag --output d.csv";
  ASSERT_EQ(run(alone + " --cutoff 0.5"), 0) << log();
  EXPECT_TRUE(rows().empty());
  EXPECT_NE(log().find("no pair comes within its cutoff"), std::string::npos) << log();
  ASSERT_EQ(run(alone + " --cutoff 5"), 0) << log();
  ASSERT_EQ(answers().size(), 10U);
  EXPECT_NEAR(number(answers().back(), "distance"), 1.09, kRounding);
  folder_.write("scene.yaml",
                "robots:\n  - description: tool_description\npairs:\n  - between: [base, tip]\n");
  const std::string further = " --reference-frame base --bag run.bag --output d.csv";
  EXPECT_EQ(run("--scene scene.yaml" + further), 1);
  EXPECT_NE(log().find("give its file: --description tool_description=FILE"), std::string::npos) << log();
  ASSERT_EQ(run("--scene scene.yaml --description tool_description=robot.urdf" + further), 0) << log();
  EXPECT_EQ(answers().size(), 10U);
}

TEST_F(DistanceBag, DrawsItsRows) {
  writeMotion("run.bag");
  ASSERT_EQ(runBoxes("--bag run.bag --plot d.png"), 0) << log();
  EXPECT_EQ(content("d.png").substr(1, 3), "PNG");
  EXPECT_EQ(runBoxes("--bag run.bag --plot d.nothing"), 1);
  EXPECT_NE(log().find("the plot could not be drawn; the rows are complete"), std::string::npos) << log();
  EXPECT_EQ(rows().size(), 100U);
}

// The pipe is full long before the end, so that it is interrupted on the way.
TEST_F(DistanceBag, EndsItsRowsWhereItIsInterrupted) {
  constexpr int kCount = 5000;
  writeMotion("run.bag", kCount);
  const std::string pipe = folder_.path("rows");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string log_path = folder_.path("log");
  const pid_t child = fork();
  if (child == 0) {
    if (std::freopen(log_path.c_str(), "w", stderr) == nullptr) _exit(1);
    execl(CONCAVE_DISTANCE_DISTANCE_BAG, "distance_bag", "--scene", folder_.path("boxes.yaml").c_str(),
          "--bag", folder_.path("run.bag").c_str(), "--output", pipe.c_str(), nullptr);
    _exit(1);
  }
  std::ifstream reader(pipe);
  std::string header;
  std::getline(reader, header);
  kill(child, SIGINT);
  std::string line;
  std::size_t lines = 0;
  std::string last;
  while (std::getline(reader, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','))
        << line;
    EXPECT_FALSE(reader.eof()) << "the last line is whole";
    last = line;
    ++lines;
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_GT(lines, 0U);
  EXPECT_LT(lines, static_cast<std::size_t>(kCount));
  EXPECT_NE(log().find("interrupted after"), std::string::npos) << log();
}

TEST_F(DistanceBag, LeavesCloudsOutAndSaysSo) {
  writeMotion("run.bag", 10);
  folder_.write("cloud.yaml",
                content("boxes.yaml") +
                    "  - {between: [a, camera]}\nclouds:\n  - {name: camera, topic: /points, frame: a}\n");
  ASSERT_EQ(run("--scene cloud.yaml --bag run.bag --output d.csv"), 0) << log();
  EXPECT_NE(log().find("warning: cloud 'camera' is left out"), std::string::npos) << log();
  EXPECT_EQ(log().find("no answer"), std::string::npos) << log();
  EXPECT_EQ(rows().size(), 10U);
}

TEST_F(DistanceBag, HelpsAndRefusesAWrongCommandLine) {
  EXPECT_EQ(run("--help"), 0);
  for (const std::string text : {"--niches-output", "time,stamp,pair,", "Exit status", "--tf-static-topic"}) {
    EXPECT_NE(log().find(text), std::string::npos) << text;
  }
  EXPECT_EQ(log().find("]("), std::string::npos) << "links of the documents: " << log();
  EXPECT_NE(log().find("later ones are refused"), std::string::npos) << "but their texts: " << log();
  EXPECT_EQ(run("--bag run.bag"), 2);
  EXPECT_EQ(runBoxes("--bag run.bag --stale-after -1"), 2);
  EXPECT_EQ(runBoxes("--bag run.bag --time-budget 1"), 2) << "it has none";
}

}  // namespace
}  // namespace concave_distance::distance_bag_test
