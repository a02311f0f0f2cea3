#include "overlap_parts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "shell_material.h"

namespace concave_distance::detail {

bool OverlapParts::find(const PairFrame& frame, bool is_tracked, LocalMinimaCost& cost, WorkLimit& limit) {
  earlier_.clear();
  if (is_tracked) keepEarlier();
  parts_.clear();
  const bool all = findSets(frame, cost, limit);
  numberParts();
  inherit();
  const bool is_chosen = choosePlaces(frame, limit);
  if (!all) {
    // A set that no earlier pose knows may be a part of another one; but there is one part at least.
    const bool is_known = std::any_of(parts_.begin(), parts_.end(), [](const Part& p) { return p.id != 0; });
    for (std::size_t k = is_known ? 0 : 1; k < parts_.size(); ++k) {
      if (parts_[k].id == 0) parts_[k].state = State::Unknown;
    }
  }
  for (Part& part : parts_) {
    if (is_tracked && part.id == 0 && part.state != State::Unknown) part.id = kIdBit | ++parts_made_;
  }
  return all && is_chosen;
}

void OverlapParts::findNone() {
  met_.clear();
  parts_.clear();
  order_.clear();
  earlier_.clear();
}

/// Keeps the last pose's parts, with the pairs of each.
void OverlapParts::keepEarlier() {
  earlier_pairs_.clear();
  for (const Part& part : parts_) {
    if (part.id == 0) continue;
    const auto first = static_cast<std::uint32_t>(earlier_pairs_.size());
    for (std::uint32_t k = part.first; k < part.last; ++k) {
      const MeetingPair& pair = met_.pairs()[order_[k]];
      earlier_pairs_.push_back({pair.a, pair.b});
    }
    earlier_.push_back({part.id, first, static_cast<std::uint32_t>(earlier_pairs_.size()), kNone});
  }
}

bool OverlapParts::findSets(const PairFrame& frame, LocalMinimaCost& cost, WorkLimit& limit) {
  const bool has_all_pairs = met_.collect(frame, cost, limit);
  if (sets_.join(frame, met_, limit) && has_all_pairs) return true;
  // Sets that were one part at the last pose are taken for one.
  for (const Earlier& part : earlier_) {
    std::uint32_t known = kNone;
    for (std::uint32_t k = part.first; k < part.last; ++k) {
      const std::uint32_t pair = met_.find(earlier_pairs_[k].a, earlier_pairs_[k].b);
      if (pair == MeetingPairs::kNone) continue;
      if (known != kNone) sets_.unite(known, pair);
      known = pair;
    }
  }
  return false;
}

void OverlapParts::numberParts() {
  const auto count = static_cast<std::uint32_t>(met_.pairs().size());
  part_of_pair_.clear();
  order_.clear();
  for (std::uint32_t pair = 0; pair < count; ++pair) {
    const std::uint32_t set = sets_.setOf(pair);  // the first of the set
    part_of_pair_.push_back(set == pair ? static_cast<std::uint32_t>(parts_.size()) : part_of_pair_[set]);
    if (set == pair) parts_.emplace_back();
    ++parts_[part_of_pair_.back()].last;
  }
  std::uint32_t end = 0;
  for (Part& part : parts_) {
    part.first = end;
    end += part.last;
    part.last = part.first;
  }
  order_.resize(count);
  for (std::uint32_t pair = 0; pair < count; ++pair) order_[parts_[part_of_pair_[pair]].last++] = pair;
}

/// Each part is where its nearest pair is that does not meet in the material of other shells.
bool OverlapParts::choosePlaces(const PairFrame& frame, WorkLimit& limit) {
  const auto is_before = [&](std::uint32_t l, std::uint32_t r) {
    const MeetingPair& of_l = met_.pairs()[l];
    const MeetingPair& of_r = met_.pairs()[r];
    return std::tie(of_l.distance, of_l.a, of_l.b) < std::tie(of_r.distance, of_r.a, of_r.b);
  };
  for (Part& part : parts_) {
    const auto first = order_.begin() + part.first;
    const auto last = order_.begin() + part.last;
    if (frame.hasJoints()) std::sort(first, last, is_before);
    auto place = std::min_element(first, last, is_before);
    for (;; ++place) {
      if (place == last || limit.isOverNow()) {
        part.state = place == last ? State::InMaterial : State::Unknown;
        place = first;
      }
      const MeetingPair& pair = met_.pairs()[*place];
      const auto [triangles, closest] = frame.closestIn({pair.a, pair.b});
      const double distance = std::sqrt(closest.squared_distance);
      part.triangles = triangles;
      part.distance = distance > 4.0 * frame.rounding ? distance : 0.0;
      if (part.state != State::Niche || !frame.hasJoints()) break;
      const double tolerance = meetingTolerance(frame);
      if (isMeetingInSight(frame, {pair.a, pair.b}, triangles, closest, tolerance)) break;
    }
    std::iter_swap(first, place);
  }
  return !limit.isOver();
}

/// Gives each part the oldest id of those that it goes on from.
void OverlapParts::inherit() {
  for (Earlier& earlier : earlier_) {
    for (std::uint32_t k = earlier.first; k < earlier.last && earlier.heir == kNone; ++k) {
      earlier.heir = partIn(earlier_pairs_[k].a, earlier_pairs_[k].b);
    }
    if (earlier.heir == kNone) continue;
    Part& heir = parts_[earlier.heir];
    heir.id = heir.id == 0 ? earlier.id : std::min(heir.id, earlier.id);
  }
}

std::uint32_t OverlapParts::heirOf(std::uint64_t id) const {
  const auto found =
      std::find_if(earlier_.begin(), earlier_.end(), [&](const Earlier& part) { return part.id == id; });
  return found == earlier_.end() ? kNone : found->heir;
}

}  // namespace concave_distance::detail
