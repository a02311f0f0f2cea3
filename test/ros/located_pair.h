#pragma once

#include <memory>
#include <string>

#include "ros/tf/tf_locate.h"
#include "ros/transform_message.h"

namespace concave_distance::test {

/// Two bodies at the origins of their frames.
struct LocatedPair {
  FrameTransform place;  ///< of A
  bool fixed = false;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
};

inline LocatedPair located(const std::shared_ptr<const tf2::BufferCore>& buffer, const std::string& reference,
                           const std::string& a, const std::string& b, ros::Time now, double stale_after,
                           ros::Time at = ros::Time()) {
  TfLocate locate(reference);
  locate.setBodies({a, b}, std::vector<Eigen::Isometry3d>(2, Eigen::Isometry3d::Identity()));
  locate.update(buffer, now, stale_after, at);
  const PairInput input = locate(0, 1);
  return {locate.placeOfA(0, 1, input.located), input.fixed, input.a_from_b};
}

}  // namespace concave_distance::test
