#pragma once

#include <Eigen/Core>
#include <optional>

#include "distance/kernels/minimum_candidate.h"
#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// Decides whether the closest points of two features are a local minimum of the distance over both surfaces.
class FeaturePairs {
 public:
  using Item = NormalConeTree::Item;

  /// @param cutoff metres; minima up to this are wanted
  FeaturePairs(const PairFrame& frame, double cutoff);

  const PairFrame& frame() const { return frame_; }
  /// Returns the rounding of points and distances, metres.
  double slack() const { return slack_; }
  /// Heights within this may be equal, metres.
  double level() const { return level_; }
  double cutoff() const { return cutoff_; }

  /// Returns whether a pair of these kinds can hold a minimum: what faces have in common with faces or edges
  /// ends at a vertex or an edge of one of them.
  static bool isWanted(NormalConeTree::Kind l, NormalConeTree::Kind r) {
    using Kind = NormalConeTree::Kind;
    return l == Kind::Vertex || r == Kind::Vertex || (l == Kind::Edge && r == Kind::Edge);
  }

  /// Returns the closest points if they may be a local minimum up to the cutoff. Pairs that meet are none.
  std::optional<MinimumCandidate> findMinimum(const Item& a, const Item& b) const;

  /// Measures the same minimum at a pose for which a slack of MinimumSlacks holds.
  MinimumCandidate moved(const Item& a, const Item& b, const MinimumCandidate& minimum) const;

  /// Returns the squared distance of two segments, metres^2.
  double squaredDistance(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
                         const Eigen::Vector3d& b1) const {
    return betweenSegments(a0, a1, b0, b1).squared_distance;
  }

 private:
  struct Between {
    Eigen::Vector3d from;  ///< A's closest point
    Eigen::Vector3d to;    ///< B's
    Eigen::Vector3d displacement;
    double squared_distance;
    /// The foot lies beyond the end of an edge or the border of a face by more than its error: what is there
    /// has the minimum, if there is one.
    bool is_beyond;
    /// Radians that the displacement may be off by, besides the error of its ends over the distance.
    double direction_error = 0.0;
  };
  struct FacingCap;

  static Between between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, bool is_beyond = false,
                         double direction_error = 0.0);
  Between betweenSegments(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1, const Eigen::Vector3d& b0,
                          const Eigen::Vector3d& b1) const;
  bool edgesMayFace(const Item& a, const Item& b, const FacingCap& cap_a, const FacingCap& cap_b) const;
  /// A point of a body as the foremost one of its surroundings.
  struct Peak {
    bool is_peak;
    int level_dimensions;  ///< of what is as far forward: 0: the point alone, 1: an edge, 2: perhaps more
    Feature feature;
  };
  /// @param point, direction in the body's axes, relative to its centre in the frame
  /// @param turn radians that the direction may be off by
  Peak peakAt(Side side, const Item& item, const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
              double turn) const;
  Between closest(const Item& a, const Item& b) const;

  const PairFrame& frame_;
  double slack_;
  double level_;
  double cutoff_;
};

}  // namespace concave_distance::detail
