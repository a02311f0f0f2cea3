#pragma once

#include <ros/serialization.h>
#include <topic_tools/shape_shifter.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"

namespace concave_distance {

/// Reads the bytes of a message field by field. A count is believed as far as there are bytes for it: what
/// ros::serialization makes of one reserves memory first.
class MessageBytes {
 public:
  explicit MessageBytes(const topic_tools::ShapeShifter& message)
      : type_(message.getDataType()), bytes_(message.size()), in_(bytes_.data(), message.size()) {
    ros::serialization::OStream out(bytes_.data(), message.size());
    message.write(out);
  }
  MessageBytes(const MessageBytes&) = delete;
  MessageBytes& operator=(const MessageBytes&) = delete;

  /// Returns the next field, which is no array. @throws Error where the bytes end before it does
  template <typename Field>
  Field next() {
    if (in_.getLength() < ros::serialization::Serializer<Field>::serializedLength(Field())) fail("");
    Field field;
    try {
      in_.next(field);
    } catch (const ros::Exception& problem) {
      fail(std::string(": ") + problem.what());
    }
    return field;
  }

  /// Returns the count of an array. @param least_size bytes of an element. @throws Error where there are
  /// fewer
  std::size_t nextCount(std::size_t least_size) {
    const auto count = next<std::uint32_t>();
    if (count <= in_.getLength() / least_size) return count;
    fail(": an array of " + std::to_string(count) + " has " + std::to_string(in_.getLength()) + " bytes");
  }

  /// Returns the next bytes, of which as many are there; they live as long as this object.
  const std::uint8_t* take(std::size_t count) { return in_.advance(static_cast<std::uint32_t>(count)); }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(type_, "the message is cut after " + std::to_string(bytes_.size()) + " bytes" + why,
                "send it again");
  }

  std::string type_;
  std::vector<std::uint8_t> bytes_;
  ros::serialization::IStream in_;
};

}  // namespace concave_distance
