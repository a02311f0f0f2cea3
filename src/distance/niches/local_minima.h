#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"
#include "distance/kernels/minimum_candidate.h"
#include "distance/kernels/pair_frame.h"
#include "distance/minima/local_minima_cost.h"
#include "niche_properties.h"
#include "niche_rule.h"

namespace concave_distance {

namespace detail {
struct LocalMinimaParts;
}  // namespace detail

struct LocalMinimaRequest {
  double cutoff = std::numeric_limits<double>::infinity();  ///< metres; niches up to this are wanted
  /// Where it measures prominences, the search around each niche goes on until it reaches a nearer place, the
  /// rule's limit or the cutoff.
  NicheRule rule;
  std::size_t largest_count = std::numeric_limits<std::size_t>::max();  ///< the nearest are kept
  /// Niches through the material of closed shells are listed, too, flagged.
  bool through_material = false;
  /// Niches whose segment meets a triangle are listed, too, flagged. Others cost nothing but the look.
  bool hidden = true;
  /// Local minima that are known, instead of all there are; nullptr: all are looked for.
  const std::vector<MinimumCandidate>* given = nullptr;
  /// The list is known to hold one niche, this one, or none where this is nullptr: nothing is looked for.
  struct Known {
    const MinimumCandidate* niche;
  };
  std::optional<Known> known;
  /// The closest points, where every other niche has an end beside a dent of its nearly convex body
  /// (ConvexNiches::TheNearestAndDents); nullptr: niches may be anywhere.
  const MinimumCandidate* nearest_beside_dents = nullptr;
  /// Triangle pairs whose niches are asked for (LocalMinima::owners), e.g. those that a search has found:
  /// descended to the local minimum around them.
  std::vector<std::pair<TriangleIndex, TriangleIndex>> asked_pairs;
  std::vector<std::uint64_t> asked_basins;  ///< LocalMinimum::basin of each, or empty
  /// Minima that a search has found. Niches that come from them say so (LocalMinimum::proposal). Where the
  /// limit ends the search for all minima, they are judged with what was found.
  std::vector<MinimumCandidate> proposals;
  /// True when what proves the answer is to be kept for the next pose.
  bool is_tracked = false;
  /// Metres; no two points are closer than this. Above 0, bodies that meet are not looked for.
  double certain_distance = 0.0;
  /// Shares of the limit's time (WorkLimit::allowShare) after which a step ends.
  struct TimeShares {
    double search = 1.0;    ///< for all minima
    double searches = 1.0;  ///< for the decision which of them are niches
    double all = 1.0;
  };
  TimeShares time_shares;
  /// A long search that time has ended is finished before anything else; until it is, nothing is decided.
  bool finishes_searches = false;
  /// When it is reached, the niches decided so far are the result (LocalMinima::finished); nullptr: none.
  WorkLimit* limit = nullptr;
};

/// Keeps what one call of findLocalMinima() leaves to the next one for the same bodies at a pose nearby.
class LocalMinimaMemory {
 public:
  LocalMinimaMemory();
  ~LocalMinimaMemory();
  LocalMinimaMemory(LocalMinimaMemory&&) noexcept;
  LocalMinimaMemory& operator=(LocalMinimaMemory&&) noexcept;

  void clear();
  detail::LocalMinimaParts& parts();

 private:
  std::unique_ptr<detail::LocalMinimaParts> parts_;  ///< made when first needed
};

/// A niche (doc/algorithm.md, section 1): a connected set of point pairs at one distance, none near it
/// closer.
struct LocalMinimum {
  double distance = 0.0;  ///< metres
  WitnessPair witness;    ///< for segments and patches the middle of the set (NicheExtent::representative)
  NicheKind kind = NicheKind::Point;
  double extent = 0.0;  ///< metres, NicheExtent::length
  Outwardness outward = Outwardness::Outward;
  bool visible = true;
  /// Distance at the lowest pass to a deeper niche, divided by the own distance, minus 1. Infinite when no
  /// deeper niche is reached below `searched`, and where the distance is 0.
  double prominence = std::numeric_limits<double>::infinity();
  double searched = 0.0;    ///< metres: passes up to this were looked for
  std::uint64_t basin = 0;  ///< if tracked: the same from pose to pose while the niche stands; 0: none
  static constexpr std::size_t kNoProposal = std::numeric_limits<std::size_t>::max();
  std::size_t proposal = kNoProposal;  ///< the first of LocalMinimaRequest::proposals that leads to it
};

struct LocalMinima {
  static constexpr std::size_t kNoOwner = std::numeric_limits<std::size_t>::max();
  std::vector<LocalMinimum> niches;  ///< ascending by distance
  bool cut = false;                  ///< there are more than largest_count
  bool finished = true;              ///< false: the limit was reached, niches may be missing
  static constexpr std::size_t kUndecided = kNoOwner - 1;
  /// For each of LocalMinimaRequest::asked_pairs the niche that it belongs to; kUndecided when the limit was
  /// reached before that was seen, kNoOwner when that is none of
  /// the result (farther than the cutoff, through material, cut).
  std::vector<std::size_t> owners;
  LocalMinimaCost cost;
};

/// Every local minimum of |p - q| over both original surfaces with a distance of at most the cutoff and the
/// least prominence: none is missed, none invented, up to the error of the triangle kernel in coordinates of
/// the bodies' size (minima whose pass is higher by less than that are one). How and why: doc/proofs.md.
/// Bodies about 2 / (least prominence) times their size apart have one niche for each pair of
/// shells, found without looking through their features. Where the bodies meet, every connected part
/// of their overlap is one niche of distance 0. Outward niches of open shells include those marked Unknown.
/// Uses the bodies' normalCones(). Never throws.
LocalMinima findLocalMinima(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                            const LocalMinimaRequest& request);

/// The same from pose to pose, with the buffers and, if the request says so, the knowledge of the last call.
void findLocalMinima(const detail::PairFrame& frame, const LocalMinimaRequest& request,
                     LocalMinimaMemory& memory, LocalMinima& result);

/// Says of the niches of a result which of request.proposals lead to them, for proposals that came after the
/// list: where everything was looked at they change nothing else. At the pose of the last findLocalMinima()
/// with this memory.
void attributeProposals(const detail::PairFrame& frame, const LocalMinimaRequest& request,
                        LocalMinimaMemory& memory, LocalMinima& result);

}  // namespace concave_distance
