#include "thesis_tool_commands.h"

#include <algorithm>
#include <ostream>

#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "thesis/src/partition/convex_hull.h"
#include "thesis/src/partition/convex_partition.h"
#include "thesis/src/partition/piece_file.h"

namespace concave_distance::tools {
namespace {

SurfaceMesh surfaceOf(const ConvexPiece& piece, const std::string& where) {
  std::vector<TriangleNodes> triangles;
  for (const std::vector<std::uint32_t>& facet : piece.facets) {
    for (std::size_t k = 1; k + 1 < facet.size(); ++k) {
      triangles.push_back({NodeIndex{facet[0]}, NodeIndex{facet[k]}, NodeIndex{facet[k + 1]}});
    }
  }
  return SurfaceMesh(piece.vertices, std::move(triangles), where);
}

}  // namespace

SurfaceMesh readRepaired(const ThesisToolOptions& options) {
  return repairMesh(importMesh(options.input), options.repair, options.input).mesh;
}

void writeHull(const ThesisToolOptions& options, std::ostream& out) {
  const ConvexPiece hull = convexHull(readRepaired(options).vertices(), options.input);
  exportMesh(surfaceOf(hull, options.input), options.output);
  out << "hull: " << hull.vertices.size() << " corners, " << hull.facets.size() << " facets, volume "
      << volume(hull) << " m^3\n";
}

void writePartition(const ThesisToolOptions& options, std::ostream& out) {
  PartitionOptions limits;
  limits.reflex_edge_limit = options.reflex_edge_limit;
  const PartitionedBody body = partitionMesh(readRepaired(options), options.input, limits);
  writePieces(body.partition, options.output);
  double sum = 0.0;
  std::size_t most_facets = 0;
  for (const ConvexPiece& piece : body.partition.pieces) {
    sum += volume(piece);
    most_facets = std::max(most_facets, piece.facets.size());
  }
  out << "reflex edges: " << body.report.reflex_edges << ", shells: " << body.report.shells << '\n'
      << "pieces: " << body.partition.pieces.size() << ", of up to " << most_facets << " facets\n"
      << "volume (m^3): " << sum << '\n'
      << "seconds: " << body.report.seconds << '\n';
  if (body.report.dropped_slivers > 0) {
    out << "left out: " << body.report.dropped_slivers << " pieces thinner than doubles can say\n";
  }
}

}  // namespace concave_distance::tools
