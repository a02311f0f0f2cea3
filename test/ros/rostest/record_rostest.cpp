// record_pair of a running node: what it writes is replayed by the built distance_query to the same bits, the
// cycle goes on meanwhile, and nothing is written that was not asked for.
#include <concave_distance/ApplyScene.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/Niches.h>
#include <concave_distance/RecordPair.h>
#include <concave_distance/SetPairEnabled.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "node_access.h"
#include "operation_messages.h"
#include "support/csv_table.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "tf_player.h"

namespace concave_distance::record_rostest {
namespace {

RecordPairResponse record(const std::string& a, const std::string& b, const std::string& folder = "",
                          std::uint32_t poses = 0) {
  RecordPairRequest request;
  request.body_a = a;
  request.body_b = b;
  request.folder = folder;
  request.poses = poses;
  return call<RecordPair>(kNode + "record_pair", request);
}

void expectRefused(const RecordPairResponse& response, const std::string& part) {
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find(part), std::string::npos) << part << " in: " << response.message;
  EXPECT_TRUE(response.files.empty());
}

class Record : public ::testing::Test {
 protected:
  Record() {
    player.place("pill", 0.3, 0.4, 0.9);
    move();
    EXPECT_TRUE(eventually([] { return call<ListBodies>(kNode + "list_bodies", {}).ready != 0; }));
    waitForAnswers("watched", 8);
  }
  ~Record() override { running = false; }

  /// Moves the hook over the comb and back, turning.
  void move() {
    mover = std::async(std::launch::async, [this] {
      for (double t = 0.0; running; t += 0.01) {
        player.place("hook", 0.1 * std::sin(t), 0.05 * std::cos(0.7 * t), 0.62 + 0.1 * std::sin(0.3 * t),
                     0.2 * t);
        ros::WallDuration(0.01).sleep();
      }
    });
  }
  /// Waits for so many messages with an answer of a pair.
  void waitForAnswers(const std::string& pair, std::size_t count) {
    niches.clear();
    EXPECT_TRUE(eventually([&] {
      std::size_t answers = 0;
      for (const Niches& message : niches.all()) {
        for (const PairNiches& one : message.pairs)
          answers += one.nearest.pair == pair && one.nearest.has_distance ? 1 : 0;
      }
      return answers >= count;
    })) << pair;
  }
  int replay(const std::string& folder) {
    const std::string program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "distance_query";
    return test::runIn(scratch, program, "--replay " + folder);
  }
  std::string log() const { return test::contentOf(scratch.path("log")); }
  /// A place below the folder in which the node may write.
  std::string below(const std::string& name) const { return scratch.path(name); }

  std::atomic<bool> running{true};
  test::TemporaryFolder scratch;
  TfPlayer player;
  Collector<Niches> niches{kNode + "niches"};
  std::future<void> mover;
};

TEST_F(Record, IsReplayedToTheSameBits) {
  for (const auto& [a, b, pair] : std::vector<std::array<std::string, 3>>{
           {"comb", "hook", "watched"}, {"pill", "comb", "pill/comb"}, {"hook", "pill", "hook/pill"}}) {
    waitForAnswers(pair, 20);
    const auto response = record(a, b, below(a + "_" + b));
    ASSERT_TRUE(response.success) << response.message;
    EXPECT_EQ(response.message, "");
    EXPECT_EQ(response.folder, std::filesystem::canonical(below(a + "_" + b)).string());
    EXPECT_GE(response.poses, 1U);
    EXPECT_LE(response.poses, 60U);
    EXPECT_EQ(response.answered, response.poses);
    EXPECT_LT((ros::Time::now() - response.newest).toSec(), 60.0);
    for (const std::string& file : response.files)
      EXPECT_TRUE(std::filesystem::is_regular_file(file)) << file;
    EXPECT_EQ(replay(response.folder), 0) << log();
    EXPECT_NE(log().find("pair " + pair + ": "), std::string::npos) << log();
    EXPECT_NE(log().find("bit for bit"), std::string::npos) << log();
    // The folder has the live answers too, proven as the replay is.
    const auto live = test::readTable(response.folder + "/live.csv");
    const auto answers = test::readTable(response.folder + "/answers.csv");
    ASSERT_EQ(live.size(), response.poses);
    ASSERT_EQ(answers.size(), response.poses);
    for (std::size_t i = 0; i < live.size(); ++i) {
      if (live[i].at("status") != "ok" || answers[i].at("status") != "ok") continue;
      EXPECT_NEAR(test::number(live[i], "distance"), test::number(answers[i], "distance"), kRounding);
    }
    EXPECT_EQ(test::readTable(response.folder + "/live_answer.csv").size(), 1U);
    EXPECT_EQ(test::readTable(response.folder + "/live_niches.csv").size(),
              test::number(live.back(), "niche_count"));
  }
}

TEST_F(Record, AnEditedRecordingIsToldFromTheNode) {
  waitForAnswers("watched", 5);
  const auto response = record("hook", "comb", below("edited"), 3);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.poses, 3U);
  const std::string poses = response.folder + "/poses.csv";
  const std::string text = test::contentOf(poses);
  const std::size_t line = text.find('\n') + 1;
  const std::size_t x = text.find(',', line) + 1;
  scratch.write("edited/poses.csv", text.substr(0, x) + "0.5" + text.substr(text.find(',', x)));
  EXPECT_EQ(replay(response.folder), 3) << log();
  EXPECT_NE(log().find("answers.csv:2: distance is "), std::string::npos) << log();
  EXPECT_NE(log().find("the largest difference is "), std::string::npos) << log();
}

TEST_F(Record, TheCycleGoesOnAndOneIsWrittenAtATime) {
  waitForAnswers("watched", 30);
  niches.clear();
  std::vector<std::future<RecordPairResponse>> calls;
  for (int i = 0; i < 3; ++i) {
    calls.push_back(std::async(std::launch::async, [&, i] {
      return record("hook", "comb", below("same_time_" + std::to_string(i)));
    }));
  }
  std::size_t written = 0;
  for (auto& one : calls) {
    const RecordPairResponse response = one.get();
    written += response.success ? 1 : 0;
    if (!response.success) expectRefused(response, "SERVICE BUSY: another recording is being written");
  }
  EXPECT_GE(written, 1U);
  EXPECT_GT(niches.count(), 0U);
  waitForAnswers("watched", 3);
}

TEST_F(Record, BeginsAnewWithAnotherMeshAndGoesOnThroughAnAttachment) {
  waitForAnswers("hook/pill", 30);
  ApplySceneRequest request;
  SceneOperation add = operation(SceneOperation::ADD, "part");
  add.frame_id = "world";
  add.pose = at(0.4, 0.4, 0.9);
  add.primitives.resize(1);
  add.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  add.primitives[0].dimensions = {0.1, 0.1, 0.1};
  add.pair_with = {"hook"};
  request.operations = {add};
  const auto apply = [&] {
    const auto response = call<ApplyScene>(kNode + "apply_scene", request);
    EXPECT_TRUE(response.success) << response.message;
  };
  apply();
  waitForAnswers("part/hook", 5);
  request.operations = {operation(SceneOperation::ATTACH, "part", "pill")};
  apply();
  waitForAnswers("part/hook", 5);
  const auto attached = record("part", "hook", below("attached"));
  ASSERT_TRUE(attached.success) << attached.message;
  EXPECT_GE(attached.poses, 10U) << "before and after";
  EXPECT_EQ(replay(attached.folder), 0) << log();
  request.operations = {operation(SceneOperation::DETACH, "part"), operation(SceneOperation::REMOVE, "part"),
                        add};
  request.operations[2].primitives[0].dimensions = {0.2, 0.1, 0.1};
  apply();
  waitForAnswers("part/hook", 2);
  const auto replaced = record("part", "hook", below("replaced"));
  ASSERT_TRUE(replaced.success) << replaced.message;
  EXPECT_LT(replaced.poses, attached.poses);
  EXPECT_EQ(replay(replaced.folder), 0) << log();
  request.operations = {operation(SceneOperation::REMOVE, "part")};
  apply();
}

TEST_F(Record, RefusesWhatCannotBeRecorded) {
  expectRefused(record("nobody", "comb", below("x")),
                "body_a: there is no body 'nobody' (list_bodies has their names)");
  expectRefused(record("comb", "", below("x")), "body_b: there is no body ''");
  expectRefused(record("comb", "comb", below("x")), "body_b: it is body_a, too (name two bodies)");
  expectRefused(record("pill", "lost", below("x")), "it is not watched (set_pair_enabled");
  const char* const no_answer = "it has had no answer yet (subscribe to distances or niches";
  // tf may be a cycle behind on a busy machine.
  ASSERT_TRUE(eventually(
      [&] { return record("hook", "far/box", below("x")).message.find(no_answer) != std::string::npos; }));
  ASSERT_TRUE(eventually([&] {
    return record("hook", "lost", below("x")).message.find("its poses were not known") != std::string::npos;
  }));
  expectRefused(record("hook", "comb", "/etc/recording"), "is not below");
  expectRefused(record("hook", "comb", below("none/recording")), "there is no folder");
  expectRefused(record("hook", "comb", ".."), "folder: it is '..' (end it with a name)");
  scratch.write("taken/file", "mine");
  expectRefused(record("hook", "comb", below("taken")), "it is there already (name another folder");
  EXPECT_EQ(test::contentOf(scratch.path("taken/file")), "mine");
  EXPECT_FALSE(std::filesystem::exists(below("x")));
  SetPairEnabledRequest disable;
  disable.pair = "watched";
  ASSERT_TRUE(call<SetPairEnabled>(kNode + "set_pair_enabled", disable).success);
  expectRefused(record("hook", "comb", below("x")), "pair watched: it is not watched");
  disable.enabled = 1;
  ASSERT_TRUE(call<SetPairEnabled>(kNode + "set_pair_enabled", disable).success);
}

TEST_F(Record, MakesANameAndSaysWhenThereAreFewerPoses) {
  waitForAnswers("watched", 3);
  const auto first = record("hook", "comb", "", 5000);
  ASSERT_TRUE(first.success) << first.message;
  EXPECT_NE(first.message.find("of 5000: the node keeps 60 (~expert/record_length)"), std::string::npos)
      << first.message;
  const auto second = record("hook", "comb");
  ASSERT_TRUE(second.success) << second.message;
  EXPECT_NE(first.folder, second.folder);
  for (const auto& response : {first, second}) {
    EXPECT_EQ(std::filesystem::path(response.folder).filename().string().rfind("record_hook_comb_", 0), 0U)
        << response.folder;
    std::filesystem::remove_all(response.folder);
  }
}

}  // namespace
}  // namespace concave_distance::record_rostest
