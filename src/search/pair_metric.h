#pragma once

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/trial_point.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"

namespace concave_distance {

/// Delta of two trial points: the sum of both mesh distances (Carretero, eq. (4.5)). The bodies' metrics are
/// made at its first use.
class PairMetric {
 public:
  PairMetric(const BodyMesh& a, const BodyMesh& b) : a_{&a}, b_{&b} {}
  /// Metres; infinity between shells.
  double distance(const TrialPoint& x, const TrialPoint& y) {
    return onA().distance(x.node_a, y.node_a) + onB().distance(x.node_b, y.node_b);
  }
  const MeshMetric& onA() { return a_.made(); }
  const MeshMetric& onB() { return b_.made(); }

 private:
  struct Side {
    const BodyMesh* body;
    const MeshMetric* metric = nullptr;

    const MeshMetric& made() {
      if (metric == nullptr) metric = &gridOf(*body).metric();
      return *metric;
    }
  };
  Side a_;
  Side b_;
};

}  // namespace concave_distance
