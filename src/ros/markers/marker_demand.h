#pragma once

#include <concave_distance/PairNiches.h>
#include <ros/time.h>

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "marker_selection.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

/// Decides of which pairs the markers need niches, and in which cycle these are computed. Niches cost far
/// more than distances, and a picture must not slow the cycle down: only pairs that were selected in the last
/// second are asked, those with the oldest niches first, a few in each cycle. In between, the last niches are
/// drawn.
class MarkerDemand {
 public:
  /// Before a cycle: chooses the pairs that are asked in it. @param seconds that they may take, on average
  void begin(double seconds);
  bool wantsNiches(const std::string& pair) const;
  /// After the cycle: keeps the niches of the pairs asked.
  void take(const PublishedPairs& pairs);

  /// @param drawn pairs selected at the time `now`
  void select(const std::vector<DrawnPair>& drawn, ros::Time now);
  /// Each message without niches with those kept of its pair, or as it was before its transforms became
  /// stale; where none are kept, the message itself. Valid until take().
  std::vector<const PairNiches*> withKeptNiches(const std::vector<PairNiches>& messages);

  void forget();

 private:
  const PairNiches* withKeptNiches(const PairNiches& message);
  struct Entry {
    ros::Time selected;       ///< the last time
    std::uint64_t asked = 0;  ///< number of the last question
    double seconds = -1.0;    ///< that its last solve with niches took; negative: not known
    bool known = false;
    PairNiches niches;
    bool is_asked = false;  ///< in this cycle
  };
  std::unordered_map<std::string, Entry> entries_;  ///< by the pair's name
  std::uint64_t questions_ = 0;
  double credit_ = 0.0;  ///< s that niches may take now; negative: a debt
};

}  // namespace concave_distance
