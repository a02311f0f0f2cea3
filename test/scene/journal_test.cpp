// A journal holds no more than what makes the scene: later operations take the place of earlier ones on the
// same body or pairs and property, and a replay gives what the operations gave.
#include "scene/journal.h"

#include <gtest/gtest.h>

#include "concave_distance/base/error.h"
#include "operations_fixture.h"

namespace concave_distance::journal_test {
namespace {

using namespace test::operations;
using Names = std::vector<std::string>;

class JournalTest : public ::testing::Test {
 protected:
  static SceneOperation ofPairs(OperationKind kind, const std::string& pair) {
    SceneOperation one = operation(kind, "");
    one.pair = pair;
    return one;
  }
  void apply(const SceneOperation& one) { applyOperation(scene, one, frames.now()); }
  void apply(OperationKind kind, const std::string& name, const std::string& other = "") {
    apply(kind == OperationKind::Add ? add(body(name, "world")) : operation(kind, name, other));
  }
  /// What the journal has, in its order.
  Names journal() const {
    Names names;
    for (const auto& one : scene.operations) names.push_back(nameOf(*one));
    return names;
  }

  Scene scene = cell();
  Frames frames;
};

TEST_F(JournalTest, ALaterMoveTakesThePlaceOfAnEarlierOne) {
  apply(OperationKind::Move, "table");
  apply(OperationKind::Move, "box");
  apply(move("table", at(1, 2, 3)));
  EXPECT_EQ(journal(), (Names{"move 'table'", "move 'box'"}));
  EXPECT_EQ(scene.operations[0]->frame_from_body.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST_F(JournalTest, AnAdditionAndTheRemovalOfTheSameBodyLeaveNothing) {
  apply(OperationKind::Add, "cup");
  SceneOperation beside = add(body("ball", "world"));
  beside.partners.names = {"cup"};
  apply(beside);
  apply(OperationKind::Move, "cup");
  apply(OperationKind::SetMargin, "cup");
  apply(OperationKind::AllowContact, "hand", "cup");
  apply(ofPairs(OperationKind::DisablePairs, "ball/cup"));
  apply(OperationKind::Remove, "cup");
  EXPECT_EQ(journal(), Names{"add 'ball'"});
  EXPECT_TRUE(scene.operations[0]->partners.names.empty());
  EXPECT_TRUE(scene.operations[0]->partners.none) << "not every body";
}

TEST_F(JournalTest, TheRemovalOfABodyOfTheFileStaysAndTakesAllElseAboutItOut) {
  apply(OperationKind::Move, "table");
  apply(OperationKind::Remove, "table");
  EXPECT_EQ(journal(), Names{"remove 'table'"});
  apply(OperationKind::Add, "table");
  apply(OperationKind::Remove, "table");
  EXPECT_EQ(journal(), Names{"remove 'table'"}) << "that of the file";
}

TEST_F(JournalTest, KeepsOfAttachmentsTheLastAndThatTheBodyWasMoved) {
  for (int i = 0; i < 3; ++i) {
    apply(OperationKind::Attach, "table", "box");
    apply(OperationKind::Detach, "table");
  }
  EXPECT_EQ(journal(), Names{"detach 'table'"});
  apply(OperationKind::Move, "table");
  apply(OperationKind::Attach, "table", "box");
  EXPECT_EQ(journal(), (Names{"move 'table'", "attach 'table'"}));
}

TEST_F(JournalTest, SwitchesOfTheSamePairsAreTheLastAndTheOneThatMadeThem) {
  for (int i = 0; i < 5; ++i) {
    apply(OperationKind::DisallowContact, "table", "box");
    apply(OperationKind::AllowContact, "table", "*");
  }
  EXPECT_EQ(journal(),
            (Names{"disallow_contact 'table'", "disallow_contact 'table'", "allow_contact 'table'"}));
  for (int i = 0; i < 3; ++i) apply(ofPairs(OperationKind::DisablePairs, "table/box"));
  apply(ofPairs(OperationKind::EnablePairs, "table/box"));
  EXPECT_EQ(journal().size(), 4U);
  EXPECT_EQ(journal().back(), "enable_pairs 'table/box'");
}

TEST_F(JournalTest, SettingsAreTheLastOfTheSameBodyOrPairs) {
  apply(OperationKind::DisallowContact, "table", "box");
  for (const double value : {0.1, 0.2, 0.3}) {
    apply(margin("table", value));
    SceneOperation warning = ofPairs(OperationKind::SetWarningDistance, "*");
    warning.warning_distance = value;
    apply(warning);
    SceneOperation effects = ofPairs(OperationKind::SetEffects, "table/*");
    effects.effects = std::to_string(value);
    effects.lay_effects = [value](const std::string&, PairSettings& settings) {
      settings.effects.interference = value > 0.15;
    };
    apply(effects);
  }
  EXPECT_EQ(journal(), (Names{"disallow_contact 'table'", "set_margin 'table'", "set_warning_distance '*'",
                              "set_effects 'table/*'"}));
  EXPECT_EQ(scene.operations[1]->margin, 0.3);
  EXPECT_EQ(scene.operations[2]->warning_distance, 0.3);
  ASSERT_TRUE(scene.operations[3]->effects_after) << "all its pairs have the same";
  EXPECT_TRUE(scene.operations[3]->effects_after->interference);
}

TEST_F(JournalTest, OfWhatIsRefusedHasNothing) {
  EXPECT_THROW(apply(OperationKind::Remove, "nobody"), Error);
  EXPECT_THROW(apply(OperationKind::Attach, "table", "table"), Error);
  EXPECT_TRUE(journal().empty());
}

TEST_F(JournalTest, AReplayAsksNoTfAndGivesTheSame) {
  const Scene before = scene;
  apply(OperationKind::Add, "cup");
  apply(OperationKind::Attach, "cup", "box");
  apply(OperationKind::Attach, "box", "hand");
  apply(detach("cup", "bench"));
  apply(OperationKind::Attach, "peg", "bench");
  apply(OperationKind::Attach, "table", "cup");
  std::vector<SceneOperation> operations;
  for (const auto& one : scene.operations) operations.push_back(*one);
  Scene replayed = before;
  EXPECT_TRUE(applyOperations(replayed, operations, {}).faults.empty());
  ASSERT_EQ(replayed.bodies.size(), scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    EXPECT_EQ(replayed.bodies[i].frame, body.frame) << body.name;
    EXPECT_EQ(replayed.bodies[i].frame_from_body.matrix(), body.frame_from_body.matrix()) << body.name;
    EXPECT_EQ(replayed.bodies[i].carrier == 0, body.carrier == 0) << body.name;
    EXPECT_EQ(replayed.bodies[i].attachment != nullptr, body.attachment != nullptr) << body.name;
  }
}

}  // namespace
}  // namespace concave_distance::journal_test
