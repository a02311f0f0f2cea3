#include "thesis_tool_commands.h"

#include <cstdlib>
#include <map>
#include <optional>
#include <ostream>
#include <utility>

#include "base/output_file.h"
#include "thesis/src/continuous/build_constraint_tree.h"
#include "thesis/src/continuous/constraint_tree_file.h"
#include "thesis/src/continuous/piece_mesh.h"

namespace concave_distance::tools {
namespace {

/// One Wavefront object a piece, named by its level and object_id: level_-2_piece_1_3.
void writePieceMeshes(const ConstraintTree& tree, std::ostream& stream) {
  std::size_t first = 1;
  for (std::uint32_t i = 0; i < tree.pieces().size(); ++i) {
    stream << "o level_" << tree.pieces()[i].level << "_piece";
    for (const std::uint32_t number : tree.objectId(i)) {
      stream << '_' << number;
    }
    stream << '\n';
    const SurfaceMesh mesh = pieceMesh(tree, i);
    for (const Eigen::Vector3d& v : mesh.vertices()) {
      stream << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    }
    for (const TriangleNodes& t : mesh.triangles()) {
      stream << "f " << first + t[0].value << ' ' << first + t[1].value << ' ' << first + t[2].value << '\n';
    }
    first += mesh.vertexCount();
  }
}

}  // namespace

void writeTree(const ThesisToolOptions& options, std::ostream& out) {
  TreeBuildOptions build_options;
  build_options.flatness_tolerance = options.flatness;
  const BuiltTree built = buildConstraintTree(readRepaired(options), build_options, options.input);
  std::optional<OutputFile> pieces;
  if (!options.pieces.empty()) {
    pieces.emplace(options.pieces);
    writePieceMeshes(built.tree, pieces->stream());
    pieces->complete();
  }
  writeConstraintTreeFile(built.tree, options.output);
  if (pieces) pieces->finish();
  std::map<int, std::pair<std::size_t, std::size_t>> counts;  // of pieces and constraints, by depth
  for (const TreePiece& piece : built.tree.pieces()) {
    ++counts[std::abs(piece.level)].first;
    counts[std::abs(piece.level)].second += piece.constraint_count;
  }
  out << "pieces: " << built.tree.pieces().size() << ", constraints: " << built.tree.constraints().size()
      << '\n';
  for (const auto& [depth, count] : counts) {
    out << "level " << (depth % 2 == 1 ? depth : -depth) << ": " << count.first << " pieces, " << count.second
        << " constraints\n";
  }
  if (const std::string summary = built.report.summary(); !summary.empty()) {
    out << "note: " << summary << '\n';
  }
}

}  // namespace concave_distance::tools
