#include "piece_file.h"

#include "base/output_file.h"

namespace concave_distance {

void writePieces(const ConvexPartition& partition, const std::string& path) {
  OutputFile output(path);
  std::ostream& file = output.stream();
  file << "# convex pieces of " << partition.name << "; metres\n";
  std::size_t first_vertex = 1;
  std::size_t normal = 1;
  for (std::size_t p = 0; p < partition.pieces.size(); ++p) {
    const ConvexPiece& piece = partition.pieces[p];
    file << "o piece_" << p + 1 << '\n';
    for (const Eigen::Vector3d& v : piece.vertices) {
      file << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    for (std::size_t f = 0; f < piece.facets.size(); ++f, ++normal) {
      const Eigen::RowVector3d outward = -piece.normals.row(static_cast<Eigen::Index>(f));
      file << "vn " << outward.x() << ' ' << outward.y() << ' ' << outward.z() << "\nf";
      for (const std::uint32_t corner : piece.facets[f]) {
        file << ' ' << first_vertex + corner << "//" << normal;
      }
      file << '\n';
    }
    first_vertex += piece.vertices.size();
  }
  output.finish();
}

}  // namespace concave_distance
