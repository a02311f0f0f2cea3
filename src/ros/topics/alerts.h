#pragma once

#include <concave_distance/Alert.h>

#include <cstdint>

#include "concave_distance/scene/cycle_counts.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

inline constexpr std::uint32_t kAlertQueueLength = 100;  // messages; none of them is to be lost

/// Returns the alert of a pair as its last cycle left it.
Alert toAlert(const PublishedPair& pair);
/// Returns the alert that takes one back whose pair is not tracked any more.
/// @param heading of that pair, with the time of now
Alert clearedAlert(const PairHeading& heading, const OtherPairs& others);

}  // namespace concave_distance
