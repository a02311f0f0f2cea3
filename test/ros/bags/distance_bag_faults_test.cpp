#include <std_msgs/String.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "ros/bags/bag_fixture.h"

namespace concave_distance::distance_bag_faults_test {

/// Bytes that are said to be a TFMessage.
struct RawMessage {
  std::string bytes;
};

}  // namespace concave_distance::distance_bag_faults_test

namespace ros {

using concave_distance::distance_bag_faults_test::RawMessage;

namespace message_traits {
template <>
struct MD5Sum<RawMessage> : MD5Sum<tf2_msgs::TFMessage> {
  static const char* value(const RawMessage&) { return MD5Sum<tf2_msgs::TFMessage>::value(); }
};
template <>
struct DataType<RawMessage> : DataType<tf2_msgs::TFMessage> {
  static const char* value(const RawMessage&) { return DataType<tf2_msgs::TFMessage>::value(); }
};
template <>
struct Definition<RawMessage> : Definition<tf2_msgs::TFMessage> {
  static const char* value(const RawMessage&) { return Definition<tf2_msgs::TFMessage>::value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<RawMessage> {
  template <typename Stream>
  static void write(Stream& stream, const RawMessage& message) {
    std::memcpy(stream.advance(static_cast<std::uint32_t>(message.bytes.size())), message.bytes.data(),
                message.bytes.size());
  }
  static std::uint32_t serializedLength(const RawMessage& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};
}  // namespace serialization
}  // namespace ros

namespace concave_distance::distance_bag_faults_test {
namespace {

using test::atMs;
using test::BagFixture;
using test::BagWriter;
using test::number;
using test::transformOf;

class DistanceBagFaults : public BagFixture {
 protected:
  bool says(const std::string& text) const { return log().find(text) != std::string::npos; }

  /// The bag's first record, in which index_pos and the encryptor stand.
  struct Head {
    std::size_t begin;  ///< of its fields, behind their length
    std::uint32_t length;
  };
  static Head headOf(const std::string& bag) {
    Head head{bag.find('\n') + 1 + 4, 0};
    std::memcpy(&head.length, bag.data() + head.begin - 4, 4);
    return head;
  }
};

TEST_F(DistanceBagFaults, NamesABagThatIsNone) {
  expectFault("--bag none.bag", {"none.bag: there is no such bag"});
  std::filesystem::create_directory(folder_.path("folder.bag"));
  expectFault("--bag folder.bag", {"folder.bag: it is no file"});
  folder_.write("text.bag", "SQLite format 3 and more");
  expectFault("--bag text.bag", {"text.bag: it is no bag of ROS 1"});
  folder_.write("empty.bag", "");
  expectFault("--bag empty.bag", {"empty.bag: it is no bag of ROS 1"});
}

TEST_F(DistanceBagFaults, AsksToReindexABagThatIsCutOff) {
  writeMotion("run.bag");
  const std::string whole = content("run.bag");
  for (const double share : {0.3, 0.6, 0.95, 0.999}) {
    folder_.write("cut.bag",
                  whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    expectFault("--bag cut.bag", {"cut.bag: it is cut off or damaged", "rosbag reindex cut.bag"});
  }
  folder_.write("cut.bag", whole.substr(0, 100));
  expectFault("--bag cut.bag", {"cut.bag: it is cut off or damaged"});
}

TEST_F(DistanceBagFaults, AsksToReindexARecordingThatWasNotEnded) {
  writeMotion("run.bag");
  std::string bag = content("run.bag");
  const std::size_t field = bag.find("index_pos=") + 10;
  bag.replace(field, 8, std::string(8, '\0'));
  folder_.write("open.bag", bag);
  expectFault("--bag open.bag",
              {"open.bag: it has no index: its recording was not ended", "rosbag reindex open.bag"});
}

TEST_F(DistanceBagFaults, SaysThatABagIsEncrypted) {
  writeMotion("run.bag");
  for (const std::string plugin : {"rosbag/AesCbcEncryptor", "rosbag/Unheard"}) {
    std::string bag = content("run.bag");
    const Head head = headOf(bag);
    const std::string field = "encryptor=" + plugin;
    std::uint32_t field_length = static_cast<std::uint32_t>(field.size());
    std::string added(4, '\0');
    std::memcpy(added.data(), &field_length, 4);
    added += field;
    // The padding behind the fields is shorter by as much.
    const std::uint32_t length = head.length + static_cast<std::uint32_t>(added.size());
    std::uint32_t padding = 0;
    std::memcpy(&padding, bag.data() + head.begin + head.length, 4);
    padding -= static_cast<std::uint32_t>(added.size());
    std::memcpy(bag.data() + head.begin - 4, &length, 4);
    std::memcpy(bag.data() + head.begin + head.length, &padding, 4);
    bag.insert(head.begin + head.length, added);
    bag.erase(head.begin + length + 4 + padding, added.size());
    folder_.write("secret.bag", bag);
    expectFault("--bag secret.bag",
                {"secret.bag: it is encrypted by " + plugin + " and cannot be opened", "gpg"});
  }
}

TEST_F(DistanceBagFaults, SaysWhereABagIsDamaged) {
  writeMotion("run.bag", 200, rosbag::compression::BZ2);
  std::string bag = content("run.bag");
  const std::size_t middle = bag.find("BZh", bag.size() / 3);
  ASSERT_NE(middle, std::string::npos);
  bag.replace(middle + 20, 40, std::string(40, '\x55'));
  folder_.write("bad.bag", bag);
  expectFault("--bag bad.bag", {"bad.bag: it is damaged", "s after the begin", "nothing was written"});
}

// rosbag's library follows every place that an index names.
TEST_F(DistanceBagFaults, SaysThatABagHasEndedTheProcessThatReadsIt) {
  writeMotion("run.bag");
  std::string bag = content("run.bag");
  constexpr std::size_t kToPlace = 4 + (4 + 8) + 4 + 8;  // op, the version, a length, a time
  std::size_t count = 0;
  for (std::size_t at = bag.find("op=\x04"); at != std::string::npos; at = bag.find("op=\x04", at + 1)) {
    bag.replace(at + kToPlace, 4, "\xff\xff\xff\x7f");
    ++count;
  }
  ASSERT_GT(count, 2U);
  folder_.write("bad.bag", bag);
  expectFault("--bag bad.bag", {"bad.bag: it is", "has ended the process that reads it", "rosbag reindex"});
}

// Messages that rosbag's library leaves out may not be missing in silence.
TEST_F(DistanceBagFaults, RefusesABagWhoseMessagesHaveNoTime) {
  writeMotion("run.bag");
  std::string bag = content("run.bag");
  const std::size_t index = bag.rfind("op=\x04");
  ASSERT_NE(index, std::string::npos);
  bag.replace(index + 4 + (4 + 8) + 4, 8, std::string(8, '\0'));
  folder_.write("bad.bag", bag);
  expectFault("--bag bad.bag", {"bad.bag: it is cut off or damaged", "invalid time", "rosbag reindex"});
}

TEST_F(DistanceBagFaults, NamesTopicsThatThereAreInstead) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.move({transformOf("b", 2.0, atMs(0))}, "/cell/tf");
    writer.bag.write("/chatter", atMs(0), std_msgs::String());
  }
  expectFault("--bag run.bag", {"run.bag: there is no message on /tf or /tf_static", "/cell/tf"});
  expectFault("--bag run.bag --tf-topic /robot/tf", {"there is no message on /robot/tf", "/cell/tf"});
  expectFault(
      "--bag run.bag --tf-topic /chatter",
      {"its topic /chatter has the type std_msgs/String, which is not tf2_msgs/TFMessage", "/cell/tf"});
  { const BagWriter empty(folder_.path("empty.bag")); }
  expectFault("--bag empty.bag", {"there is no message on /tf or /tf_static", "TFMessage: none"});
}

TEST_F(DistanceBagFaults, RefusesATopicOfAnotherTypeThatIsCalledTf) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.bag.write("/tf", atMs(0), std_msgs::String());
    writer.stand(transformOf("a", 0.0, atMs(0)));
  }
  expectFault("--bag run.bag", {"its topic /tf has the type std_msgs/String"});
}

TEST_F(DistanceBagFaults, LeavesOutMessagesThatAreNone) {
  RawMessage cut;
  {
    tf2_msgs::TFMessage message;
    message.transforms = {transformOf("b", 2.0, atMs(0))};
    cut.bytes.resize(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(cut.bytes.data()),
                                       static_cast<std::uint32_t>(cut.bytes.size()));
    ros::serialization::serialize(stream, message);
    cut.bytes.resize(cut.bytes.size() - 9);
  }
  const std::string many = std::string("\xff\xff\xff\x7f", 4) + std::string(60, '\0');
  for (const std::string& bytes : {cut.bytes, many, std::string("\1\0", 2)}) {
    {
      BagWriter writer(folder_.path("run.bag"));
      writer.stand(transformOf("a", 0.0, atMs(0)));
      for (int i = 0; i < 10; ++i) {
        writer.move({transformOf("b", 2.0, atMs(10 * i))});
        if (i == 5) writer.bag.write("/tf", atMs(55), RawMessage{bytes});
      }
    }
    ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
    EXPECT_TRUE(says("is none of tf: ")) << log();
    EXPECT_EQ(answers().size(), 10U);
  }
}

TEST_F(DistanceBagFaults, LeavesOutTransformsThatTheNodeRefusesAndSaysWhy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.stand(transformOf("a", 0.0, atMs(0)));
    for (int i = 0; i < 100; ++i) {
      writer.move({transformOf("b", 2.0 + 0.001 * i, atMs(10 * i))});
      const ros::Time stamp = atMs(10 * i + 3);
      if (i == 10) writer.move({transformOf("b", nan, stamp)});
      if (i == 20) {
        writer.move({transformOf("c", 1.0, stamp)});
        geometry_msgs::TransformStamped turned = transformOf("d", 1.0, stamp);
        turned.transform.rotation.w = 2.0;
        writer.move({turned});
      }
      if (i == 30) writer.move({transformOf("world", 1.0, stamp, "b")});
      if (i == 40) writer.move({transformOf("e", 1.0, ros::Time())}, "/tf", stamp);
      if (i == 50) writer.move({transformOf("c", 1.0, atMs(0) - ros::Duration(60))}, "/tf", stamp);
      if (i == 60) writer.move({transformOf("f", 1.0, atMs(0) + ros::Duration(60))}, "/tf", stamp);
      if (i == 70) writer.move({transformOf("g", 1.0, stamp, "g")});
      if (i == 80) writer.move({transformOf("", 1.0, stamp)});
      if (i == 90) writer.move({transformOf("a", 1.0, stamp)});
    }
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  for (const std::string text :
       {"its translation is (nan, 0, 0) m", "the norm of its quaternion is 2", "a loop", "its stamp is zero",
        "older than the newest one", "ahead of the clock", "--tf-future-tolerance",
        "the frame is its own parent", "child_frame_id is not a valid frame name",
        "published on both /tf and /tf_static"}) {
    EXPECT_TRUE(says(text)) << text << "\n" << log();
  }
  const std::vector<test::Row> found = answers();
  ASSERT_EQ(found.size(), 100U) << "what is right is answered";
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(number(found[i], "distance"), 1.0 + 0.001 * static_cast<double>(i), 1e-12);
  }
}

TEST_F(DistanceBagFaults, AnswersStampsThatGoBackAndSameOnesOnce) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.stand(transformOf("a", 0.0, atMs(0)));
    for (int i = 0; i < 300; ++i) writer.move({transformOf("b", 2.0, atMs(10 * i))});
    writer.move({transformOf("b", 4.0, atMs(10))}, "/tf", atMs(3000));  // it is known already
    writer.move({transformOf("b", 4.0, atMs(15))}, "/tf", atMs(3001));
    writer.move({transformOf("b", 4.0, atMs(15))}, "/tf", atMs(3002));
  }
  ASSERT_EQ(runBoxes("--bag run.bag"), 0) << log();
  std::size_t late = 0;
  for (const test::Row& row : answers()) {
    if (number(row, "distance") == 1.0) continue;
    EXPECT_EQ(row.at("stamp"), test::textOf(atMs(15)));
    EXPECT_EQ(row.at("time"), test::textOf(atMs(3001)));
    ++late;
  }
  EXPECT_EQ(late, 1U);
  EXPECT_EQ(answers().size(), 301U);
}

TEST_F(DistanceBagFaults, NamesFramesThatNeverAppear) {
  {
    BagWriter writer(folder_.path("run.bag"));
    writer.stand(transformOf("a", 0.0, atMs(0)));
    writer.move({transformOf("arm", 2.0, atMs(10))});
  }
  expectFault("--bag run.bag", {"no pair has an answer", "1 frame of bodies is not on tf: 'b'",
                                "record /tf_static too", "the bag's frames: a, arm, "});
  writeMotion("run.bag", 10);
  expectFault("--bag run.bag --reference-frame map", {"no pair has an answer", "the reference frame 'map'"});
  folder_.write("three.yaml",
                test::replaced(content("boxes.yaml"), "pairs:\n",
                               "  - {name: c, box: {size: [1, 1, 1]}}\npairs:\n  - {between: [a, c]}\n"));
  ASSERT_EQ(run("--scene three.yaml --bag run.bag --output d.csv"), 0) << log();
  EXPECT_TRUE(says("no answer of pair a/c: ")) << log();
  EXPECT_TRUE(says("1 frame of bodies is not on tf: 'c'")) << log();
  EXPECT_EQ(answers().size(), 10U);
  EXPECT_EQ(rows().size(), 11U) << "one says that c is missing";
  EXPECT_NE(content("d.csv").find(",\"\"\"c\"\" passed to lookupTransform"), std::string::npos)
      << "tf's message is quoted as CSV has it: " << content("d.csv").substr(0, 1000);
}

TEST_F(DistanceBagFaults, RefusesTimesOutsideOfTheBag) {
  writeMotion("run.bag", 10);
  expectFault("--bag run.bag --start 5", {"--start: it is 5 s, behind the end", "last 0.09 s"});
  expectFault("--bag run.bag --start -1", {"--start: it is -1 s"});
  expectFault("--bag run.bag --start nan", {"--start: it is nan s"});
  expectFault("--bag run.bag --duration 0", {"--duration: it is 0 s"});
}

TEST_F(DistanceBagFaults, WritesNothingOrSaysThatItCouldNot) {
  writeMotion("run.bag");
  EXPECT_EQ(run("--scene boxes.yaml --bag run.bag --output none/d.csv"), 1);
  EXPECT_TRUE(says("none/d.csv: the file cannot be written")) << log();
  EXPECT_EQ(run("--scene boxes.yaml --bag run.bag --output run.bag"), 1);
  EXPECT_TRUE(says("--output is the same file as --bag")) << log();
  EXPECT_EQ(run("--scene boxes.yaml --bag run.bag --output d.csv --niches-output d.csv"), 1);
  EXPECT_TRUE(says("--niches-output is the same file as --output")) << log();
  EXPECT_EQ(run("--scene boxes.yaml --bag run.bag --output /dev/full"), 1);
  EXPECT_TRUE(says("/dev/full: not everything could be written (check the space on the device)")) << log();
  EXPECT_EQ(run("--scene boxes.yaml --bag run.bag --output d.csv --niches-output /dev/full"), 1);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("d.csv"))) << "not one of two";
}

TEST_F(DistanceBagFaults, AsksForASceneAndItsDescriptions) {
  writeMotion("run.bag", 10);
  EXPECT_EQ(run("--bag run.bag --output d.csv"), 1);
  EXPECT_TRUE(says("there is no scene file and no --robot-description")) << log();
  folder_.write("robot.yaml", "robots:\n  - description: robot_description\n");
  EXPECT_EQ(run("--scene robot.yaml --bag run.bag --output d.csv"), 1);
  EXPECT_TRUE(says(
      "it takes a robot from the parameter 'robot_description' (give its URDF: --robot-description FILE)"))
      << log();
  EXPECT_EQ(run("--scene robot.yaml --description robot_description --bag run.bag --output d.csv"), 1);
  EXPECT_TRUE(says("--description: it is 'robot_description'")) << log();
  EXPECT_EQ(run("--scene none.yaml --bag run.bag --output d.csv"), 1);
  EXPECT_TRUE(says("none.yaml")) << log();
}

}  // namespace
}  // namespace concave_distance::distance_bag_faults_test
