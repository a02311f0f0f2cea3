#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd-inl.h>

#include <exception>

#include "piece_solvers.h"

namespace concave_distance {
namespace {

/// Relative to the scale of the pieces; FCL's own default is 1e-6 m.
constexpr double kGjkTolerance = 1e-10;

}  // namespace

struct GjkShape::State {
  const ConvexPiece* piece;
  std::unique_ptr<fcl::Convex<double>> shape;
};

GjkShape::GjkShape(const ConvexPiece& piece) : state_(std::make_unique<State>()) {
  // Around its centre: GJK works with differences of corners.
  auto corners = std::make_shared<std::vector<Eigen::Vector3d>>();
  for (const Eigen::Vector3d& vertex : piece.vertices) corners->push_back(vertex - piece.centre);
  auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<std::uint32_t>& facet : piece.facets) {
    faces->push_back(static_cast<int>(facet.size()));
    for (const std::uint32_t corner : facet) faces->push_back(static_cast<int>(corner));
  }
  state_->piece = &piece;
  state_->shape =
      std::make_unique<fcl::Convex<double>>(corners, static_cast<int>(piece.facets.size()), faces);
}

GjkShape::~GjkShape() = default;
GjkShape::GjkShape(GjkShape&&) noexcept = default;
GjkShape& GjkShape::operator=(GjkShape&&) noexcept = default;

PieceProposal solveGjk(const GjkShape& a, const GjkShape& b, const Eigen::Isometry3d& a_from_b) {
  const ConvexPiece& piece_a = *a.state().piece;
  const ConvexPiece& piece_b = *b.state().piece;
  PieceProposal proposal;
  proposal.points = {piece_a.centre, piece_b.centre};
  const Eigen::Vector3d between = a_from_b * piece_b.centre - piece_a.centre;
  fcl::Transform3<double> pose_b = fcl::Transform3<double>::Identity();
  pose_b.linear() = a_from_b.linear();
  pose_b.translation() = between;
  fcl::detail::GJKSolver_libccd<double> solver;
  solver.distance_tolerance = kGjkTolerance * (piece_a.radius + piece_b.radius + between.norm());
  double distance = 0.0;
  fcl::Vector3<double> point_a = fcl::Vector3<double>::Zero();
  fcl::Vector3<double> point_b = fcl::Vector3<double>::Zero();
  bool apart = false;
  try {
    apart = solver.shapeDistance(*a.state().shape, fcl::Transform3<double>::Identity(), *b.state().shape,
                                 pose_b, &distance, &point_a, &point_b);
  } catch (const std::exception&) {
    proposal.failed = true;
    return proposal;
  }
  if (apart) {
    proposal.points.on_a = piece_a.centre + point_a;
    proposal.points.on_b = a_from_b.inverse() * (piece_a.centre + point_b);
  }
  proposal.failed = !apart || !proposal.points.on_a.allFinite() || !proposal.points.on_b.allFinite();
  if (proposal.failed) proposal.points = {piece_a.centre, piece_b.centre};
  return proposal;
}

}  // namespace concave_distance
