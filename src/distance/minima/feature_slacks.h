#pragma once

#include "feature_body.h"
#include "feature_pairs.h"
#include "slack_offers.h"

namespace concave_distance::detail {

/// Finds how far the bodies may move until a pair of features that holds no local minimum can hold one
/// (doc/proofs.md).
class FeatureSlacks {
 public:
  explicit FeatureSlacks(const FeaturePairs& pairs) : pairs_(pairs) {}

  /// Offers slacks, each of which keeps the pair without a minimum until it is used up. Offers none where the
  /// answer may change at once.
  void offer(const FeatureBody::Item& a, const FeatureBody::Item& b, SlackOffers& offers) const;

 private:
  using Item = FeatureBody::Item;

  void offerVertexToVertex(const Item& a, const Item& b, SlackOffers& offers) const;
  void offerVertexToEdge(const FeatureBody& of_vertex, const Item& vertex, const FeatureBody& of_edge,
                         const Item& edge, SlackOffers& offers) const;
  void offerBesideEdge(const FeatureBody& of_edge, const Item& edge, const Eigen::Vector3d& first,
                       const Eigen::Vector3d& last, double radius, SlackOffers& offers) const;
  void offerVertexToFace(const FeatureBody& of_vertex, const Item& vertex, const FeatureBody& of_face,
                         const Item& face, SlackOffers& offers) const;
  void offerEdgeToEdge(const Item& a, const Item& b, SlackOffers& offers) const;

  const FeaturePairs& pairs_;
};

}  // namespace concave_distance::detail
