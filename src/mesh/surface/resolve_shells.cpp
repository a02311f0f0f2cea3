#include "resolve_shells.h"

namespace concave_distance::detail {

ResolvedShells resolveShells(const std::vector<Eigen::Vector3d>& vertices,
                             const std::vector<TriangleNodes>& triangles) {
  ResolvedShells resolved;
  resolved.table = buildFaceTable(triangles);
  const std::vector<TriangleNodes> faces = cornersOf(resolved.table);
  const EdgeTable edges = buildEdgeTable(faces);
  resolved.units = splitIntoUnits(faces, edges);
  const std::vector<FaceSide> cells = findCells(vertices, resolved.table, edges, resolved.units);
  resolved.decisions.resize(faces.size());
  std::vector<std::vector<std::uint32_t>> faces_of_unit(resolved.units.count);
  for (std::uint32_t face = 0; face < faces.size(); ++face) {
    const std::uint32_t unit = resolved.units.unit_of_face[face];
    if (unit != kSheet) faces_of_unit[unit].push_back(face);
  }
  EnclosureSolver solver(vertices, resolved.table, edges, resolved.units, cells);
  for (const std::vector<std::uint32_t>& unit : faces_of_unit) {
    resolved.unit_is_inward.push_back(solver.solve(unit, resolved.decisions));
  }
  return resolved;
}

}  // namespace concave_distance::detail
