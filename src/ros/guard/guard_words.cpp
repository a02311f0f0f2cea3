#include "guard_words.h"

#include <algorithm>
#include <array>

#include "base/number_text.h"
#include "ros/seconds_text.h"

namespace concave_distance {
namespace {

/// By UnlistedPair::reason.
constexpr std::array<const char*, 6> kWhyUnlisted = {
    "it has no pose; check that tf connects its frame with the reference frame",
    "it has no answer; see its status on `distances`",
    "its list of niches is not finished; give the cycle more time (~rate, ~threads)",
    "its cutoff is less than ~constraint_distance; raise the one or lower the other",
    "it has rows without a slot; raise ~constraint_capacity",
    "more pairs are near than ~limits/largest_pair_count; raise it"};
static_assert(UnlistedPair::PAIRS_CUT + 1 == kWhyUnlisted.size());

std::string nameOf(const UnlistedPair& unlisted) {
  if (!unlisted.pair.empty()) return "pair " + unlisted.pair;
  return unlisted.body_a.empty() ? "pairs" : "body " + unlisted.body_a;
}

}  // namespace

std::string wordsFor(const GuardDecision& decision, const Constraints& rows, const GuardSettings& settings,
                     double age) {
  TextStream text;
  if (decision.reason == GuardReason::Free) return "nothing that closes is near";
  if (decision.reason == GuardReason::Rising) return "the scale rises again";
  if (decision.reason == GuardReason::Stale) {
    text << "the transforms of the rows are " << secondsText(age) << " s old; ~stale_after is "
         << settings.stale_after << " s; check the distance node and tf";
    return text.str();
  }
  if (decision.id == GuardDecision::kNone) return "a number of the command is not finite";
  const bool is_row = decision.id < rows.rows.size();
  const UnlistedPair unlisted = is_row ? UnlistedPair() : rows.unlisted.at(decision.id - rows.rows.size());
  const std::string why =
      is_row ? "" : kWhyUnlisted[std::min<std::size_t>(unlisted.reason, UnlistedPair::PAIRS_CUT)];
  text << (is_row ? "pair " + rows.rows[decision.id].pair : nameOf(unlisted)) << ": ";
  if (decision.reason == GuardReason::Closing) {
    text << "closes at " << decision.closing << " m/s" << (is_row ? "" : " at most") << " with "
         << decision.room << " m left and needs " << decision.stopping_distance << " m to stop"
         << (is_row ? "" : "; ") << why;
  } else if (decision.reason == GuardReason::Overlaps) {
    text << "the bodies overlap, in a direction that is not known; set expert/signed_values of the pair";
  } else if (decision.reason == GuardReason::NotFinite) {
    text << "a number of its row is not finite";
  } else {
    text << (is_row ? "what moves there by itself is not known yet" : why);
  }
  return text.str();
}

}  // namespace concave_distance
