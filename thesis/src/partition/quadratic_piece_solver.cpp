#include <optimization.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pair_program.h"
#include "piece_solvers.h"

namespace concave_distance {
namespace {

/// Steps smaller than this end the iteration, in units of the pieces' size. Half the digits of a double are
/// what an active set on a nearly parallel pair can show; judgeProposal says when they were not enough.
constexpr double kLeastStep = 1e-12;

}  // namespace

struct QuadraticPieceSolver::State {
  const ConvexPiece* a;
  const ConvexPiece* b;
  double unit;  ///< metres
  alglib::minqpstate program;
  alglib::real_2d_array weights;
  alglib::real_1d_array linear;
  alglib::real_1d_array start;
  alglib::real_1d_array answer;
  alglib::minqpreport report;
};

QuadraticPieceSolver::QuadraticPieceSolver(const ConvexPiece& a, const ConvexPiece& b)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.a = &a;
  s.b = &b;
  s.unit = std::max(a.radius, b.radius);
  PairConstraints constraints = makePairConstraints(a, b);
  const Eigen::Index rows_a = a.offsets.size();
  constraints.offsets.head(rows_a) += a.normals * a.centre;
  constraints.offsets.tail(b.offsets.size()) += b.normals * b.centre;
  const Eigen::VectorXd lower = -constraints.offsets / s.unit;
  const Eigen::VectorXd upper =
      Eigen::VectorXd::Constant(lower.size(), std::numeric_limits<double>::infinity());
  s.weights.setlength(6, 6);
  s.linear.setlength(6);
  s.start.setlength(6);
  alglib::minqpcreate(6, s.program);
  alglib::real_2d_array rows;
  rows.setcontent(constraints.rows.rows(), 6, constraints.rows.data());
  alglib::real_1d_array least;
  least.setcontent(lower.size(), lower.data());
  alglib::real_1d_array most;
  most.setcontent(upper.size(), upper.data());
  alglib::minqpsetlc2dense(s.program, rows, least, most);
  alglib::minqpsetalgobleic(s.program, 0.0, 0.0, kLeastStep, 0);
}

QuadraticPieceSolver::~QuadraticPieceSolver() = default;
QuadraticPieceSolver::QuadraticPieceSolver(QuadraticPieceSolver&&) noexcept = default;
QuadraticPieceSolver& QuadraticPieceSolver::operator=(QuadraticPieceSolver&&) noexcept = default;

PieceProposal QuadraticPieceSolver::solve(const Eigen::Isometry3d& a_from_b, const PiecePoints* start) {
  State& s = *state_;
  // x = [(p1 - centre 1) / unit; (p2 - centre 2) / unit].
  Eigen::Isometry3d scaled = a_from_b;
  scaled.translation() = (a_from_b * s.b->centre - s.a->centre) / s.unit;
  const PieceObjective objective = makePairObjective(scaled);
  PieceProposal proposal;
  proposal.points = {s.a->centre, s.b->centre};
  for (Eigen::Index i = 0; i < 6; ++i) {
    s.linear[i] = objective.linear[i];
    // ALGLIB minimises x^T H x / 2 + w^T x.
    for (Eigen::Index j = 0; j < 6; ++j) s.weights[i][j] = 2.0 * objective.weights(i, j);
    s.start[i] = 0.0;
  }
  if (start != nullptr) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      s.start[i] = (start->on_a[i] - s.a->centre[i]) / s.unit;
      s.start[i + 3] = (start->on_b[i] - s.b->centre[i]) / s.unit;
    }
  }
  try {
    alglib::minqpsetquadraticterm(s.program, s.weights);
    alglib::minqpsetlinearterm(s.program, s.linear);
    alglib::minqpsetstartingpoint(s.program, s.start);
    alglib::minqpoptimize(s.program);
    alglib::minqpresultsbuf(s.program, s.answer, s.report);
  } catch (const alglib::ap_error&) {
    proposal.failed = true;
    return proposal;
  }
  proposal.iterations =
      static_cast<std::uint32_t>(std::max<alglib::ae_int_t>(0, s.report.inneriterationscount));
  const Eigen::Map<const Vector6> x(s.answer.getcontent());
  proposal.failed = s.report.terminationtype <= 0 || !x.allFinite();
  if (proposal.failed) return proposal;
  proposal.points.on_a += s.unit * x.head<3>();
  proposal.points.on_b += s.unit * x.tail<3>();
  return proposal;
}

}  // namespace concave_distance
