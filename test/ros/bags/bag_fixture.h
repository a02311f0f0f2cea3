#pragma once

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "ros/transform_message.h"
#include "support/csv_table.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace concave_distance::test {

inline constexpr std::uint32_t kBegin = 1'700'000'000;  // s, of the bags

/// Milliseconds after the begin.
inline ros::Time atMs(int milliseconds) {
  return ros::Time(kBegin, 0) + ros::Duration(milliseconds / 1000, milliseconds % 1000 * 1'000'000);
}

/// Writes a bag of tf.
class BagWriter {
 public:
  explicit BagWriter(const std::string& path,
                     rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    bag.open(path, rosbag::bagmode::Write);
    bag.setCompression(compression);
    bag.setChunkThreshold(4096);  // several chunks
  }

  /// @param recorded zero: at the first transform's stamp
  void move(const std::vector<geometry_msgs::TransformStamped>& transforms, const std::string& topic = "/tf",
            ros::Time recorded = ros::Time()) {
    tf2_msgs::TFMessage message;
    message.transforms = transforms;
    bag.write(topic, recorded.isZero() ? transforms.front().header.stamp : recorded, message);
  }
  void stand(const geometry_msgs::TransformStamped& transform) { move({transform}, "/tf_static"); }

  rosbag::Bag bag;
};

/// Runs the program in a folder of its own, with a scene of two boxes of side 1.
class BagFixture : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("boxes.yaml",
                  "bodies:\n"
                  "  - {name: a, box: {size: [1, 1, 1]}}\n"
                  "  - {name: b, box: {size: [1, 1, 1]}}\n"
                  "pairs:\n"
                  "  - {between: [a, b]}\n");
  }

  /// a stands at 0; b moves from 2 on with 0.1 m/s, at 100 Hz. Its distance is 1 + 0.1 t.
  void writeMotion(const std::string& file, int count = 100,
                   rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    BagWriter writer(folder_.path(file), compression);
    writer.stand(transformOf("a", 0.0, atMs(0)));
    for (int i = 0; i < count; ++i) writer.move({transformOf("b", 2.0 + 0.001 * i, atMs(10 * i))});
  }

  /// Exit status; what it prints goes to the file "log".
  int run(const std::string& arguments) { return runIn(folder_, CONCAVE_DISTANCE_DISTANCE_BAG, arguments); }
  int runBoxes(const std::string& further) { return run("--scene boxes.yaml --output d.csv " + further); }
  std::string log() const { return contentOf(folder_.path("log")); }
  std::string content(const std::string& file) const { return contentOf(folder_.path(file)); }
  std::vector<Row> rows(const std::string& file = "d.csv") const { return readTable(folder_.path(file)); }
  std::vector<Row> answers() const {
    std::vector<Row> found;
    for (const Row& row : rows()) {
      if (!row.at("distance").empty()) found.push_back(row);
    }
    return found;
  }
  /// Expects that it ends with an error, nothing written, and that it says this.
  void expectFault(const std::string& arguments, const std::vector<std::string>& texts) {
    EXPECT_EQ(runBoxes(arguments), 1) << arguments;
    for (const std::string& text : texts) EXPECT_NE(log().find(text), std::string::npos) << log();
    EXPECT_FALSE(std::filesystem::exists(folder_.path("d.csv"))) << arguments;
  }

  TemporaryFolder folder_;
};

/// As the program writes it.
inline std::string textOf(ros::Time time) {
  const std::string nanoseconds = std::to_string(time.nsec);
  return std::to_string(time.sec) + "." + std::string(9 - nanoseconds.size(), '0') + nanoseconds;
}

}  // namespace concave_distance::test
