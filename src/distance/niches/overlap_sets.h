#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/side.h"
#include "base/union_find.h"
#include "distance/kernels/pair_frame.h"
#include "facet_line.h"
#include "meeting_pairs.h"

namespace concave_distance::detail {

/// Finds which meeting pairs lie on one connected part of the bodies' overlap (doc/proofs.md, "Connected
/// parts of an overlap"): along the curves where the surfaces meet, over the pieces of each surface in the
/// other body, and across the overlap's inside. Each step is taken only while there is more than one set.
/// Buffers of one thread, cleared and never freed.
class OverlapSets {
 public:
  /// The frame and the pairs must live until the last call for this pose.
  /// @return false when the limit was reached: what is one part may be several sets
  bool join(const PairFrame& frame, const MeetingPairs& met, WorkLimit& limit);
  /// Joins the sets of two pairs that are known to be of one part.
  void unite(std::uint32_t l, std::uint32_t r);

  /// Returns how many numbers the sets hold: those of all pairs, unless memory was refused.
  std::size_t size() const { return sets_.size(); }
  /// Returns the representative, a pair, of the set that holds a pair.
  std::uint32_t setOf(std::uint32_t pair) { return sets_.find(pair); }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  /// Parts of a line that are apart by no more than so many tolerances meet: what is between them cannot be
  /// told to be inside or outside.
  static constexpr double kLeastGap = 4.0;

  /// A facet that meets the other body: its pairs in Surface::pairs.
  struct MetFacet {
    TriangleIndex facet;
    std::uint32_t first;
    std::uint32_t last;
  };
  /// A mark holds what was found out at a pose, that of its stamp.
  struct Mark {
    std::uint32_t stamp = 0;
    std::uint32_t value = 0;
  };
  /// One body's surface and its pieces in the other body, each the element of `sets_` that its vertices have.
  struct Surface {
    std::vector<std::uint32_t> pairs;  ///< by facet
    std::vector<MetFacet> met;
    UnionFind clusters;              ///< pairs that hang together within one facet
    std::vector<Mark> vertices;      ///< value: element, or kNone outside the other body
    std::vector<Mark> facets;        ///< value: index in `met`, or kNone for one that is wholly inside
    std::vector<NodeIndex> waiting;  ///< vertices that are inside, to go on from
    std::uint32_t stamp = 0;
    bool may_be_inside = false;  ///< the other body has material
  };
  struct Hit {
    LinePart part;
    std::uint32_t pair;
  };
  /// Where a ray meets a surface.
  struct RayHit {
    double at;  ///< metres
    Side side;
    TriangleIndex triangle;
  };

  bool joinCurves();
  void joinNeighbours(Side side, std::uint32_t pair);
  void begin(Side side);
  static void reserve(std::vector<Mark>& marks, std::size_t count);
  bool joinAlongEdges(Side side);
  bool joinInFacets(Side side);
  bool joinOverJoints(Side side, TriangleIndex facet, bool is_met);
  bool spread(Side side);
  bool joinThroughInside();
  bool joinAlongRay(std::uint32_t pair);

  /// Puts where a line in a met facet meets the other body into hits_, in order.
  /// @param edge of the facet that the line is, or -1
  void collectHits(Side side, const MetFacet& met, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                   int edge);
  /// Joins pairs that follow each other along the line of hits_, where what is between them is inside.
  void joinHits(Side side, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  /// Joins the first and the last of hits_ with the ends of their line that are inside.
  void joinEnds(Side side, std::optional<NodeIndex> from, NodeIndex to, double length);
  /// Returns the element of the piece that holds a point of a facet inside the other body.
  std::uint32_t elementAt(Side side, TriangleIndex facet, const Eigen::Vector3d& point);
  std::uint32_t markInside(Side side, NodeIndex vertex);
  void markOutside(Side side, NodeIndex vertex) {
    Mark& mark = at(side).vertices[vertex.value];
    if (mark.stamp != at(side).stamp) mark = {at(side).stamp, kNone};
  }
  bool isInside(Side side, NodeIndex vertex);
  /// Returns whether a point, frame's coordinates, lies in the material of the body `of`.
  bool holds(Side of, const Eigen::Vector3d& point) const;
  /// Returns a point of a pair on the surface of one body, in the frame's coordinates.
  Eigen::Vector3d pointOf(Side side, std::uint32_t pair) const;
  Eigen::Vector3d inBody(Side side, const Eigen::Vector3d& point) const {
    if (side == Side::A) return point + frame_->centre_a;
    return frame_->pointInB(point) + frame_->centre_b;
  }

  static Side otherOf(Side side) { return side == Side::A ? Side::B : Side::A; }
  Surface& at(Side side) { return surfaces_[side == Side::A ? 0 : 1]; }
  const BodyMesh& body(Side side) const { return side == Side::A ? frame_->a : frame_->b; }
  const Facets& facets(Side side) const { return side == Side::A ? *frame_->facets_a : *frame_->facets_b; }
  FacetPoints facetPoints(Side side, TriangleIndex facet) const {
    return side == Side::A ? frame_->facetOfA(facet) : frame_->facetOfB(facet);
  }
  TriangleIndex facetIn(Side side, std::uint32_t pair) const {
    return side == Side::A ? met_->pairs()[pair].a : met_->pairs()[pair].b;
  }

  const PairFrame* frame_ = nullptr;
  const MeetingPairs* met_ = nullptr;
  WorkLimit* limit_ = nullptr;
  double tolerance_ = 0.0;
  UnionFind sets_;         ///< pairs first, then pieces
  std::size_t count_ = 0;  ///< sets with pairs
  std::array<Surface, 2> surfaces_;
  std::vector<Hit> hits_;
  std::vector<RayHit> ray_hits_;
  std::vector<char> is_hole_;  ///< by pair that stands for a cluster: no edge of the facet meets it
};

}  // namespace concave_distance::detail
