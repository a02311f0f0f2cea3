#include "step_equations.h"

#include <Eigen/LU>

namespace concave_distance::detail {
namespace {

bool isFree(const std::vector<StepEquations::Inertia>& bodies, std::size_t body) {
  return body != kNoBody && bodies[body].mass > 0.0;
}

}  // namespace

Matrix6d StepEquations::Inertia::matrix() const {
  Matrix6d matrix = Matrix6d::Zero();
  matrix.diagonal().head<3>().setConstant(mass);
  matrix.bottomRightCorner<3, 3>() = inertia;
  return matrix;
}

Vector6d StepEquations::Inertia::changeBy(const Vector6d& impulse) const {
  Vector6d change;
  change << impulse.head<3>() / mass, inertia.inverse() * impulse.tail<3>();
  return change;
}

void StepEquations::findIslands(const std::vector<Inertia>& bodies, const std::vector<Coupling>& couplings) {
  islands_.reset(bodies.size());
  row_.assign(bodies.size(), -1);
  size_.assign(bodies.size(), 0);
  for (const Coupling& coupling : couplings) {
    if (!coupling.begin.acts) continue;
    if (!isFree(bodies, coupling.body_a) || !isFree(bodies, coupling.body_b)) continue;
    islands_.unite(static_cast<std::uint32_t>(coupling.body_a), static_cast<std::uint32_t>(coupling.body_b));
  }
  for (const Coupling& coupling : couplings) {
    if (!coupling.begin.acts) continue;
    for (const std::size_t body : {coupling.body_a, coupling.body_b}) {
      if (!isFree(bodies, body) || row_[body] >= 0) continue;
      Eigen::Index& size = size_[rootOf(body)];
      row_[body] = size;
      size += 6;
    }
  }
}

void StepEquations::assemble(const std::vector<Inertia>& bodies, const std::vector<Coupling>& couplings,
                             std::size_t root, Eigen::Index size) {
  if (matrix_.rows() < size) {
    matrix_.resize(size, size);
    vector_.resize(size);
  }
  matrix_.topLeftCorner(size, size).setZero();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (row_[i] >= 0 && rootOf(i) == root) matrix_.block<6, 6>(row_[i], row_[i]) = bodies[i].matrix();
  }
  for (const Coupling& coupling : couplings) {
    if (!coupling.begin.acts) continue;
    const bool free_a = isFree(bodies, coupling.body_a);
    const bool free_b = isFree(bodies, coupling.body_b);
    if (rootOf(free_b ? coupling.body_b : coupling.body_a) != root) continue;
    const Matrix6d resisted_b = coupling.resistance * coupling.jacobian_b;
    if (free_b) {
      const Eigen::Index b = row_[coupling.body_b];
      matrix_.block<6, 6>(b, b).noalias() += coupling.jacobian_b.transpose() * resisted_b;
    }
    if (!free_a) continue;
    const Eigen::Index a = row_[coupling.body_a];
    matrix_.block<6, 6>(a, a).noalias() +=
        coupling.jacobian_a.transpose() * (coupling.resistance * coupling.jacobian_a).eval();
    if (!free_b) continue;
    const Eigen::Index b = row_[coupling.body_b];
    const Matrix6d block = coupling.jacobian_a.transpose() * resisted_b;
    matrix_.block<6, 6>(a, b) += block;
    matrix_.block<6, 6>(b, a) += block.transpose();
  }
}

void StepEquations::solve(const std::vector<Inertia>& bodies, const std::vector<Vector6d>& impulses,
                          std::vector<Coupling>& couplings, std::vector<Vector6d>& changes) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    changes[i].setZero();
    if (isFree(bodies, i) && row_[i] < 0) changes[i] = bodies[i].changeBy(impulses[i]);
  }
  for (std::size_t root = 0; root < bodies.size(); ++root) {
    const Eigen::Index size = size_[root];
    if (size == 0) continue;
    assemble(bodies, couplings, root, size);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (row_[i] >= 0 && rootOf(i) == root) vector_.segment<6>(row_[i]) = impulses[i];
    }
    Eigen::Ref<Eigen::MatrixXd> system = matrix_.topLeftCorner(size, size);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(system);
    factors.solveInPlace(vector_.head(size));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (row_[i] >= 0 && rootOf(i) == root) changes[i] = vector_.segment<6>(row_[i]);
    }
  }
  for (Coupling& coupling : couplings) {
    coupling.change.setZero();
    if (isFree(bodies, coupling.body_b)) coupling.change += coupling.jacobian_b * changes[coupling.body_b];
    if (isFree(bodies, coupling.body_a)) coupling.change += coupling.jacobian_a * changes[coupling.body_a];
  }
}

double sumOfScales(const Matrix6d& resistance, const Coupling& coupling,
                   const std::vector<StepEquations::Inertia>& bodies) {
  double sum = 0.0;
  const auto add = [&](std::size_t body, const Matrix6d& jacobian) {
    if (!isFree(bodies, body)) return;
    const Matrix6d on_body = jacobian.transpose() * resistance * jacobian;
    sum += on_body.diagonal().head<3>().sum() / bodies[body].mass +
           (bodies[body].inertia.inverse() * on_body.bottomRightCorner<3, 3>()).trace();
  };
  add(coupling.body_a, coupling.jacobian_a);
  add(coupling.body_b, coupling.jacobian_b);
  return sum;
}

}  // namespace concave_distance::detail
