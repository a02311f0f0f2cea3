#include "connected_pieces.h"

#include "base/union_find.h"

namespace concave_distance {

ConnectedPieces connectedPieces(const SurfaceMesh& mesh) {
  UnionFind vertices(mesh.vertexCount());
  for (const TriangleNodes& t : mesh.triangles()) {
    vertices.unite(t[0].value, t[1].value);
    vertices.unite(t[0].value, t[2].value);
  }
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> piece_of_root(mesh.vertexCount(), kNone);
  ConnectedPieces pieces;
  pieces.piece_of_triangle.reserve(mesh.triangleCount());
  for (const TriangleNodes& t : mesh.triangles()) {
    std::uint32_t& piece = piece_of_root[vertices.find(t[0].value)];
    if (piece == kNone) piece = pieces.count++;
    pieces.piece_of_triangle.push_back(piece);
  }
  return pieces;
}

}  // namespace concave_distance
