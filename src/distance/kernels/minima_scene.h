#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "base/side.h"
#include "concave_distance/mesh/body_mesh.h"
#include "facet_points.h"
#include "local_frames.h"
#include "mesh/surface/facets.h"
#include "mesh/trees/shell_contacts.h"
#include "minimum_candidate.h"

namespace concave_distance::detail {

/// Both surfaces at one pose in one recentred frame, with the rounding that distances in it carry.
struct MinimaScene {
  MinimaScene(const BodyMesh& body_a, const BodyMesh& body_b, const Eigen::Isometry3d& pose)
      : a(body_a),
        b(body_b),
        facets_a(body_a.facets()),
        facets_b(body_b.facets()),
        adjacency_a(body_a.adjacency()),
        adjacency_b(body_b.adjacency()),
        pieces_a(body_a.pieces()),
        pieces_b(body_b.pieces()),
        a_from_b(pose),
        frames(body_a.surface().boundingBox().center(), body_b.surface().boundingBox().center(), pose) {
    size = 0.5 * (a.diameter() + b.diameter()) + frames.offset.norm();
    rounding = kTriangleDistanceError * size;
  }

  /// A vertex, or an end of a joint of shells (joinedAdjacency()), in the body's axes, relative to its
  /// centre.
  Eigen::Vector3d ownVertex(Side side, NodeIndex node) const {
    const BodyMesh& body = side == Side::A ? a : b;
    const Eigen::Vector3d& centre = side == Side::A ? frames.centre_a : frames.centre_b;
    const std::size_t count = body.surface().vertexCount();
    if (node.value < count) return body.surface().vertex(node) - centre;
    const std::size_t end = node.value - count;
    const ShellContacts::Joint& joint = body.shellContacts().joints[end / 2];
    return (end % 2 == 0 ? joint.from : joint.to) - centre;
  }
  /// False where one of them lies in the material of another shell of its body.
  bool areOnSurface(TriangleIndex of_a, TriangleIndex of_b) const {
    return !a.shellContacts().isHidden(of_a) && !b.shellContacts().isHidden(of_b);
  }
  /// Whether shells of either body meet.
  bool hasJoints() const { return !a.shellContacts().joints.empty() || !b.shellContacts().joints.empty(); }
  static bool isJoint(const BodyMesh& body, const AdjacentTriangle& next) {
    return next.from.value >= body.surface().vertexCount();
  }
  Eigen::Vector3d vertexOfA(NodeIndex node) const { return a.surface().vertex(node) - frames.centre_a; }
  Eigen::Vector3d vertexOfB(NodeIndex node) const {
    return frames.rotation * (b.surface().vertex(node) - frames.centre_b) + frames.offset;
  }
  /// The facet pair of a triangle pair: the facets, each named by its first triangle.
  TrianglePair facetPairOf(TriangleIndex of_a, TriangleIndex of_b) const {
    return {facets_a.facet_of_triangle[of_a.value], facets_b.facet_of_triangle[of_b.value]};
  }
  FacetPoints facetOfA(TriangleIndex facet) const {
    const std::array<NodeIndex, 4>& nodes = facets_a.nodes[facet.value];
    return {{vertexOfA(nodes[0]), vertexOfA(nodes[1]), vertexOfA(nodes[2]), vertexOfA(nodes[3])},
            facets_a.isQuad(facet)};
  }
  FacetPoints facetOfB(TriangleIndex facet) const {
    const std::array<NodeIndex, 4>& nodes = facets_b.nodes[facet.value];
    FacetPoints points{{vertexOfB(nodes[0]), vertexOfB(nodes[1]), vertexOfB(nodes[2])},
                       facets_b.isQuad(facet)};
    points.corners[3] = points.is_quad ? vertexOfB(nodes[3]) : points.corners[0];
    return points;
  }
  /// Finds the closest triangles of a facet pair and their distance.
  std::pair<TrianglePair, TrianglePairDistance> closestIn(const TrianglePair& facet_pair) const {
    const FacetPairDistance found = facetDistance(facetOfA(facet_pair.a), facetOfB(facet_pair.b));
    return {{found.is_in_second_of_a ? facets_a.second[facet_pair.a.value] : facet_pair.a,
             found.is_in_second_of_b ? facets_b.second[facet_pair.b.value] : facet_pair.b},
            found.closest};
  }
  TrianglePoints cornersOfA(TriangleIndex t) const { return frames.cornersOfA(a, t); }
  TrianglePoints cornersOfB(TriangleIndex t) const { return frames.cornersOfB(b, t); }

  WitnessPair witnessOf(const MinimumCandidate& seed) const {
    return {(seed.point_b - seed.point_a).squaredNorm(),
            seed.point_a + frames.centre_a,
            seed.point_b + frames.centre_a,
            seed.a,
            seed.b,
            seed.feature_a,
            seed.feature_b};
  }
  MinimumCandidate seedOf(const WitnessPair& witness) const {
    return {witness.triangle_a,
            witness.triangle_b,
            std::sqrt(witness.squared_distance),
            true,
            false,
            witness.feature_a,
            witness.feature_b,
            witness.point_a_in_a - frames.centre_a,
            witness.point_b_in_a - frames.centre_a};
  }

  const BodyMesh& a;
  const BodyMesh& b;
  const Facets& facets_a;  ///< of the bodies, which build it on demand, as the following
  const Facets& facets_b;
  const CompressedRows<AdjacentTriangle>& adjacency_a;
  const CompressedRows<AdjacentTriangle>& adjacency_b;
  const ConnectedPieces& pieces_a;
  const ConnectedPieces& pieces_b;
  Eigen::Isometry3d a_from_b;
  LocalFrames frames;
  double size;      ///< no coordinate is larger
  double rounding;  ///< metres, of a distance between triangles
};

}  // namespace concave_distance::detail
