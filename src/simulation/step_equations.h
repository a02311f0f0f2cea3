#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/union_find.h"
#include "coupling.h"

namespace concave_distance::detail {

/// The linear equations of a step: (M + sum of J^T C J) change = impulse, M the bodies' masses, C the
/// couplings' resistances. Bodies that nothing couples are apart: each island is one dense symmetric system,
/// O(n^3) in its bodies. Allocates nothing once the largest island has been solved.
class StepEquations {
 public:
  /// @param mass kg @param inertia about the centre of mass, world axes, kg m^2
  struct Inertia {
    double mass = 0.0;  ///< 0: not free, its twist does not change
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();

    Matrix6d matrix() const;
    Vector6d changeBy(const Vector6d& impulse) const;  ///< of the twist
  };

  /// Finds what hangs together by couplings that act.
  void findIslands(const std::vector<Inertia>& bodies, const std::vector<Coupling>& couplings);

  /// Solves the islands found last.
  /// @param impulses of each body about its centre of mass, world axes; of others than free bodies ignored
  /// @param changes of the bodies' twists; and of the couplings' (Coupling::change)
  void solve(const std::vector<Inertia>& bodies, const std::vector<Vector6d>& impulses,
             std::vector<Coupling>& couplings, std::vector<Vector6d>& changes);

 private:
  std::size_t rootOf(std::size_t body) { return islands_.find(static_cast<std::uint32_t>(body)); }
  void assemble(const std::vector<Inertia>& bodies, const std::vector<Coupling>& couplings, std::size_t root,
                Eigen::Index size);

  UnionFind islands_;
  std::vector<Eigen::Index> row_;   ///< of each body in its island's matrix
  std::vector<Eigen::Index> size_;  ///< of each root's island
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd vector_;
};

/// A bound on the eigenvalues of M^-1 J^T R J, their sum. @param resistance R, as of the coupling's twist
double sumOfScales(const Matrix6d& resistance, const Coupling& coupling,
                   const std::vector<StepEquations::Inertia>& bodies);

}  // namespace concave_distance::detail
