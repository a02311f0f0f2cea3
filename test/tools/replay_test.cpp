// distance_query --replay, as the one who is sent a recording runs it: what it prints, what it returns.
#include <gtest/gtest.h>

#include <string>

#include "support/csv_table.h"
#include "support/recorded_pair.h"
#include "support/run_program.h"

namespace concave_distance::replay_test {
namespace {

class Replay : public ::testing::Test {
 protected:
  Replay() {
    test::RecordedPair pair(test::bodyOf("comb", test::meshOf("comb", test::makeComb(3)), 0.01),
                            test::bodyOf("ball", test::makeRoundBody(test::sphereOf(0.2))), {});
    pair.run(test::passingMotion(), 12);
    answers_ = test::writeRecording(*pair.take(), folder_.path("record"));
  }

  /// Exit status; what it prints goes to the file "log".
  int run(const std::string& arguments) {
    return test::runIn(folder_, CONCAVE_DISTANCE_DISTANCE_QUERY, arguments);
  }
  std::string log() const { return test::contentOf(folder_.path("log")); }
  void change(const std::string& file, const std::string& from, const std::string& to) {
    folder_.write("record/" + file,
                  test::replaced(test::contentOf(folder_.path("record/" + file)), from, to));
  }
  void expectLog(const std::string& part) const {
    EXPECT_NE(log().find(part), std::string::npos) << part << " in: " << log();
  }

  test::TemporaryFolder folder_;
  detail::RecordAnswers answers_;
};

TEST_F(Replay, SaysThatAllIsTheSame) {
  EXPECT_EQ(run("--replay record"), 0);
  expectLog("pair comb/ball: 12 poses, 12 of them answered in the recording\n");
  expectLog("recorded with concave_distance ");
  expectLog("every distance, point and list is the recorded one, bit for bit\n");
  EXPECT_EQ(log().find("replayed with"), std::string::npos);
}

TEST_F(Replay, WritesTheAnswersWhereTheyAreWanted) {
  EXPECT_EQ(run("--replay record --output out.csv --niches-output niches.csv"), 0) << log();
  EXPECT_EQ(test::contentOf(folder_.path("out.csv")), answers_.answers);
  EXPECT_EQ(test::contentOf(folder_.path("niches.csv")), answers_.niches);
  EXPECT_EQ(run("--replay record --output record/answers.csv"), 1);
  expectLog("record/answers.csv");
}

// The mesh of the body that is not round, by hand, with the poses as they were recorded.
TEST_F(Replay, PosesOfARecordingAreThoseOfAnyQuery) {
  EXPECT_EQ(run("--mesh-a record/a.obj --mesh-b record/b.obj --poses record/poses.csv --output out.csv "
                "--margin-a 0.01 --cache off"),
            0)
      << log();
  const auto by_hand = test::readTable(folder_.path("out.csv"));
  const auto recorded = test::readTable(folder_.path("record/answers.csv"));
  ASSERT_EQ(by_hand.size(), recorded.size());
  for (std::size_t i = 0; i < by_hand.size(); ++i) {
    EXPECT_EQ(by_hand[i].at("status"), recorded[i].at("status"));
    // The mesh of the ball lies within its chord error inside it.
    EXPECT_GE(test::number(by_hand[i], "distance"), test::number(recorded[i], "distance"));
    EXPECT_LE(test::number(by_hand[i], "distance"), test::number(recorded[i], "distance") + 0.01);
  }
}

TEST_F(Replay, NamesWhatDiffersAndTheLargestDifference) {
  const test::Row row = test::readTable(folder_.path("record/answers.csv")).at(4);
  change("answers.csv", "," + row.at("distance") + ",", ",123,");
  EXPECT_EQ(run("--replay record"), 3);
  expectLog("record/answers.csv:6: distance is " + row.at("distance") + ", recorded: 123\n");
  expectLog("1 answers are not as recorded, of 12; the largest difference is 12");
  EXPECT_EQ(log().find("bit for bit"), std::string::npos);
}

TEST_F(Replay, SaysThatOtherVersionsHaveRecorded) {
  change("record.yaml", "compiler: ", "compiler: \"other\", former: ");
  EXPECT_EQ(run("--replay record"), 0);
  expectLog("compiler other");
  expectLog("replayed with concave_distance ");
}

TEST_F(Replay, RefusesWhatIsNoRecordingAndOptionsThatItHas) {
  EXPECT_EQ(run("--replay nowhere"), 1);
  expectLog("nowhere: there is no such folder (name the folder that record_pair has written)");
  change("record.yaml", "poses: 12", "poses: 13");
  EXPECT_EQ(run("--replay record"), 1);
  expectLog("it has 12 poses of 13 that were recorded");
  EXPECT_EQ(run("--replay record --cutoff 2"), 2);
  expectLog("--cutoff: the recording says it; leave it out with --replay");
  EXPECT_EQ(run("--mesh-a record/a.obj"), 2);
  expectLog("--mesh-b is required");
}

TEST_F(Replay, ToolsPrintTheirVersions) {
  EXPECT_EQ(run("--version"), 0);
  EXPECT_EQ(log().find("concave_distance "), 0U) << log();
  for (const char* part : {"\ncompiler ", "\nEigen 3.", "\nTBB ", "\nC library "}) expectLog(part);
}

}  // namespace
}  // namespace concave_distance::replay_test
