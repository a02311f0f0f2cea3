#include "distant_components.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/surface/connected_pieces.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// Steps after which the search of a pair of pieces gives up; usually three are enough.
constexpr int kMostSteps = 16;

double reachOf(const BodyMesh& body) {
  return 0.5 * body.surface().boundingBox().diagonal().norm();
}

void groupByPiece(const ConnectedPieces& pieces, TrianglesOfPieces& grouped) {
  const std::vector<std::uint32_t>& piece_of = pieces.piece_of_triangle;
  grouped.first.assign(pieces.count + 1, 0);
  for (const std::uint32_t piece : piece_of) ++grouped.first[piece + 1];
  for (std::size_t i = 1; i < grouped.first.size(); ++i) grouped.first[i] += grouped.first[i - 1];
  grouped.triangles.resize(piece_of.size());
  // Filled from the back, so that the starts are right afterwards.
  std::vector<std::uint32_t>& next = grouped.first;
  for (std::size_t t = piece_of.size(); t-- > 0;) {
    grouped.triangles[--next[piece_of[t] + 1]] = TriangleIndex{t};
  }
  for (std::size_t i = 1; i < next.size(); ++i) next[i - 1] = next[i];
  next.back() = static_cast<std::uint32_t>(piece_of.size());
}

struct Support {
  TriangleIndex triangle;
  double along = -std::numeric_limits<double>::infinity();
};

/// The triangle of a piece that reaches farthest along a direction in the body's own axes.
Support supportOf(const BodyMesh& body, const Vector3d& centre, const TrianglesOfPieces& grouped,
                  std::size_t piece, const Vector3d& direction) {
  Support best;
  for (std::uint32_t i = grouped.first[piece]; i < grouped.first[piece + 1]; ++i) {
    const TriangleIndex t = grouped.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const double along = direction.dot(body.surface().corner(t, k) - centre);
      if (along > best.along) best = {t, along};
    }
  }
  return best;
}

/// Nearest points of two pieces, or false.
class PiecePair {
 public:
  PiecePair(const PairFrame& frame, DistantComponentBuffers& buffers, std::size_t piece_a,
            std::size_t piece_b)
      : frame_(frame), buffers_(buffers), piece_a_(piece_a), piece_b_(piece_b) {}

  bool findNearest(MinimumCandidate& candidate) {
    Vector3d direction = frame_.offset.normalized();
    double least = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps; ++step) {
      const Support a = supportOf(frame_.a, frame_.centre_a, buffers_.a, piece_a_, direction);
      const Support b = supportOf(frame_.b, frame_.centre_b, buffers_.b, piece_b_,
                                  frame_.rotation.transpose() * -direction);
      const double separation = direction.dot(frame_.offset) - a.along - b.along;
      if (separation >= least - 8.0 * frame_.rounding) return true;
      const double before = least;
      for (const auto& [ta, tb] : {std::pair{a.triangle, b.triangle}, std::pair{candidate.a, b.triangle},
                                   std::pair{a.triangle, candidate.b}}) {
        if (step == 0 && (ta != a.triangle || tb != b.triangle)) continue;  // no candidate yet
        const WitnessPair found =
            refineWitness(frame_.a, frame_.b, frame_.a_from_b, ta, tb, buffers_.refinement).witness;
        const double distance = std::sqrt(found.squared_distance);
        if (!(distance < least)) continue;
        least = distance;
        candidate = candidateOn(found.triangle_a, found.triangle_b, distance);
        direction = (found.point_b_in_a - found.point_a_in_a).normalized();
      }
      if (!(least < before)) return false;
    }
    return false;
  }

 private:
  const PairFrame& frame_;
  DistantComponentBuffers& buffers_;
  std::size_t piece_a_;
  std::size_t piece_b_;
};

}  // namespace

bool isNearestOfItsPieces(const PairFrame& frame, const WitnessPair& minimum) {
  const double distance = std::sqrt(minimum.squared_distance);
  const Vector3d direction = (minimum.point_b_in_a - minimum.point_a_in_a).normalized();
  const auto reach = [](const BodyMesh& body, const std::vector<std::uint32_t>& piece_of,
                        const Vector3d& centre, TriangleIndex of, const Vector3d& along) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < piece_of.size(); ++t) {
      if (piece_of[t] != piece_of[of.value]) continue;
      for (const NodeIndex node : body.surface().triangles()[t]) {
        most = std::max(most, along.dot(body.surface().vertex(node) - centre));
      }
    }
    return most;
  };
  const double separation =
      direction.dot(frame.offset) -
      reach(frame.a, frame.pieces_a->piece_of_triangle, frame.centre_a, minimum.triangle_a, direction) -
      reach(frame.b, frame.pieces_b->piece_of_triangle, frame.centre_b, minimum.triangle_b,
            frame.rotation.transpose() * -direction);
  return separation >= distance - 8.0 * frame.rounding;
}

double largestDistance(const PairFrame& frame) {
  return frame.offset.norm() + reachOf(frame.a) + reachOf(frame.b);
}

bool isFar(const PairFrame& frame, const NicheRule& rule) {
  const double least = frame.offset.norm() - reachOf(frame.a) - reachOf(frame.b);
  return rule.allowsOneNicheOnly(least, largestDistance(frame) + 8.0 * frame.rounding);
}

bool collectFarCandidates(const PairFrame& frame, double cutoff, DistantComponentBuffers& buffers,
                          std::vector<MinimumCandidate>& candidates, WorkLimit& limit) {
  const std::size_t before = candidates.size();
  if (frame.offset.norm() - reachOf(frame.a) - reachOf(frame.b) > cutoff) return true;
  groupByPiece(*frame.pieces_a, buffers.a);
  groupByPiece(*frame.pieces_b, buffers.b);
  for (std::size_t i = 0; i < frame.pieces_a->count; ++i) {
    for (std::size_t k = 0; k < frame.pieces_b->count; ++k) {
      MinimumCandidate candidate{};
      const bool may_go_on = !limit.isOver() && limit.admits(candidates.size() + 1);
      if (!may_go_on || !PiecePair(frame, buffers, i, k).findNearest(candidate)) {
        candidates.resize(before);
        return false;
      }
      if (candidate.distance <= cutoff) candidates.push_back(candidate);
    }
  }
  return true;
}

}  // namespace concave_distance::detail
