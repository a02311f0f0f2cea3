#pragma once

#include <concave_distance/Nearest.h>
#include <ros/time.h>

#include <memory>
#include <string>
#include <vector>

#include "concave_distance/ros/tracked_pair.h"

namespace concave_distance {

/// The nearest of the pairs that are due in this cycle, which have been located and solved. O(pairs).
/// `number` is the smallest of: the distance of a pair whose distance is exact, or which proves nothing; the
/// lower bound of a pair whose proof was ended early; the bound of a pair beyond its cutoff. It is there when
/// every pair has one of them, or when bodies penetrate: then it is 0, whatever the others are.
Nearest nearestOf(const std::vector<std::unique_ptr<TrackedPair>>& pairs, const std::string& reference_frame,
                  ros::Time now);

}  // namespace concave_distance
