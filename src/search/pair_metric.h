#pragma once

#include <optional>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"

namespace concave_distance {

/// Delta of two trial points: the sum of both mesh distances (Carretero, eq. (4.5)). One per thread. The
/// bodies' metrics are made at its first use.
class PairMetric {
 public:
  PairMetric(const BodyMesh& a, const BodyMesh& b) : a_{&a, {}}, b_{&b, {}} {}
  /// Delta when at most `bound`, else infinity. Metres.
  double distanceWithin(const TrialPoint& x, const TrialPoint& y, double bound);
  MeshMetricQuery& onA() { return a_.query(); }
  MeshMetricQuery& onB() { return b_.query(); }

 private:
  struct Side {
    const BodyMesh* body;
    std::optional<MeshMetricQuery> made;

    MeshMetricQuery& query() {
      if (!made) made.emplace(gridOf(*body).metric());
      return *made;
    }
  };
  Side a_;
  Side b_;
};

}  // namespace concave_distance
