#include "cloud_message.h"

#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "message_bytes.h"
#include "octomap_message.h"

namespace concave_distance {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr std::size_t kMostPoints = 50'000'000;
constexpr std::size_t kLeastFieldSize = 13;  // bytes of a PointField without a name

/// A PointCloud2 whose data lie in the bytes of its message.
struct CloudFields {
  std_msgs::Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

PointField fieldOf(MessageBytes& bytes) {
  PointField field;
  field.name = bytes.next<std::string>();
  field.offset = bytes.next<std::uint32_t>();
  field.datatype = bytes.next<std::uint8_t>();
  field.count = bytes.next<std::uint32_t>();
  return field;
}

CloudFields fieldsOf(MessageBytes& bytes) {
  CloudFields cloud;
  cloud.header = bytes.next<std_msgs::Header>();
  cloud.height = bytes.next<std::uint32_t>();
  cloud.width = bytes.next<std::uint32_t>();
  for (std::size_t left = bytes.nextCount(kLeastFieldSize); left > 0; --left)
    cloud.fields.push_back(fieldOf(bytes));
  cloud.is_bigendian = bytes.next<std::uint8_t>() != 0;
  cloud.point_step = bytes.next<std::uint32_t>();
  cloud.row_step = bytes.next<std::uint32_t>();
  cloud.size = bytes.nextCount(1);
  cloud.data = bytes.take(cloud.size);
  bytes.next<std::uint8_t>();  // is_dense, which sensors set anyhow
  return cloud;
}

/// Where a coordinate stands in the bytes of a point.
struct Coordinate {
  std::size_t offset = 0;
  bool is_double = false;
  std::size_t size() const { return is_double ? sizeof(double) : sizeof(float); }
};

Coordinate coordinateOf(const CloudFields& cloud, const std::string& name) {
  std::string fields;
  for (const PointField& field : cloud.fields) {
    if (field.name != name) {
      fields += (fields.empty() ? "" : ", ") + field.name;
      continue;
    }
    if ((field.datatype != PointField::FLOAT32 && field.datatype != PointField::FLOAT64) || field.count > 1) {
      throw Error("fields",
                  "'" + name + "' has datatype " + std::to_string(field.datatype) + " and count " +
                      std::to_string(field.count),
                  "one FLOAT32 (7) or FLOAT64 (8) is read");
    }
    const Coordinate coordinate{field.offset, field.datatype == PointField::FLOAT64};
    if (coordinate.offset + coordinate.size() > cloud.point_step) {
      throw Error("fields",
                  "'" + name + "' ends at byte " + std::to_string(coordinate.offset + coordinate.size()) +
                      " of points of " + std::to_string(cloud.point_step) + " bytes",
                  "point_step must hold all fields");
    }
    return coordinate;
  }
  throw Error("fields", "there is no '" + name + "', only: " + (fields.empty() ? "none" : fields),
              "a cloud needs x, y and z");
}

void requireSizes(const CloudFields& cloud) {
  const std::uint64_t points = std::uint64_t{cloud.width} * cloud.height;
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  const std::uint64_t bytes = std::uint64_t{cloud.row_step} * cloud.height;
  if (points > kMostPoints) {
    throw Error("width", std::to_string(points) + " points",
                "at most " + std::to_string(kMostPoints) + " are read: thin the cloud");
  }
  if (points > 0 && (cloud.row_step < row || cloud.size < bytes)) {
    throw Error("data",
                std::to_string(cloud.size) + " bytes for " + std::to_string(cloud.height) + " rows of " +
                    std::to_string(cloud.row_step) + " bytes with " + std::to_string(cloud.width) +
                    " points of " + std::to_string(cloud.point_step),
                "row_step must hold a row, and data all rows");
  }
}

// The bytes of a number, in the order of this machine.
template <typename Number>
double numberAt(const std::uint8_t* bytes, bool is_swapped) {
  std::array<std::uint8_t, sizeof(Number)> ordered;
  for (std::size_t i = 0; i < sizeof(Number); ++i)
    ordered[i] = bytes[is_swapped ? sizeof(Number) - 1 - i : i];
  Number number;
  std::memcpy(&number, ordered.data(), sizeof(Number));
  return static_cast<double>(number);
}

bool isBigEndianHere() {
  const std::uint16_t one = 1;
  std::uint8_t first;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

CloudReading readPoints(const CloudFields& cloud, const CloudSettings& settings) {
  requireSizes(cloud);
  CloudReading reading;
  reading.frame = cloud.header.frame_id;
  reading.stamp = cloud.header.stamp;
  reading.points_in = std::size_t{cloud.width} * cloud.height;
  if (reading.points_in == 0) return reading;  // a sensor that sees nothing may name no fields
  const std::array<Coordinate, 3> axes{coordinateOf(cloud, "x"), coordinateOf(cloud, "y"),
                                       coordinateOf(cloud, "z")};
  const bool is_swapped = cloud.is_bigendian != isBigEndianHere();
  reading.points.reserve(reading.points_in);
  for (std::size_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* at = cloud.data + row * cloud.row_step;
    for (std::size_t column = 0; column < cloud.width; ++column, at += cloud.point_step) {
      Eigen::Vector3d point;
      for (int k = 0; k < 3; ++k) {
        const Coordinate& axis = axes[static_cast<std::size_t>(k)];
        point[k] = axis.is_double ? numberAt<double>(at + axis.offset, is_swapped)
                                  : numberAt<float>(at + axis.offset, is_swapped);
      }
      // NaN stands for a direction in which nothing was seen.
      if (point.allFinite() && point.norm() <= settings.range) reading.points.push_back(point);
    }
  }
  return reading;
}

}  // namespace

CloudReading readCloud(const topic_tools::ShapeShifter& message, const CloudSettings& settings) {
  const std::string& type = message.getDataType();
  CloudReading reading;
  if (type == ros::message_traits::datatype<PointCloud2>()) {
    const std::string md5sum = ros::message_traits::md5sum<PointCloud2>();
    if (message.getMD5Sum() != md5sum) {
      throw OtherType(type, "its definition has md5sum " + message.getMD5Sum() + ", not " + md5sum,
                      "the publisher must use the definition of this distribution");
    }
    MessageBytes bytes(message);
    reading = readPoints(fieldsOf(bytes), settings);
  } else if (type == kOctomapType) {
    reading = readOctomap(message, settings);
  } else {
    throw OtherType("topic '" + settings.topic + "'", "its type is '" + type + "'",
                    std::string("sensor_msgs/PointCloud2 and ") + kOctomapType + " are known");
  }
  reading.frame = requireFrameName(reading.frame, "header.frame_id");
  return reading;
}

}  // namespace concave_distance
