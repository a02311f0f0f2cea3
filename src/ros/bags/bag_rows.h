#pragma once

#include <concave_distance/PairNiches.h>
#include <ros/time.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Decides which pairs have rows, and which of their answers is one: a pair without a distance, or that
/// stands still, has a row when that begins and no more.
class BagRows {
 public:
  /// @param patterns of the pairs that are followed; empty: all
  explicit BagRows(std::vector<std::string> patterns);

  bool isWanted(const std::string& pair) { return rowOf(pair).is_wanted; }
  /// Returns whether a pair's answer is a row, which is the pair's last one from then on.
  bool take(const PublishedPair& pair, const PairNiches& message);
  /// Returns whether a pair had a distance, or was proven beyond its cutoff.
  bool hasAnswer() const;
  /// Returns the pairs that have rows and not one answer, with the reason of the last.
  std::map<std::string, std::string> unanswered() const;

 private:
  /// The last row of a pair.
  struct Row {
    bool is_wanted = false;
    bool has_row = false;
    bool has_answer = false;
    std::uint8_t code = 0;
    ros::Time stamp;
    Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
    std::string problem;
  };
  Row& rowOf(const std::string& pair);

  const std::vector<std::string> patterns_;
  std::unordered_map<std::string, Row> rows_;
};

}  // namespace concave_distance
