#pragma once

#include <concave_distance/Nearest.h>
#include <ros/time.h>

#include <functional>
#include <string>

#include "concave_distance/scene/cycle_counts.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// The nearest pair of a cycle, from its located and solved pairs. O(pairs).
/// `number` is the smallest of: the distance of a pair that is exact or proves nothing; the lower bound of a
/// pair whose proof was ended early; the bound of a pair beyond its cutoff. It is set when every pair has one
/// of these, and it is 0 whenever bodies penetrate.
/// @param others pairs by rule that `pairs` does not have
/// @param counts says which of `pairs` count; empty: all
Nearest nearestOf(const PublishedPairs& pairs, const OtherPairs& others, const std::string& reference_frame,
                  ros::Time now, const std::function<bool(const PublishedPair&)>& counts = {});

}  // namespace concave_distance
