#pragma once

#include <ros/serialization.h>
#include <std_msgs/Header.h>
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace concave_distance::test {

/// The fields of octomap_msgs/Octomap, which need not be installed.
struct OctomapMessage {
  std_msgs::Header header;
  std::uint8_t binary = 1;
  std::string id = "OcTree";
  double resolution = 0.1;
  std::vector<std::int8_t> data;
};

inline const std::string kOctomapDefinition =
    "# A 3D map\nHeader header\n\nbool binary  # or full\nstring id\nfloat64 resolution\nint8[] data\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";

/// A message as it comes from a publisher of another machine.
template <typename Message>
topic_tools::ShapeShifter asReceived(const std::string& type, const std::string& md5,
                                     const std::string& definition, const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  topic_tools::ShapeShifter shape;
  shape.morph(md5, type, definition, "0");
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  shape.read(in);
  return shape;
}

inline topic_tools::ShapeShifter asReceived(const OctomapMessage& message,
                                            const std::string& definition = kOctomapDefinition) {
  return asReceived("octomap_msgs/Octomap", "9a45536b45c5e409cd49f04bb2d9999f", definition, message);
}

}  // namespace concave_distance::test

namespace ros::serialization {

template <>
struct Serializer<concave_distance::test::OctomapMessage> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.binary);
    stream.next(message.id);
    stream.next(message.resolution);
    stream.next(message.data);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace ros::serialization
