#include "octomap_message.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>
#include <std_msgs/Header.h>

#include <array>
#include <cstdint>
#include <memory>
#include <sstream>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "message_bytes.h"

namespace concave_distance {
namespace {

constexpr double kLeastCell = 1e-6;   // m
constexpr double kLargestCell = 1e6;  // m
constexpr unsigned kTreeDepth = 16;
constexpr std::int32_t kCentreKey = 1 << (kTreeDepth - 1);
constexpr std::array<const char*, 5> kFields{"Header header", "bool binary", "string id",
                                             "float64 resolution", "int8[] data"};

struct OctomapFields {
  std_msgs::Header header;
  bool binary = false;
  std::string id;
  double resolution = 0.0;
  std::string data;
};

// The fields of a definition, without comments, constants and the types that it uses.
std::vector<std::string> fieldsOf(const std::string& definition) {
  std::vector<std::string> fields;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, 3, "===") == 0) break;
    const std::string said = line.substr(0, line.find('#'));
    std::istringstream words(said);
    std::string type;
    std::string name;
    if (said.find('=') != std::string::npos || !(words >> type >> name)) continue;
    if (type == "std_msgs/Header") type = "Header";
    fields.push_back(type.append(" ").append(name));
  }
  return fields;
}

void requireDefinition(const std::string& definition) {
  const std::vector<std::string> fields = fieldsOf(definition);
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    if (i < fields.size() && fields[i] == kFields[i]) continue;
    throw OtherType(std::string("definition of ") + kOctomapType,
                    "field " + std::to_string(i + 1) + " is " +
                        (i < fields.size() ? "'" + fields[i] + "'" : "missing") + ", not '" + kFields[i] +
                        "'",
                    "the publisher must use the definition of ROS Noetic");
  }
  if (fields.size() > kFields.size()) {
    throw OtherType(std::string("definition of ") + kOctomapType,
                    "there is a field '" + fields[kFields.size()] + "', which is not known",
                    "the publisher must use the definition of ROS Noetic");
  }
}

OctomapFields fieldsOf(const topic_tools::ShapeShifter& message) {
  MessageBytes bytes(message);
  OctomapFields fields;
  fields.header = bytes.next<std_msgs::Header>();
  fields.binary = bytes.next<std::uint8_t>() != 0;
  fields.id = bytes.next<std::string>();
  fields.resolution = bytes.next<double>();
  const std::size_t size = bytes.nextCount(1);
  fields.data.assign(reinterpret_cast<const char*>(bytes.take(size)), size);
  return fields;
}

/// Walks over the bytes of a tree as liboctomap will, which trusts them.
class TreeBytes {
 public:
  /// @param value_size bytes of a node's value; 0: a binary map, whose nodes have none
  TreeBytes(const std::string& data, std::size_t value_size) : data_(data), value_size_(value_size) {}

  void check() {
    if (data_.empty()) return;
    if (value_size_ == 0) {
      checkBinaryNode(0);
    } else {
      checkNode(0);
    }
    if (at_ == data_.size()) return;
    throw Error(
        "data",
        "the tree ends after " + std::to_string(at_) + " of " + std::to_string(data_.size()) + " bytes",
        "send it as octomap_msgs writes it");
  }

 private:
  unsigned take() {
    if (at_ < data_.size()) return static_cast<std::uint8_t>(data_[at_++]);
    throw Error("data", "the tree is cut after " + std::to_string(data_.size()) + " bytes", "send it again");
  }

  static void requireDepth(unsigned depth) {
    if (depth < kTreeDepth) return;
    throw Error("data", "a node below the smallest cells has children",
                "a tree of octomap has " + std::to_string(kTreeDepth) + " levels");
  }

  // Two bits for each child: 3 is one with children.
  void checkBinaryNode(unsigned depth) {
    requireDepth(depth);
    const unsigned low = take();
    const unsigned children = low | take() << 8U;
    for (unsigned i = 0; i < 8; ++i) {
      if ((children >> 2 * i & 3U) == 3U) checkBinaryNode(depth + 1);
    }
  }

  void checkNode(unsigned depth) {
    for (std::size_t i = 0; i < value_size_; ++i) take();
    const unsigned children = take();
    if (children == 0) return;
    requireDepth(depth);
    for (unsigned i = 0; i < 8; ++i) {
      if ((children >> i & 1U) != 0) checkNode(depth + 1);
    }
  }

  const std::string& data_;
  std::size_t value_size_;
  std::size_t at_ = 0;
};

template <typename Tree>
void readTree(const OctomapFields& fields, std::size_t value_size, std::size_t most, VoxelGrid& grid) {
  TreeBytes(fields.data, fields.binary ? 0 : value_size).check();
  Tree tree(fields.resolution);
  std::istringstream bytes(fields.data);
  if (!fields.data.empty()) {
    if (fields.binary) {
      tree.readBinaryData(bytes);
    } else {
      tree.readData(bytes);
    }
  }
  std::size_t cells = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    const unsigned level = kTreeDepth - leaf.getDepth();
    const std::int32_t edge = 1 << level;
    cells += std::size_t{1} << 3 * level;
    if (cells > most) {
      throw Error("data", "more than " + std::to_string(most) + " occupied cells",
                  "raise largest_voxel_count of the cloud, or publish a coarser map");
    }
    const octomap::OcTreeKey key = leaf.getIndexKey();
    for (std::int32_t x = 0; x < edge; ++x) {
      for (std::int32_t y = 0; y < edge; ++y) {
        for (std::int32_t z = 0; z < edge; ++z)
          grid.insert({key[0] + x - kCentreKey, key[1] + y - kCentreKey, key[2] + z - kCentreKey});
      }
    }
  }
}

}  // namespace

CloudReading readOctomap(const topic_tools::ShapeShifter& message, const CloudSettings& settings) {
  requireDefinition(message.getMessageDefinition());
  const OctomapFields fields = fieldsOf(message);
  if (!(fields.resolution >= kLeastCell && fields.resolution <= kLargestCell)) {
    TextStream seen;
    seen << "the value is " << fields.resolution;
    throw Error("resolution", seen.str(), "a cell needs a length of 1e-6 to 1e6 metres");
  }
  CloudReading reading;
  reading.frame = fields.header.frame_id;
  reading.stamp = fields.header.stamp;
  reading.map.emplace(fields.resolution);
  if (fields.id == "OcTree") {
    readTree<octomap::OcTree>(fields, sizeof(float), settings.largest_voxel_count, *reading.map);
  } else if (fields.id == "ColorOcTree") {
    readTree<octomap::ColorOcTree>(fields, sizeof(float) + 3, settings.largest_voxel_count, *reading.map);
  } else {
    throw Error("id", "the tree is a '" + fields.id + "'", "OcTree and ColorOcTree are known");
  }
  reading.points_in = reading.map->cells().size();
  return reading;
}

}  // namespace concave_distance
