#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "concave_distance/base/eigen_alignment.h"
#include "concave_distance/base/not_computed.h"
#include "concave_distance/distance/certificate_cost.h"
#include "concave_distance/distance/niche_kind.h"
#include "concave_distance/distance/witness.h"
#include "concave_distance/search/trial_point.h"
#include "concave_distance/tracking/signed_place.h"
#include "concave_distance/tracking/stage_times.h"

namespace concave_distance {

/// Says how exact an answer is (README.md, "What you get").
enum class AccuracyLevel : std::uint8_t { Nodes, Refined, Certified };
/// Returns whether the level proves the distance, and the list of niches, in every cycle.
constexpr bool provesDistance(AccuracyLevel level) {
  return level == AccuracyLevel::Certified;
}
std::string_view toString(AccuracyLevel level);

/// Says what became of a solve; a solve never throws.
enum class SolveStatus : std::uint8_t {
  Ok,               ///< at level `certified`: proven
  Penetrating,      ///< the padded surfaces meet, or one body has swallowed a part of the other
  InvalidPose,      ///< nothing was computed
  BudgetExhausted,  ///< the time ran out before all was done; lower_bound holds
  WithinTolerance,  ///< lower_bound is within the tolerance of the distance
  MemoryExhausted   ///< the limit of facet pairs, or memory, ended before all was done; lower_bound holds
};
std::string_view toString(SolveStatus status);

/// Says what has found a niche in a cycle.
enum class NicheOrigin : std::uint8_t {
  Inherited,  ///< known from the last cycle
  Evolved,    ///< new, and proposed by the genetic search
  FromCones,  ///< new, found among the normal cones
  Proven      ///< new, found by the proof of the distance alone
};
inline constexpr std::size_t kNicheOriginCount = 4;
std::string_view toString(NicheOrigin origin);

/// A local minimum of a pair's distance, followed over time.
struct TrackedNiche {
  std::uint64_t id = 0;            ///< persistent while the niche lives, never used again afterwards
  double distance = kNotComputed;  ///< metres
  /// Metres, as PairSolution::signed_distance; where the bare bodies overlap that of signed_place, less the
  /// margins.
  double signed_distance = kNotComputed;
  SignedPlace signed_place;  ///< where it was asked for (TrackerParameters::signed_values)
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
  /// Unit vector in A's frame from A's witness to B's; where they touch, A's pseudonormal.
  Eigen::Vector3d normal_in_a = Eigen::Vector3d::Constant(kNotComputed);
  double closing_speed = kNotComputed;  ///< m/s, positive when approaching; from the last cycle's distance
  NicheKind kind = NicheKind::Point;
  double extent = 0.0;  ///< metres, see NicheExtent::length
  Outwardness outward = Outwardness::Outward;
  bool visible = true;
  NicheOrigin origin = NicheOrigin::Inherited;
  /// (Lowest pass to a deeper niche) / distance - 1 where it was measured
  /// (TrackerParameters::prominence_limit); infinite for the deepest.
  double prominence = kNotComputed;
  bool proven_local_minimum = false;
  std::uint64_t birth_cycle = 0;
  WitnessPair witness;   ///< on the bare surfaces: triangles and features, for warm starts
  TrialPoint node_pair;  ///< level `nodes` only
};

struct NicheEvent {
  enum class Kind : std::uint8_t { Birth, Death, Merge };
  Kind kind;
  std::uint64_t id;
  std::uint64_t into_id;  ///< of a merge: the niche that lives on
};

/// One pair's answer at one time. Not-computed numbers are NaN, never 0 or a sentinel.
struct PairSolution {
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();  ///< the pose that this is the answer for
  SolveStatus status = SolveStatus::Ok;
  /// The level reached; after the time budget or limit of facet pairs, the level of what was finished.
  AccuracyLevel accuracy = AccuracyLevel::Refined;
  double distance = kNotComputed;  ///< metres; 0 when penetrating
  /// Proven: the true distance is not smaller; 0 when penetrating. NaN at levels that prove none.
  double lower_bound = kNotComputed;
  /// Distance of the bare surfaces less the margins, metres: `distance` where the padded bodies are apart, at
  /// most 0 where only margins overlap (status penetrating); as exact as `accuracy` says. The points are then
  /// those in the margins that are farthest in the other body. NaN where the bare bodies overlap.
  double signed_distance = kNotComputed;
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Constant(kNotComputed);
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Constant(kNotComputed);
  /// The normal is that of the nearest place, as of a niche; NaN where no niche is the nearest.
  Eigen::Vector3d normal_in_a = Eigen::Vector3d::Constant(kNotComputed);
  double closing_speed = kNotComputed;  ///< m/s
  /// Distance of the surfaces where a closed body has swallowed the other (status penetrating).
  double surface_distance = kNotComputed;
  /// Original triangles that meet, where surfaces do (status penetrating); empty when swallowed.
  std::optional<TrianglePair> meeting_triangles;
  /// Ascending by distance; empty unless they were asked for; capacity is kept.
  std::vector<TrackedNiche> niches;
  std::vector<NicheEvent> events;
  bool niches_cut = false;  ///< more niches were known than the largest count allows
  /// The list is proven to be every niche up to the cutoff: level `certified`, and nothing cut it short.
  bool niches_complete = false;
  std::uint32_t niches_beyond_cutoff = 0;
  std::uint64_t cycle = 0;
  bool warm = false;
  /// The genetic search has missed a niche, seen in this warm cycle. At `certified`: a niche listed is new
  /// and the search has not proposed it (NicheOrigin::FromCones or Proven). At `nodes` and `refined`, where
  /// only later cycles show it: the distance is less than the last cycle's nearest niche can have come to.
  bool search_miss = false;
  std::uint64_t seed = 0;
  SearchCost cost;             ///< of the genetic search, and how much of it ran
  CertificateCost proof_cost;  ///< of level `certified`
  double solve_seconds = kNotComputed;
  StageTimes stages;  ///< their sum is solve_seconds but for the frame around them
};

}  // namespace concave_distance
