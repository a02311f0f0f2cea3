// Clouds and maps are read as they were written, or refused.
#include "ros/clouds/cloud_message.h"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include "base/random_engine.h"
#include "concave_distance/base/error.h"
#include "received_message.h"
#include "support/case_seed.h"

namespace concave_distance::cloud_message_test {
namespace {

using Eigen::Vector3d;
using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;
using test::asReceived;
using test::OctomapMessage;

CloudSettings settings() {
  CloudSettings result;
  result.topic = "points";
  result.voxel_size = 0.1;
  return result;
}

PointField field(const std::string& name, std::uint32_t offset, std::uint8_t type) {
  PointField result;
  result.name = name;
  result.offset = offset;
  result.datatype = type;
  result.count = 1;
  return result;
}

/// Rows of points with 4 bytes before each and 8 after each row.
template <typename Number>
PointCloud2 cloudOf(const std::vector<Vector3d>& points, std::uint32_t width, bool big_endian = false) {
  PointCloud2 cloud;
  cloud.header.frame_id = "camera";
  cloud.header.stamp = ros::Time(12, 34);
  cloud.width = width;
  cloud.height = static_cast<std::uint32_t>(points.size()) / width;
  cloud.is_bigendian = static_cast<std::uint8_t>(big_endian);
  constexpr auto kSize = static_cast<std::uint32_t>(sizeof(Number));
  cloud.point_step = 4 + 3 * kSize;
  cloud.row_step = width * cloud.point_step + 8;
  const std::uint8_t type = sizeof(Number) == 4 ? PointField::FLOAT32 : PointField::FLOAT64;
  const char* names[] = {"x", "y", "z"};
  cloud.fields.push_back(field("intensity", 0, PointField::FLOAT32));
  for (std::uint32_t k = 0; k < 3; ++k) cloud.fields.push_back(field(names[k], 4 + k * kSize, type));
  cloud.data.assign(std::size_t{cloud.row_step} * cloud.height, 0xff);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Number value = static_cast<Number>(points[i][k]);
      std::uint8_t* at = cloud.data.data() + i / width * cloud.row_step + i % width * cloud.point_step + 4 +
                         static_cast<std::size_t>(k) * sizeof(Number);
      std::memcpy(at, &value, sizeof(Number));
      if (big_endian) std::reverse(at, at + sizeof(Number));
    }
  }
  return cloud;
}

topic_tools::ShapeShifter received(const PointCloud2& cloud) {
  using Traits = ros::message_traits::Definition<PointCloud2>;
  return asReceived("sensor_msgs/PointCloud2", ros::message_traits::md5sum(cloud), Traits::value(), cloud);
}

std::string refusal(const topic_tools::ShapeShifter& message, const CloudSettings& with = settings()) {
  try {
    readCloud(message, with);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CloudMessage, PointsOfFloatsAndDoublesOfEitherByteOrderAreRead) {
  const std::vector<Vector3d> points{{1, 2, 3},  {-0.5, 0.25, 8}, {0, 0, 0},
                                     {4, -5, 6}, {7, 8, 9},       {0.125, 0, 1}};
  for (const PointCloud2& cloud : {cloudOf<float>(points, 3), cloudOf<double>(points, 2),
                                   cloudOf<float>(points, 6, true), cloudOf<double>(points, 1, true)}) {
    const CloudReading reading = readCloud(received(cloud), settings());
    EXPECT_EQ(reading.frame, "camera");
    EXPECT_EQ(reading.stamp, ros::Time(12, 34));
    EXPECT_EQ(reading.points_in, points.size());
    EXPECT_EQ(reading.points, points);
    EXPECT_FALSE(reading.map);
  }
}

TEST(CloudMessage, PointsThatAreNotFiniteOrBeyondTheRangeAreLeftOut) {
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  CloudSettings near = settings();
  near.range = 2.0;
  const PointCloud2 cloud = cloudOf<float>(
      {{1, 0, 0}, {nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}, {0, 2, 0}, {0, 0, 2.1}}, 6);
  EXPECT_EQ(readCloud(received(cloud), near).points, (std::vector<Vector3d>{{1, 0, 0}, {0, 2, 0}}));
}

TEST(CloudMessage, ACloudWithoutPointsIsRead) {
  PointCloud2 cloud;
  cloud.header.frame_id = "/camera";
  const CloudReading reading = readCloud(received(cloud), settings());
  EXPECT_EQ(reading.frame, "camera");
  EXPECT_TRUE(reading.points.empty());
}

TEST(CloudMessage, MalformedCloudsAreRefusedWithTheirReason) {
  const PointCloud2 good = cloudOf<float>({{1, 2, 3}, {4, 5, 6}}, 2);
  ASSERT_EQ(refusal(received(good)), "");
  const auto expect = [&](const char* text, const auto& spoil) {
    PointCloud2 cloud = good;
    spoil(cloud);
    const std::string said = refusal(received(cloud));
    EXPECT_NE(said.find(text), std::string::npos) << text << ": " << said;
  };
  expect("there is no 'y'", [](PointCloud2& c) { c.fields.erase(c.fields.begin() + 2); });
  expect("only: none", [](PointCloud2& c) { c.fields.clear(); });
  expect("datatype 2", [](PointCloud2& c) { c.fields[3].datatype = PointField::UINT8; });
  expect("count 3", [](PointCloud2& c) { c.fields[1].count = 3; });
  expect("ends at byte", [](PointCloud2& c) { c.fields[1].offset = 14; });
  expect("ends at byte", [](PointCloud2& c) { c.fields[1].offset = 0xffffffffU; });
  expect("bytes for", [](PointCloud2& c) { c.data.resize(10); });
  expect("bytes for", [](PointCloud2& c) { c.data.clear(); });
  expect("bytes for", [](PointCloud2& c) { c.row_step = 8; });
  expect("bytes for", [](PointCloud2& c) { c.height = 1000; });
  expect("points", [](PointCloud2& c) { c.width = c.height = 0xffffffffU; });
  expect("frame_id", [](PointCloud2& c) { c.header.frame_id = ""; });
}

/// A message of which the bytes at `place` are another count.
template <typename Message>
topic_tools::ShapeShifter withCount(const Message& message, std::size_t place, std::uint32_t count) {
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream out(bytes.data(), message.size());
  message.write(out);
  std::memcpy(bytes.data() + place, &count, sizeof count);
  topic_tools::ShapeShifter other;
  other.morph(message.getMD5Sum(), message.getDataType(), message.getMessageDefinition(), "0");
  ros::serialization::IStream in(bytes.data(), message.size());
  other.read(in);
  return other;
}

// A count reserves no memory for which there are no bytes.
TEST(CloudMessage, CountsWithoutBytesAreRefused) {
  const PointCloud2 cloud = cloudOf<float>({{1, 2, 3}}, 1);
  const topic_tools::ShapeShifter good = received(cloud);
  const std::size_t fields = 4 + 8 + 4 + cloud.header.frame_id.size() + 8;
  const std::size_t data = good.size() - 1 - cloud.data.size() - 4;
  OctomapMessage map;
  map.header.frame_id = "map";
  map.data = {1, 0};
  const topic_tools::ShapeShifter good_map = asReceived(map);
  ASSERT_EQ(refusal(withCount(good, fields, 4)) + refusal(withCount(good, data, 24)) +
                refusal(withCount(good_map, good_map.size() - 6, 2)),
            "");
  for (const std::uint32_t count : {26U, 60'000'000U, 0xffffffffU}) {
    const std::string text = "an array of " + std::to_string(count) + " has ";
    for (const std::string& said :
         {refusal(withCount(good, fields, count)), refusal(withCount(good, data, count)),
          refusal(withCount(good_map, good_map.size() - 6, count))}) {
      EXPECT_NE(said.find(text), std::string::npos) << count << ": " << said;
    }
  }
}

TEST(CloudMessage, OtherTypesAndDefinitionsAreRefused) {
  std_msgs::Header header;
  header.frame_id = "camera";
  const std::string said = refusal(asReceived("std_msgs/Header", ros::message_traits::md5sum(header),
                                              ros::message_traits::definition(header), header));
  EXPECT_NE(said.find("its type is 'std_msgs/Header'"), std::string::npos) << said;
  // A cloud with another definition than this distribution's.
  const std::string other = refusal(
      asReceived("sensor_msgs/PointCloud2", "0123456789abcdef0123456789abcdef", "Header header\n", header));
  EXPECT_NE(other.find("definition"), std::string::npos) << other;
  OctomapMessage map;
  map.header = header;
  const auto without = [&](const std::string& line, const std::string& instead) {
    std::string text = test::kOctomapDefinition;
    text.replace(text.find(line), line.size(), instead);
    return refusal(asReceived(map, text));
  };
  EXPECT_EQ(refusal(asReceived(map)), "");
  EXPECT_NE(without("string id\n", "").find("'float64 resolution', not 'string id'"), std::string::npos);
  EXPECT_NE(without("int8[] data\n", "").find("field 5 is missing"), std::string::npos);
  EXPECT_NE(without("int8[] data\n", "uint8[] data\n").find("'uint8[] data'"), std::string::npos);
  EXPECT_NE(without("int8[] data\n", "int8[] data\nint32 more\n").find("'int32 more'"), std::string::npos);
  EXPECT_EQ(without("Header header\n", "std_msgs/Header header\nint32 KIND = 3\n"), "");
}

template <typename Tree>
OctomapMessage messageOf(Tree& tree, bool binary) {
  std::ostringstream bytes;
  if (binary) {
    tree.writeBinaryData(bytes);
  } else {
    tree.writeData(bytes);
  }
  const std::string text = bytes.str();
  OctomapMessage message;
  message.header.frame_id = "map";
  message.header.stamp = ros::Time(5, 6);
  message.binary = static_cast<std::uint8_t>(binary);
  message.id = tree.getTreeType();
  message.resolution = tree.getResolution();
  message.data.assign(text.begin(), text.end());
  return message;
}

/// A block that is pruned to large leaves, and cells here and there, some of them free.
template <typename Tree>
void fill(Tree& tree, RandomEngine& engine) {
  std::uniform_int_distribution<int> index(-40, 40);
  const double h = tree.getResolution();
  const auto set = [&](int x, int y, int z, bool occupied) {
    tree.updateNode(octomap::point3d(static_cast<float>(h * (x + 0.5)), static_cast<float>(h * (y + 0.5)),
                                     static_cast<float>(h * (z + 0.5))),
                    occupied);
  };
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = -8; z < 0; ++z) set(x, y, z, true);
    }
  }
  for (int i = 0; i < 300; ++i) set(index(engine), index(engine), index(engine), i % 3 != 0);
  tree.updateInnerOccupancy();
}

template <typename Tree>
void expectCellsOf(Tree& tree, bool binary) {
  const CloudReading reading = readCloud(asReceived(messageOf(tree, binary)), settings());
  ASSERT_TRUE(reading.map);
  EXPECT_EQ(reading.frame, "map");
  EXPECT_EQ(reading.stamp, ros::Time(5, 6));
  EXPECT_EQ(reading.map->size(), tree.getResolution());
  std::size_t occupied = 0;
  for (int x = -45; x < 45; ++x) {
    for (int y = -45; y < 45; ++y) {
      for (int z = -45; z < 45; ++z) {
        const octomap::OcTreeKey key(static_cast<octomap::key_type>(32768 + x),
                                     static_cast<octomap::key_type>(32768 + y),
                                     static_cast<octomap::key_type>(32768 + z));
        const auto* node = tree.search(key);
        const bool is_occupied = node != nullptr && tree.isNodeOccupied(node);
        occupied += is_occupied ? 1U : 0U;
        ASSERT_EQ(reading.map->contains({x, y, z}), is_occupied) << x << " " << y << " " << z;
      }
    }
  }
  EXPECT_EQ(reading.map->cells().size(), occupied);
  EXPECT_GT(occupied, 600U);
}

TEST(CloudMessage, MapsHaveTheCellsThatLiboctomapFinds) {
  RandomEngine engine(test::caseSeed(31));
  octomap::OcTree tree(0.05);
  fill(tree, engine);
  expectCellsOf(tree, false);
  expectCellsOf(tree, true);
  octomap::ColorOcTree coloured(0.25);
  fill(coloured, engine);
  expectCellsOf(coloured, false);
}

TEST(CloudMessage, AMapWithoutNodesIsEmpty) {
  OctomapMessage message;
  message.header.frame_id = "map";
  EXPECT_TRUE(readCloud(asReceived(message), settings()).map->cells().empty());
}

TEST(CloudMessage, WrongMapsAreRefusedWithTheirReason) {
  octomap::OcTree tree(0.05);
  RandomEngine engine(32);
  fill(tree, engine);
  for (const bool binary : {false, true}) {
    const OctomapMessage good = messageOf(tree, binary);
    ASSERT_EQ(refusal(asReceived(good)), "");
    const auto expect = [&](const char* text, const auto& spoil) {
      OctomapMessage message = good;
      spoil(message);
      const std::string said = refusal(asReceived(message));
      EXPECT_NE(said.find(text), std::string::npos) << text << ": " << said;
    };
    for (const double resolution :
         {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e-7, 5e-324, 1e7, 1e300})
      expect("resolution", [&](OctomapMessage& m) { m.resolution = resolution; });
    expect("'CountingOcTree'", [](OctomapMessage& m) { m.id = "CountingOcTree"; });
    expect("cut after", [](OctomapMessage& m) { m.data.pop_back(); });
    expect("cut after", [](OctomapMessage& m) { m.data.resize(m.data.size() / 2); });
    expect("the tree ends", [](OctomapMessage& m) { m.data.push_back(0); });
    expect("frame_id", [](OctomapMessage& m) { m.header.frame_id = ""; });
    // Deeper than any tree: each node has children.
    expect("below the smallest cells", [](OctomapMessage& m) { m.data.assign(100000, std::int8_t{-1}); });
    CloudSettings few = settings();
    few.largest_voxel_count = 100;
    EXPECT_NE(refusal(asReceived(good), few).find("more than 100"), std::string::npos);
  }
  // One leaf that covers everything: 2^48 cells.
  OctomapMessage root;
  root.header.frame_id = "map";
  root.binary = 0;
  root.data = {0, 0, 0x40, 0x40, 0};  // log odds 3, no children
  EXPECT_NE(refusal(asReceived(root)).find("occupied cells"), std::string::npos);
}

// Whatever the bytes are, they are read or refused.
TEST(CloudMessage, RandomBytesOfMapsEndNothing) {
  RandomEngine engine(test::caseSeed(33));
  std::uniform_int_distribution<int> byte(-128, 127);
  std::size_t refused = 0;
  for (int i = 0; i < 2000; ++i) {
    OctomapMessage message;
    message.header.frame_id = "map";
    message.binary = static_cast<std::uint8_t>(i % 2);
    message.data.resize(static_cast<std::size_t>(i) % 67);
    for (std::int8_t& value : message.data) value = static_cast<std::int8_t>(byte(engine));
    refused += refusal(asReceived(message)).empty() ? 0U : 1U;
  }
  EXPECT_GT(refused, 1500U);
}

}  // namespace
}  // namespace concave_distance::cloud_message_test
