#include "nearest.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace concave_distance {
namespace {

/// A summary of all pairs.
struct Survey {
  const PublishedPair* nearest = nullptr;  ///< among pairs with a distance
  const PublishedPair* missing = nullptr;  ///< the first pair without distance and bound
  double distance = kInfinity;             ///< of `nearest`
  double number = kInfinity;               ///< Nearest::number, so far
  double lower_bound = kInfinity;
  bool all_proven = true;
  std::uint64_t pairs = 0;
  std::uint64_t missing_count = 0;
  std::uint64_t beyond_cutoff = 0;
  std::uint64_t cut = 0;

  void add(const OtherPairs& others) {
    pairs += others.beyond + others.missing + others.cut;
    missing_count += others.missing;
    beyond_cutoff += others.beyond;
    cut = others.cut;
    number = std::min(number, others.lower_bound);
    lower_bound = std::min(lower_bound, others.lower_bound);
  }

  void add(const PublishedPair& pair) {
    ++pairs;
    if (pair.tracked->box_bound) {
      ++beyond_cutoff;
      number = std::min(number, *pair.tracked->box_bound);
      lower_bound = std::min(lower_bound, *pair.tracked->box_bound);
    } else if (pair.tracked->solved() && !std::isnan(pair.tracked->solution.distance)) {
      addSolved(pair);
    } else {
      missing = missing == nullptr ? &pair : missing;
      ++missing_count;
    }
  }

 private:
  void addSolved(const PublishedPair& pair) {
    const PairSolution& solution = pair.tracked->solution;
    if (nearest == nullptr || solution.distance < distance) {
      nearest = &pair;
      distance = solution.distance;
    }
    const bool has_bound = !std::isnan(solution.lower_bound);
    all_proven = all_proven && has_bound;
    lower_bound = has_bound ? std::min(lower_bound, solution.lower_bound) : lower_bound;
    // A proof that ended early, for any reason, leaves the distance an upper bound.
    const bool ended_early = has_bound && solution.status != SolveStatus::Ok;
    number = std::min(number, ended_early ? solution.lower_bound : solution.distance);
  }
};

std::string ofPairs(std::uint64_t count, std::uint64_t all) {
  return std::to_string(count) + " of " + std::to_string(all) + " pairs ";
}

std::string explain(const Survey& survey) {
  if (survey.pairs == 0) {
    return "no pair is watched: the scene has none, or all are switched off";
  }
  if (survey.cut > 0) {
    return ofPairs(survey.cut, survey.pairs) +
           "are near and not solved (raise ~limits/largest_pair_count, or shorten ~cutoff)";
  }
  if (survey.missing != nullptr) {
    return ofPairs(survey.missing_count, survey.pairs) + "have no distance and may be nearer; the first is " +
           survey.missing->heading.pair + ": " + survey.missing->status.message;
  }
  if (survey.nearest == nullptr) {
    return "all pairs are farther apart than their cutoff";
  }
  return ofPairs(survey.beyond_cutoff, survey.pairs) +
         "are beyond their cutoff, or their proof was ended early, and may be nearer";
}

}  // namespace

Nearest nearestOf(const PublishedPairs& pairs, const OtherPairs& others, const std::string& reference_frame,
                  ros::Time now, const std::function<bool(const PublishedPair&)>& counts) {
  Survey survey;
  survey.add(others);
  for (const auto& pair : pairs) {
    if (pair->demand().due && (!counts || counts(*pair))) {
      survey.add(*pair);
    }
  }
  Nearest message;
  message.header.frame_id = reference_frame;
  message.header.stamp = survey.nearest == nullptr ? now : survey.nearest->heading.stamp;
  message.distance = message.lower_bound = message.number = kNotComputed;
  message.pairs = static_cast<std::uint32_t>(survey.pairs);
  message.pairs_missing = static_cast<std::uint32_t>(survey.missing_count);
  message.pairs_beyond_cutoff = static_cast<std::uint32_t>(survey.beyond_cutoff);
  message.pairs_cut = static_cast<std::uint32_t>(survey.cut);
  if (survey.nearest != nullptr) {
    message.pair = survey.nearest->heading.pair;
    message.body_a = survey.nearest->heading.body_a;
    message.body_b = survey.nearest->heading.body_b;
    message.has_distance = 1;
    message.distance = survey.distance;
  }
  const bool touching = survey.distance == 0.0;  // nothing can be nearer
  const bool all_known = survey.pairs > 0 && survey.missing_count == 0;
  message.is_minimum = static_cast<std::uint8_t>(
      touching || (all_known && survey.nearest != nullptr && survey.number >= survey.distance));
  if (touching || (all_known && survey.all_proven)) {
    message.has_lower_bound = 1;
    message.lower_bound = touching ? 0.0 : survey.lower_bound;
  }
  if (touching || all_known) {
    message.has_number = 1;
    message.number = touching ? 0.0 : survey.number;
  }
  if (message.is_minimum == 0) {
    message.message = explain(survey);
  }
  return message;
}

}  // namespace concave_distance
