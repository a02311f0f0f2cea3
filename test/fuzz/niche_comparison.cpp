#include "fuzz/niche_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace concave_distance::test {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::string at(const WitnessPoints& points) {
  std::ostringstream text;
  text.precision(10);
  text << " from (" << points.a.x << ", " << points.a.y << ", " << points.a.z << ") to (" << points.b.x
       << ", " << points.b.y << ", " << points.b.z << ")";
  return text.str();
}

/// Moves a distance and its points back to the bare surfaces. Returns whether they are those of a padded
/// place.
template <typename Place>
bool moveToBareSurfaces(const TrackerParameters& parameters, Place& place) {
  if (std::isnan(place.signed_distance)) return place.distance == 0.0;
  if (place.distance != std::max(0.0, place.signed_distance)) return false;
  place.distance = place.signed_distance + parameters.margin();
  const Eigen::Vector3d along = place.normal_in_a.normalized();
  place.point_a_in_a -= parameters.margin_a * along;
  place.point_b_in_a += parameters.margin_b * along;
  return true;
}

class Comparison {
 public:
  Comparison(const PairSolution& solution, const TrackerParameters& parameters,
             const NicheEnumeration& enumeration, bool shells_cross)
      : solution_(solution), parameters_(parameters), truth_(enumeration), shells_cross_(shells_cross) {
    text_.precision(10);
  }

  std::string complaint() {
    if (parameters_.margin() > 0.0) takeMarginsAway();
    checkDistance();
    if (!parameters_.niches_wanted) {
      if (!solution_.niches.empty()) text_ << "niches are listed that nobody wanted; ";
      return text_.str();
    }
    niches_ = truth_.niches(parameters_.least_prominence, parameters_.margin());
    for (std::size_t i = 0; i < solution_.niches.size(); ++i) checkListed(i);
    checkMissing();
    return text_.str();
  }

 private:
  /// Turns the answer and the cutoff into those of the bare surfaces, which the enumeration knows.
  void takeMarginsAway() {
    const bool overlaps_by_margins = solution_.signed_distance <= 0.0;
    if (overlaps_by_margins &&
        (solution_.status != SolveStatus::Penetrating || solution_.lower_bound != 0.0)) {
      text_ << "margins overlap, status " << toString(solution_.status) << ", lower bound "
            << solution_.lower_bound << "; ";
    }
    for (TrackedNiche& niche : solution_.niches) {
      if (moveToBareSurfaces(parameters_, niche)) continue;
      text_ << "listed " << niche.distance << ", signed " << niche.signed_distance << "; ";
    }
    if (!moveToBareSurfaces(parameters_, solution_)) {
      text_ << "distance " << solution_.distance << ", signed " << solution_.signed_distance << "; ";
    }
    if (overlaps_by_margins) {
      solution_.status = SolveStatus::Ok;
    } else if (solution_.status != SolveStatus::Penetrating) {
      solution_.lower_bound += parameters_.margin();
    }
    parameters_.cutoff += parameters_.margin();
  }

  bool isEqual(long double l, long double r) const { return std::abs(l - r) <= truth_.tolerance(); }

  void checkDistance() {
    if (solution_.status != SolveStatus::Ok && solution_.status != SolveStatus::Penetrating) {
      text_ << "status " << toString(solution_.status) << "; ";
    } else if (solution_.status == SolveStatus::Ok) {
      if (!isEqual(solution_.distance, truth_.least()) ||
          solution_.lower_bound > truth_.least() + truth_.tolerance()) {
        text_ << "distance " << solution_.distance << ", lower bound " << solution_.lower_bound << ", true "
              << truth_.least() << "; ";
      }
    } else if (!isEqual(truth_.least(), 0.0L) && !isEqual(solution_.surface_distance, truth_.least()) &&
               !meetsWithinMaterial()) {
      text_ << "penetrating, surface distance " << solution_.surface_distance << ", true " << truth_.least()
            << "; ";
    }
  }

  /// A body that has swallowed another may touch it with a shell inside of its own material, too.
  bool meetsWithinMaterial() const {
    if (!solution_.meeting_triangles) return false;
    const auto& [a, b] = *solution_.meeting_triangles;
    const std::size_t cell = truth_.cellOf(a.value, b.value);
    return std::isinf(truth_.distanceOf(cell)) && truth_.distanceWithinMaterial(cell) <= truth_.tolerance();
  }

  void checkListed(std::size_t index) {
    const TrackedNiche& niche = solution_.niches[index];
    const std::size_t cell = truth_.cellOf(niche.witness.triangle_a.value, niche.witness.triangle_b.value);
    const WitnessPoints points{widened(niche.point_a_in_a), widened(niche.point_b_in_a)};
    const auto complain = [&](const std::string& what) {
      text_ << "listed " << niche.distance << at(points) << ": " << what << "; ";
    };
    if (niche.distance > parameters_.cutoff) complain("beyond the cutoff");
    if (index > 0 && niche.distance < solution_.niches[index - 1].distance) complain("out of order");
    if (!isEqual(std::sqrt((points.b - points.a).squaredNorm()), niche.distance) ||
        truth_.offTriangles(cell, points) > truth_.tolerance()) {
      return complain("the points are not on the triangles at that distance");
    }
    const std::size_t own = nicheOf(cell, niche.distance);
    if (own == kNone) return complain("no niche");
    if (std::find(listed_.begin(), listed_.end(), own) != listed_.end()) return complain("listed twice");
    listed_.push_back(own);
    if (niches_[own].distance <= truth_.tolerance()) return;
    const Clarity visible = truth_.isVisible(points);
    if (!parameters_.hidden && !niche.visible) complain("hidden, and not asked for");
    if (visible == (niche.visible ? Clarity::No : Clarity::Yes))
      complain("wrongly flagged visible or hidden");
    if (!parameters_.keep_through_material && truth_.isOutward(points) == Clarity::No) {
      complain("through material");
    }
    checkProminence(index, niches_[own]);
  }

  void checkProminence(std::size_t index, const EnumeratedNiche& truth) {
    const TrackedNiche& niche = solution_.niches[index];
    if (index == 0 || truth.is_tied || !(parameters_.prominence_limit > parameters_.least_prominence)) return;
    const long double margin = parameters_.margin();
    const long double padded = truth.distance - margin;
    if (padded <= truth_.tolerance()) return;
    const long double slack = 8.0L * truth_.tolerance() / padded + 1e-12L;
    const long double own = (truth.pass - margin) / padded - 1.0L;
    const long double most =
        std::min<long double>(parameters_.prominence_limit, (parameters_.cutoff - margin) / padded - 1.0L);
    const bool is_measured = std::isfinite(niche.prominence);
    if (is_measured ? std::abs(niche.prominence - own) > slack * (1.0L + own) : own < most - slack) {
      text_ << "listed " << niche.distance << ": prominence " << niche.prominence << ", true " << own << "; ";
    }
  }

  std::size_t nicheOf(std::size_t cell, double distance) const {
    std::size_t best = kNone;
    for (std::size_t i = 0; i < niches_.size(); ++i) {
      if (!isEqual(niches_[i].distance, distance)) continue;
      if (!std::binary_search(niches_[i].cells.begin(), niches_[i].cells.end(), cell)) continue;
      const bool is_free = std::find(listed_.begin(), listed_.end(), i) == listed_.end();
      if (best == kNone || is_free) best = i;
    }
    return best;
  }

  /// Whether a niche must be listed wherever there is room.
  bool isWanted(const EnumeratedNiche& niche) const {
    if (!niche.is_certain || niche.distance > parameters_.cutoff - truth_.tolerance()) return false;
    if (niche.distance <= truth_.tolerance()) return true;
    // An extended set is seen where its middle is: it must be listed if it is seen wherever one looks.
    bool is_clear = false;
    for (const std::size_t cell : niche.cells) {
      const std::vector<WitnessPoints> corners = truth_.minimisers(cell);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        Clarity seen = parameters_.hidden ? Clarity::Yes : truth_.isVisible(corners[i]);
        if (seen == Clarity::Yes && !parameters_.keep_through_material) seen = truth_.isOutward(corners[i]);
        if (seen == Clarity::No) return false;
        is_clear = is_clear || (seen == Clarity::Yes && i + 1 == corners.size());
      }
    }
    return is_clear;
  }

  void checkMissing() {
    const bool is_full = solution_.niches.size() >= parameters_.largest_niche_count;
    const double last = solution_.niches.empty() ? 0.0 : solution_.niches.back().distance;
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < niches_.size(); ++i) {
      if (std::find(listed_.begin(), listed_.end(), i) != listed_.end() || !isWanted(niches_[i])) continue;
      const bool is_meeting = !(niches_[i].distance > truth_.tolerance());
      if (shells_cross_ && is_meeting && truth_.isMeetingInSight(niches_[i]) != Clarity::Yes) continue;
      ++left_out;
      if (is_full && niches_[i].distance > last - truth_.tolerance()) continue;
      const std::vector<WitnessPoints> corners = truth_.minimisers(niches_[i].cells.front());
      text_ << "missing " << niches_[i].distance
            << (corners.empty() ? " where triangles cross" : at(corners.back())) << ", pass "
            << niches_[i].pass << "; ";
    }
    if (is_full && left_out > 0 && !solution_.niches_cut) text_ << "cut, and does not say so; ";
    if (!is_full && solution_.niches_cut) text_ << "says that it is cut; ";
    if (solution_.niches_complete == solution_.niches_cut) {
      text_ << "complete " << solution_.niches_complete << ", cut " << solution_.niches_cut << "; ";
    }
  }

  PairSolution solution_;
  TrackerParameters parameters_;
  const NicheEnumeration& truth_;
  bool shells_cross_;
  std::vector<EnumeratedNiche> niches_;
  std::vector<std::size_t> listed_;
  std::ostringstream text_;
};

}  // namespace

std::string complaintAbout(const PairSolution& solution, const TrackerParameters& parameters,
                           const NicheEnumeration& enumeration, bool shells_cross) {
  return Comparison(solution, parameters, enumeration, shells_cross).complaint();
}

}  // namespace concave_distance::test
