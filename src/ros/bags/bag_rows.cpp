#include "bag_rows.h"

#include <algorithm>
#include <utility>

#include "scene/name_pattern.h"

namespace concave_distance {

BagRows::BagRows(std::vector<std::string> patterns) : patterns_(std::move(patterns)) {}

BagRows::Row& BagRows::rowOf(const std::string& pair) {
  const auto [place, is_new] = rows_.try_emplace(pair);
  if (is_new) {
    place->second.is_wanted =
        patterns_.empty() || std::any_of(patterns_.begin(), patterns_.end(), [&](const std::string& pattern) {
          return pattern == pair || detail::matchesPattern(pattern, pair);
        });
  }
  return place->second;
}

bool BagRows::take(const PublishedPair& pair, const PairNiches& message) {
  const std::uint8_t code = message.nearest.status.code;
  if (code == PairStatus::DISABLED) return false;
  const PairInput& input = pair.tracked->input;
  Row& last = rowOf(pair.heading.pair);
  bool is_new = !last.has_row || code != last.code;
  if (!is_new && message.nearest.has_distance != 0) {
    is_new = input.fixed ? input.a_from_b.matrix() != last.a_from_b.matrix()
                         : message.nearest.header.stamp != last.stamp;
  }
  if (!is_new) return false;
  const bool has_answer = message.nearest.has_distance != 0 || code == PairStatus::BEYOND_CUTOFF;
  last.has_row = true;
  last.has_answer = last.has_answer || has_answer;
  last.code = code;
  last.stamp = message.nearest.header.stamp;
  last.a_from_b = input.a_from_b;
  last.problem = message.nearest.status.message;
  return true;
}

bool BagRows::hasAnswer() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const auto& row) { return row.second.has_answer; });
}

std::map<std::string, std::string> BagRows::unanswered() const {
  std::map<std::string, std::string> found;
  for (const auto& [name, row] : rows_) {
    if (row.has_row && !row.has_answer) found.emplace(name, row.problem);
  }
  return found;
}

}  // namespace concave_distance
