#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/side.h"
#include "concave_distance/mesh/body_mesh.h"
#include "facet_points.h"
#include "mesh/surface/facets.h"
#include "mesh/trees/shell_contacts.h"
#include "minimum_candidate.h"
#include "witness_refinement.h"

namespace concave_distance::detail {

inline TrianglePoints localCorners(const SurfaceMesh& mesh, TriangleIndex triangle,
                                   const Eigen::Vector3d& centre) {
  return {mesh.corner(triangle, 0) - centre, mesh.corner(triangle, 1) - centre,
          mesh.corner(triangle, 2) - centre};
}

/// Says where both bodies of a pair are in this cycle: A's coordinates relative to a point of A, B's relative
/// to a point of B and turned into A's axes. What is lost to rounding is relative to the geometry at hand
/// and, once for the two bodies as a whole, to the translation that came in.
struct PairFrame {
  PairFrame(const BodyMesh& body_a, const BodyMesh& body_b, const Eigen::Isometry3d& pose,
            const Eigen::Vector3d& centre_in_a, const Eigen::Vector3d& centre_in_b)
      : a(body_a),
        b(body_b),
        a_from_b(pose),
        centre_a(centre_in_a),
        centre_b(centre_in_b),
        rotation(pose.linear()),
        offset(pose * centre_in_b - centre_in_a) {}
  /// Is centred at the middles of the bodies' boxes, for what looks at whole surfaces.
  PairFrame(const BodyMesh& body_a, const BodyMesh& body_b, const Eigen::Isometry3d& pose)
      : PairFrame(body_a, body_b, pose, body_a.surface().boundingBox().center(),
                  body_b.surface().boundingBox().center()) {}
  /// Is centred at the first corners of two triangles, for what looks at the surfaces around them.
  PairFrame(const BodyMesh& body_a, const BodyMesh& body_b, const Eigen::Isometry3d& pose,
            TriangleIndex triangle_a, TriangleIndex triangle_b)
      : PairFrame(body_a, body_b, pose, body_a.surface().corner(triangle_a, 0),
                  body_b.surface().corner(triangle_b, 0)) {}
  /// Returns a frame with the surfaces' facets open.
  static PairFrame withFacets(const BodyMesh& body_a, const BodyMesh& body_b, const Eigen::Isometry3d& pose) {
    PairFrame frame(body_a, body_b, pose);
    frame.openFacets();
    return frame;
  }

  /// Looks up facets, neighbours and pieces, which the bodies make on demand: local minima need them, the
  /// distance alone does not.
  void openFacets() {
    facets_a = &a.facets();
    facets_b = &b.facets();
    adjacency_a = &a.adjacency();
    adjacency_b = &b.adjacency();
    pieces_a = &a.pieces();
    pieces_b = &b.pieces();
    size = 0.5 * (a.diameter() + b.diameter()) + offset.norm();
    rounding = kTriangleDistanceError * size;
  }

  Eigen::Isometry3d bFromA() const { return a_from_b.inverse(Eigen::Isometry); }
  double diameters() const { return a.diameter() + b.diameter(); }
  /// Surfaces nearer than this (m) touch, for all that the kernels and the pose tell.
  double touchingDistance() const { return 4.0 * rounding + 2.0 * pose_error; }
  /// Two refined witnesses nearer than this (m) on both bodies are one. It is far above the rounding of the
  /// kernels and far below any feature.
  double samePlaceTolerance() const { return 1e-7 * diameters(); }

  TrianglePoints cornersOfA(TriangleIndex t) const { return localCorners(a.surface(), t, centre_a); }
  TrianglePoints cornersOfB(TriangleIndex t) const {
    const TrianglePoints in_b = localCorners(b.surface(), t, centre_b);
    return {rotation * in_b[0] + offset, rotation * in_b[1] + offset, rotation * in_b[2] + offset};
  }
  Eigen::Vector3d vertexOfA(NodeIndex node) const { return a.surface().vertex(node) - centre_a; }
  Eigen::Vector3d vertexOfB(NodeIndex node) const {
    return rotation * (b.surface().vertex(node) - centre_b) + offset;
  }
  /// Returns a point of this frame in B's axes, relative to centre_b.
  Eigen::Vector3d pointInB(const Eigen::Vector3d& point) const {
    return rotation.transpose() * (point - offset);
  }
  /// Returns a vertex, or an end of a joint of shells (joinedAdjacency()), in the body's axes, relative to
  /// its centre.
  Eigen::Vector3d ownVertex(Side side, NodeIndex node) const {
    const BodyMesh& body = side == Side::A ? a : b;
    const Eigen::Vector3d& centre = side == Side::A ? centre_a : centre_b;
    const std::size_t count = body.surface().vertexCount();
    if (node.value < count) return body.surface().vertex(node) - centre;
    const std::size_t end = node.value - count;
    const ShellContacts::Joint& joint = body.shellContacts().joints[end / 2];
    return (end % 2 == 0 ? joint.from : joint.to) - centre;
  }

  /// Returns false where one of them lies in the material of another shell of its body.
  bool areOnSurface(TriangleIndex of_a, TriangleIndex of_b) const {
    return !a.shellContacts().isHidden(of_a) && !b.shellContacts().isHidden(of_b);
  }
  /// Returns whether shells of either body meet.
  bool hasJoints() const { return !a.shellContacts().joints.empty() || !b.shellContacts().joints.empty(); }
  static bool isJoint(const BodyMesh& body, const AdjacentTriangle& next) {
    return next.from.value >= body.surface().vertexCount();
  }

  /// Returns the facet pair of a triangle pair: its facets, each named by its first triangle.
  TrianglePair facetPairOf(TriangleIndex of_a, TriangleIndex of_b) const {
    return {facets_a->facet_of_triangle[of_a.value], facets_b->facet_of_triangle[of_b.value]};
  }
  FacetPoints facetOfA(TriangleIndex facet) const {
    const std::array<NodeIndex, 4>& nodes = facets_a->nodes[facet.value];
    return {{vertexOfA(nodes[0]), vertexOfA(nodes[1]), vertexOfA(nodes[2]), vertexOfA(nodes[3])},
            facets_a->isQuad(facet)};
  }
  FacetPoints facetOfB(TriangleIndex facet) const {
    const std::array<NodeIndex, 4>& nodes = facets_b->nodes[facet.value];
    FacetPoints points{{vertexOfB(nodes[0]), vertexOfB(nodes[1]), vertexOfB(nodes[2])},
                       facets_b->isQuad(facet)};
    points.corners[3] = points.is_quad ? vertexOfB(nodes[3]) : points.corners[0];
    return points;
  }
  /// Finds the closest triangles of a facet pair and their distance.
  std::pair<TrianglePair, TrianglePairDistance> closestIn(const TrianglePair& facet_pair) const {
    const FacetPairDistance found = facetDistance(facetOfA(facet_pair.a), facetOfB(facet_pair.b));
    return {{found.is_in_second_of_a ? facets_a->second[facet_pair.a.value] : facet_pair.a,
             found.is_in_second_of_b ? facets_b->second[facet_pair.b.value] : facet_pair.b},
            found.closest};
  }

  WitnessRefinement refine(TriangleIndex of_a, TriangleIndex of_b, RefinementWorkspace& workspace) const {
    return refineWitness(a, b, a_from_b, of_a, of_b, workspace);
  }
  WitnessPair toWitness(const TrianglePairDistance& local, TriangleIndex of_a, TriangleIndex of_b) const {
    return {local.squared_distance, local.point_a + centre_a, local.point_b + centre_a, of_a, of_b,
            local.feature_a,        local.feature_b};
  }
  WitnessPair witnessOf(const MinimumCandidate& candidate) const {
    return {(candidate.point_b - candidate.point_a).squaredNorm(),
            candidate.point_a + centre_a,
            candidate.point_b + centre_a,
            candidate.a,
            candidate.b,
            candidate.feature_a,
            candidate.feature_b};
  }
  MinimumCandidate candidateOf(const WitnessPair& witness) const {
    return {witness.triangle_a,
            witness.triangle_b,
            std::sqrt(witness.squared_distance),
            true,
            false,
            witness.feature_a,
            witness.feature_b,
            witness.point_a_in_a - centre_a,
            witness.point_b_in_a - centre_a};
  }

  const BodyMesh& a;
  const BodyMesh& b;
  Eigen::Isometry3d a_from_b;
  Eigen::Vector3d centre_a;
  Eigen::Vector3d centre_b;
  Eigen::Matrix3d rotation;  ///< of a_from_b
  Eigen::Vector3d offset;    ///< of centre_b, in this frame
  /// Known after openFacets(), as the following; metres. No coordinate is larger where the centres are the
  /// boxes'.
  double size = 0.0;
  double rounding = 0.0;    ///< metres, of a distance between triangles
  double pose_error = 0.0;  ///< metres, how far B as a whole may be off
  const Facets* facets_a = nullptr;
  const Facets* facets_b = nullptr;
  const CompressedRows<AdjacentTriangle>* adjacency_a = nullptr;
  const CompressedRows<AdjacentTriangle>* adjacency_b = nullptr;
  const ConnectedPieces* pieces_a = nullptr;
  const ConnectedPieces* pieces_b = nullptr;
};

/// Returns the largest magnitude of a coordinate: what the kernel's error bounds are relative to.
inline double largestMagnitude(const TrianglePoints& a, const TrianglePoints& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max({largest, a[k].cwiseAbs().maxCoeff(), b[k].cwiseAbs().maxCoeff()});
  }
  return largest;
}

}  // namespace concave_distance::detail
