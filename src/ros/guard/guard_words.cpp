#include "guard_words.h"

#include "base/number_text.h"
#include "ros/seconds_text.h"

namespace concave_distance {
namespace {

const UnlistedPair* unlistedOf(const GuardDecision& decision, const Constraints& message) {
  if (decision.id == GuardDecision::kNone || decision.id < message.rows.size()) return nullptr;
  const std::size_t index = decision.id - message.rows.size();
  return index < message.unlisted.size() ? &message.unlisted[index] : nullptr;
}

const char* whyUnlisted(std::uint8_t reason) {
  switch (reason) {
    case UnlistedPair::NO_POSE:
      return "it has no pose; check that tf connects its frame with the reference frame";
    case UnlistedPair::UNSOLVED:
      return "it has no answer; see its status on `distances`";
    case UnlistedPair::UNFINISHED:
      return "its list of niches is not finished; give the cycle more time (~rate, ~threads)";
    case UnlistedPair::BEYOND_CUTOFF:
      return "its cutoff is less than ~constraint_distance; raise the one or lower the other";
    case UnlistedPair::NO_SLOT:
      return "it has rows without a slot; raise ~constraint_capacity";
    default:
      return "more pairs are near than ~limits/largest_pair_count; raise it";
  }
}

std::string describeClosing(const GuardDecision& decision, const UnlistedPair* unlisted) {
  TextStream text;
  text << "closes at " << decision.closing << " m/s" << (unlisted != nullptr ? " at most" : "") << " with "
       << decision.room << " m left and needs " << decision.stopping_distance << " m to stop";
  return text.str();
}

std::string namedIn(const GuardDecision& decision, const Constraints& message) {
  const UnlistedPair* unlisted = unlistedOf(decision, message);
  if (unlisted == nullptr || !unlisted->pair.empty()) return "pair " + pairOf(decision, message);
  return unlisted->body_a.empty() ? "pairs" : "body " + unlisted->body_a;
}

std::string describePlace(const GuardDecision& decision, const Constraints& message) {
  const UnlistedPair* unlisted = unlistedOf(decision, message);
  const std::string why = unlisted == nullptr ? "" : whyUnlisted(unlisted->reason);
  switch (decision.reason) {
    case GuardReason::Closing:
      return describeClosing(decision, unlisted) + (why.empty() ? "" : "; " + why);
    case GuardReason::Overlaps:
      return "the bodies overlap, in a direction that is not known; set expert/signed_values of the pair";
    case GuardReason::NotFinite:
      return "a number of its row is not finite";
    default:
      return unlisted == nullptr ? "what moves there by itself is not known yet" : why;
  }
}

}  // namespace

std::string pairOf(const GuardDecision& decision, const Constraints& message) {
  if (decision.id == GuardDecision::kNone) return "";
  if (decision.id < message.rows.size()) return message.rows[decision.id].pair;
  const UnlistedPair* unlisted = unlistedOf(decision, message);
  return unlisted == nullptr ? "" : unlisted->pair;
}

std::string wordsFor(const GuardDecision& decision, const Constraints* message, const GuardSettings& settings,
                     double age, const std::string& fault) {
  TextStream text;
  switch (decision.reason) {
    case GuardReason::Free:
      return "nothing that closes is near";
    case GuardReason::Rising:
      return "the scale rises again";
    case GuardReason::NoRows:
      return fault.empty() ? "no rows have come yet; check ~constraints_topic and the distance node" : fault;
    case GuardReason::Stale:
      text << "the transforms of the rows are " << secondsText(age) << " s old; ~stale_after is "
           << settings.stale_after << " s; check the distance node and tf";
      return text.str();
    case GuardReason::ClockBack:
      return "the clock jumped back; the next rows begin anew";
    case GuardReason::BadCommand:
      return fault;
    case GuardReason::NotFinite:
    case GuardReason::Unknown:
      if (!fault.empty()) return fault;
      break;
    default:
      break;
  }
  return message == nullptr ? "" : namedIn(decision, *message) + ": " + describePlace(decision, *message);
}

}  // namespace concave_distance
