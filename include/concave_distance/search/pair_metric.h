#pragma once

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"

namespace concave_distance {

/// Delta of two trial points: the sum of both mesh distances (Carretero, eq. (4.5)). One per thread.
class PairMetric {
 public:
  PairMetric(const BodyMesh& a, const BodyMesh& b) : a_(a.metric()), b_(b.metric()) {}
  /// Delta when at most `bound`, else infinity. Metres.
  double distanceWithin(const TrialPoint& x, const TrialPoint& y, double bound);
  MeshMetricQuery& onA() { return a_; }
  MeshMetricQuery& onB() { return b_; }
  std::size_t memoryBytes() const { return a_.memoryBytes() + b_.memoryBytes(); }

 private:
  MeshMetricQuery a_;
  MeshMetricQuery b_;
};

}  // namespace concave_distance
