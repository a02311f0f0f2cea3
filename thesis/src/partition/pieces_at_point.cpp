#include "pieces_at_point.h"

#include <limits>

namespace concave_distance {

void findPiecesAt(const ConvexPartition& partition, const Eigen::Vector3d& point, double reach,
                  std::vector<std::uint32_t>& pieces) {
  pieces.clear();
  std::uint32_t nearest = 0;
  double greatest_depth = -std::numeric_limits<double>::infinity();
  for (std::uint32_t p = 0; p < partition.pieces.size(); ++p) {
    const ConvexPiece& piece = partition.pieces[p];
    const double outside_sphere = (point - piece.centre).norm() - piece.radius;
    if (outside_sphere > reach * piece.radius && -outside_sphere < greatest_depth) continue;
    const double deep = depth(piece, point);
    if (deep >= -reach * piece.radius) pieces.push_back(p);
    if (deep > greatest_depth) {
      greatest_depth = deep;
      nearest = p;
    }
  }
  if (pieces.empty() && !partition.pieces.empty()) pieces.push_back(nearest);
}

}  // namespace concave_distance
