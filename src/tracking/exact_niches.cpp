#include "exact_niches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/refill.h"
#include "distance/niches/niche_properties.h"

namespace concave_distance {
namespace {

// A warm cycle rarely has more; buffers grow beyond it.
constexpr std::size_t kUsualProposals = 256;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// Time is reserved for a descent to each known niche, up to this share of all time.
constexpr double kSecondsOfKnown = 3e-6;
constexpr double kMostForKnown = 0.3;
// The search for all minima ends after this share of the rest, the searches of basins after that one.
constexpr double kShareOfMinima = 0.6;
// Where part of a list is worth little, a search that is behind the motion needs most of the time, or it
// never catches up with it.
constexpr double kShareToCatchUp = 0.88;
constexpr double kShareOfFloods = 0.9;

// Half as many niches more than are reported are kept, for those that come and go at the edge of the list.
constexpr std::size_t archiveCapacity(std::size_t reported) {
  return reported + (reported + 1) / 2;
}

/// The niche of a local minimum; identity, birth and speed are the caller's.
void placeMinimum(NicheRecord& record, const PairFrame& frame, const LocalMinimum& minimum) {
  placeRecord(record, frame, minimum.witness);
  TrackedNiche& niche = record.niche;
  niche.distance = minimum.distance;
  niche.kind = minimum.kind;
  niche.extent = minimum.extent;
  niche.outward = minimum.outward;
  niche.visible = minimum.visible;
  niche.prominence = std::isfinite(minimum.prominence) ? minimum.prominence : kNotComputed;
  niche.proven_local_minimum = true;
  record.basin = minimum.basin;
  record.carried = false;
}

}  // namespace

void ExactNiches::follow(const PairFrame& frame, const NicheArchive& archive, WorkLimit& limit) {
  followed_.clear();
  if (archive.records().empty() && nearest_) {
    followed_.push_back(frame.candidateOf(frame.refine(nearest_->a, nearest_->b, refinement_).witness));
  }
  for (const NicheRecord& record : archive.records()) {
    if (limit.isOver()) return;
    const WitnessPair& witness = record.niche.witness;
    followed_.push_back(frame.candidateOf(refine(frame, witness)));
  }
}

void ExactNiches::propose(const PairFrame& frame, const WitnessPair& minimum) {
  request_.proposals.push_back(frame.candidateOf(minimum));
  searched_ = request_.proposals.size();
}

void ExactNiches::proposeProven(const PairFrame& frame, const WitnessPair& closest, bool is_meeting) {
  request_.proposals.push_back(frame.candidateOf(closest));
  if (is_meeting) request_.proposals.back().distance = 0.0;
}

void ExactNiches::admit(const PairFrame& frame, const TrackerParameters& parameters, const Cycle& cycle,
                        double certain_distance, double time_share, NicheArchive& archive,
                        PairSolution& solution, WorkLimit& limit) {
  const bool looks_for_all = provesDistance(parameters.accuracy);
  std::vector<NicheRecord>& records = archive.records();
  request_.limit = &limit;
  if (cycle.is_tracked) request_.proposals.reserve(kUsualProposals);
  request_.is_tracked = cycle.is_tracked;
  request_.cutoff = cycle.cutoff;
  request_.rule = {parameters.least_prominence, parameters.prominence_limit, parameters.margin()};
  request_.largest_count = archiveCapacity(parameters.largest_niche_count);
  request_.through_material = parameters.keep_through_material;
  request_.hidden = parameters.hidden;
  request_.certain_distance = certain_distance;
  const double for_known = kSecondsOfKnown * static_cast<double>(records.size());
  const double all = time_share - std::min(kMostForKnown, limit.shareOf(for_known));
  const double for_minima = cycle.catches_up ? kShareToCatchUp : kShareOfMinima;
  request_.time_shares = {for_minima * all, kShareOfFloods * all, all};
  request_.finishes_searches = cycle.catches_up;
  request_.given = nullptr;
  if (!looks_for_all) {
    followed_.insert(followed_.end(), request_.proposals.begin(), request_.proposals.end());
    request_.given = &followed_;
    const MinimumCandidate* nearest = nearestProposed();
    nearest_.reset();
    if (nearest != nullptr) nearest_ = TrianglePair{nearest->a, nearest->b};
  }
  request_.asked_pairs.clear();
  request_.asked_basins.clear();
  for (const NicheRecord& record : records) {
    request_.asked_pairs.emplace_back(record.niche.witness.triangle_a, record.niche.witness.triangle_b);
    request_.asked_basins.push_back(record.basin);
  }
  request_.known.reset();
  if (cycle.convex == detail::ConvexNiches::OnlyTheNearest) request_.known = {&request_.proposals.back()};
  if (cycle.convex == detail::ConvexNiches::None) request_.known = {nullptr};
  const bool only_dents = cycle.convex == detail::ConvexNiches::TheNearestAndDents;
  request_.nearest_beside_dents = only_dents ? &request_.proposals.back() : nullptr;
  findLocalMinima(frame, request_, memory_, found_);
  current_ = found_.finished;
  solution.cost.evaluations +=
      found_.cost.feature_pairs + found_.cost.candidates + found_.cost.searched_pairs;

  matchPrevious(archive, frame, cycle.last_a_from_b);
  attributeOffered(frame);
  endOthers(archive, solution.events);
  next_.clear();
  evolved_ = 0;
  for (std::size_t k = 0; k < found_.niches.size(); ++k) {
    const LocalMinimum& minimum = found_.niches[k];
    const bool known = heirs_[k] != kNone;
    NicheRecord& record = next_.emplace_back(known ? records[heirs_[k]] : NicheRecord());
    TrackedNiche& niche = record.niche;
    if (known) {
      niche.origin = NicheOrigin::Inherited;
    } else if (isSearched(minimum) || !looks_for_all) {
      niche.origin = NicheOrigin::Evolved;
      ++evolved_;
    } else {
      const bool is_proven_alone = !found_.finished && minimum.proposal != LocalMinimum::kNoProposal;
      niche.origin = is_proven_alone ? NicheOrigin::Proven : NicheOrigin::FromCones;
    }
    if (!known) {
      niche.id = archive.takeId();
      niche.birth_cycle = cycle.number;
    }
    const double before = niche.distance;
    placeMinimum(record, frame, minimum);
    niche.closing_speed =
        known && cycle.elapsed > 0.0 ? (before - niche.distance) / cycle.elapsed : kNotComputed;
  }
  records.swap(next_);
  limit.allowShare(time_share);
  if (!found_.finished) carryOthers(next_, frame, archive, limit, solution.events);
  archive.settle();
  request_.proposals.clear();
  searched_ = 0;
  offered_ = nullptr;
}

void ExactNiches::attributeOffered(const PairFrame& frame) {
  if (offered_ == nullptr || !found_.finished) return;
  if (std::find(heirs_.begin(), heirs_.end(), kNone) == heirs_.end()) return;
  request_.proposals.clear();
  for (LocalMinimum& niche : found_.niches) niche.proposal = LocalMinimum::kNoProposal;
  for (std::size_t i = 0; i < offered_->size(); ++i) {
    const WitnessPair nodes = nodeWitness(frame, (*offered_)[i]);
    const WitnessPair minimum = refine(frame, nodes);
    propose(frame, minimum);
  }
  attributeProposals(frame, request_, memory_, found_);
}

// A known niche goes on as the one whose basin it is in now, the oldest of them first. Before, no point pair
// of the basin was nearer than the niche: the minimum cannot be nearer by more than its point of B has moved
// since, or it has come from elsewhere.
void ExactNiches::matchPrevious(const NicheArchive& archive, const PairFrame& frame,
                                const Eigen::Isometry3d& last_a_from_b) {
  const std::vector<NicheRecord>& records = archive.records();
  const double rounding = kPlateauTolerance * frame.diameters();
  refill(heirs_, found_.niches.size(), kNone);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::size_t owner = found_.owners[i];
    if (owner >= found_.niches.size()) continue;
    const LocalMinimum& minimum = found_.niches[owner];
    const TrackedNiche& known = records[i].niche;
    const Eigen::Vector3d& point = minimum.witness.point_b_in_a;
    const double moved = (last_a_from_b * (frame.bFromA() * point) - point).norm();
    if (!records[i].carried && minimum.distance < known.distance - moved - rounding) continue;
    if (heirs_[owner] == kNone || known.id < records[heirs_[owner]].niche.id) heirs_[owner] = i;
  }
}

void ExactNiches::endOthers(const NicheArchive& archive, std::vector<NicheEvent>& events) const {
  const std::vector<NicheRecord>& records = archive.records();
  for (std::size_t i = 0; i < records.size(); ++i) {
    const std::size_t owner = found_.owners[i];
    if (owner == LocalMinima::kUndecided) continue;
    const std::size_t heir = owner == LocalMinima::kNoOwner ? kNone : heirs_[owner];
    if (heir == i || !records[i].reported) continue;
    if (heir == kNone) {
      events.push_back({NicheEvent::Kind::Death, records[i].niche.id, 0});
    } else {
      events.push_back({NicheEvent::Kind::Merge, records[i].niche.id, records[heir].niche.id});
    }
  }
}

// Known niches of which time or memory did not suffice to see what has become stay, each at the minimum
// around its triangles.
void ExactNiches::carryOthers(const std::vector<NicheRecord>& known, const PairFrame& frame,
                              NicheArchive& archive, WorkLimit& limit, std::vector<NicheEvent>& events) {
  const double tolerance = frame.samePlaceTolerance();
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (found_.owners[i] != LocalMinima::kUndecided) continue;
    NicheRecord record = known[i];
    if (!limit.isOver()) {
      const WitnessPair& witness = record.niche.witness;
      placeRecord(record, frame, refine(frame, witness));
    }
    carryRecord(record, frame);
    record.niche.origin = NicheOrigin::Inherited;
    const NicheRecord* same =
        archive.findSamePlace(record.niche.point_a_in_a, record.point_b_in_b, tolerance);
    if (same == nullptr) {
      archive.records().push_back(record);
    } else if (record.reported) {
      events.push_back({NicheEvent::Kind::Merge, record.niche.id, same->niche.id});
    }
  }
}

const MinimumCandidate* ExactNiches::nearestProposed() const {
  const auto nearest = std::min_element(
      followed_.begin(), followed_.end(),
      [](const MinimumCandidate& l, const MinimumCandidate& r) { return l.distance < r.distance; });
  return nearest == followed_.end() ? nullptr : &*nearest;
}

double ExactNiches::work() const {
  // These are the costs of each kind of step, in evaluations of the search, roughly.
  constexpr double kGroups = 4.0;
  constexpr double kFeatures = 10.0;
  constexpr double kCells = 12.0;
  return kGroups * static_cast<double>(found_.cost.node_pairs) +
         kFeatures * static_cast<double>(found_.cost.feature_pairs) +
         kCells * static_cast<double>(found_.cost.searched_pairs);
}

void ExactNiches::clear() {
  memory_.clear();
  nearest_.reset();
  current_ = false;
  request_.proposals.clear();
  searched_ = 0;
  offered_ = nullptr;
}

}  // namespace concave_distance
