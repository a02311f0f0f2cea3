#pragma once

#include <ros/time.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bag_transforms.h"

namespace concave_distance {

/// One message of tf as it lies in a bag.
struct BagRecord {
  ros::Time time;  ///< as of BagMessage
  bool fixed = false;
  std::string sender;
  std::vector<std::uint8_t> bytes;
};

/// Reads the messages of tf from bags by rosbag's library. That library trusts what stands in a bag: a
/// damaged one may end the process.
class BagReader {
 public:
  /// @throws Error as BagTransforms
  explicit BagReader(const BagSelection& selection);
  ~BagReader();
  BagReader(const BagReader&) = delete;
  BagReader& operator=(const BagReader&) = delete;

  /// Returns false at the end. @throws Error when the bag is damaged there
  bool next(BagRecord& record);

  ros::Time begin() const;  ///< of what is played
  ros::Time end() const;

 private:
  struct Bags;
  std::unique_ptr<Bags> bags_;
};

inline constexpr const char* kReindex = "rosbag reindex keeps what is whole; nothing was written";

/// Begins the message about a bag that is damaged so many seconds after the begin of what is played.
std::string damagedAt(double seconds);

}  // namespace concave_distance
