#pragma once

#include <Eigen/Core>
#include <optional>

#include "cone_motion.h"
#include "distance/kernels/minimum_candidate.h"
#include "distance/kernels/pair_frame.h"
#include "mesh/trees/normal_cone_tree.h"

namespace concave_distance::detail {

/// Sine of the angle between edges below which the direction across them is not believed.
inline constexpr double kNearlyParallel = 1e-6;

/// Whether the closest points of two features are a local minimum of the distance over both surfaces, and if
/// not, how far the bodies may move until they can be.
class FeaturePairs {
 public:
  using Item = NormalConeTree::Item;

  /// @param cutoff metres; minima up to this are wanted
  FeaturePairs(const PairFrame& frame, double cutoff);

  /// Metres, of points and distances: what rounding may make of them.
  double slack() const { return slack_; }
  double cutoff() const { return cutoff_; }

  /// Whether a pair of these kinds can hold a minimum: what faces have in common with faces or edges ends at
  /// a vertex or an edge of one of them.
  static bool isWanted(NormalConeTree::Kind l, NormalConeTree::Kind r) {
    using Kind = NormalConeTree::Kind;
    return l == Kind::Vertex || r == Kind::Vertex || (l == Kind::Edge && r == Kind::Edge);
  }

  /// The closest points, if they may be a local minimum up to the cutoff. Pairs that meet are none.
  std::optional<MinimumCandidate> findMinimum(const Item& a, const Item& b) const;

  /// The same minimum at a pose for which offerStay() holds.
  MinimumCandidate moved(const Item& a, const Item& b, const MinimumCandidate& minimum) const;

  /// For a pair that holds a minimum: offers a slack for which it stays one, on the same features. False
  /// where there is none.
  bool offerStay(const Item& a, const Item& b, const MinimumCandidate& minimum, SlackOffers& offers) const;

  /// For a pair that holds none: offers slacks, each of which keeps it so until it is used up. None is
  /// offered where the answer may change at once.
  void offerSlacks(const Item& a, const Item& b, SlackOffers& offers) const;

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
  struct Body;

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
  Eigen::Vector3d edgeOfA(const Item& item) const;
  Eigen::Vector3d edgeOfB(const Item& item) const;
  Between closest(const Item& a, const Item& b) const;

  void offerVertexToVertex(const Item& a, const Item& b, SlackOffers& offers) const;
  void offerVertexToEdge(const Body& of_vertex, const Item& vertex, const Body& of_edge, const Item& edge,
                         SlackOffers& offers) const;
  void offerBesideEdge(const Body& of_edge, const Item& edge, const Eigen::Vector3d& first,
                       const Eigen::Vector3d& last, double radius, SlackOffers& offers) const;
  void offerVertexToFace(const Body& of_vertex, const Item& vertex, const Body& of_face, const Item& face,
                         SlackOffers& offers) const;
  double fallAround(const Body& body, const Item& item, const Eigen::Vector3d& displacement) const;
  void offerStayOfVertex(const Body& of_vertex, const Item& vertex, const Body& of_other, const Item& other,
                         const Eigen::Vector3d& to_other, SlackOffers& offers) const;
  void offerStayOfEdges(const Body& body_a, const Item& a, const Body& body_b, const Item& b,
                        const Eigen::Vector3d& displacement, SlackOffers& offers) const;
  void offerEdgeToEdge(const Item& a, const Item& b, SlackOffers& offers) const;

  const PairFrame& frame_;
  double slack_;
  double level_;  ///< metres; heights within this may be equal
  double cutoff_;
};

}  // namespace concave_distance::detail
