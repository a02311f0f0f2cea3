#pragma once

#include "feature_body.h"
#include "feature_pairs.h"
#include "slack_offers.h"

namespace concave_distance::detail {

/// Finds how far the bodies may move while a pair of features stays a local minimum (doc/proofs.md).
class MinimumSlacks {
 public:
  explicit MinimumSlacks(const FeaturePairs& pairs) : pairs_(pairs) {}

  /// Offers a slack for which the pair stays a minimum, on the same features. Returns false where there is
  /// none.
  bool offer(const FeatureBody::Item& a, const FeatureBody::Item& b, const MinimumCandidate& minimum,
             SlackOffers& offers) const;

 private:
  using Item = FeatureBody::Item;

  double fallAround(const FeatureBody& body, const Item& item, const Eigen::Vector3d& displacement) const;
  void offerOfVertex(const FeatureBody& of_vertex, const Item& vertex, const FeatureBody& of_other,
                     const Item& other, const Eigen::Vector3d& to_other, SlackOffers& offers) const;
  void offerOfEdges(const FeatureBody& body_a, const Item& a, const FeatureBody& body_b, const Item& b,
                    const Eigen::Vector3d& displacement, SlackOffers& offers) const;

  const FeaturePairs& pairs_;
};

}  // namespace concave_distance::detail
