#include "face_table.h"

#include <algorithm>

#include "edge_table.h"

namespace concave_distance::detail {

bool runsAlong(const TriangleNodes& nodes) {
  const bool falls[3] = {nodes[1] < nodes[0], nodes[2] < nodes[1], nodes[0] < nodes[2]};
  return falls[0] + falls[1] + falls[2] == 1;
}

FaceTable buildFaceTable(const std::vector<TriangleNodes>& triangles) {
  struct Keyed {
    TriangleNodes nodes;  ///< ascending
    std::uint32_t triangle;
  };
  CompressedRows<Keyed> rows = compressedRows<Keyed>(nodeCountOf(triangles), [&](const auto& visit) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      Keyed entry{triangles[t], t};
      std::sort(entry.nodes.begin(), entry.nodes.end());
      if (entry.nodes[0] != entry.nodes[1] && entry.nodes[1] != entry.nodes[2])
        visit(entry.nodes[0].value, entry);
    }
  });
  FaceTable table;
  table.triangles.reserve(rows.values.size());
  for (std::size_t lowest = 0; lowest + 1 < rows.offsets.size(); ++lowest) {
    const auto begin = rows.values.begin() + rows.offsets[lowest];
    const auto end = rows.values.begin() + rows.offsets[lowest + 1];
    std::sort(begin, end, [](const Keyed& l, const Keyed& r) {
      return l.nodes != r.nodes ? l.nodes < r.nodes : l.triangle < r.triangle;
    });
    for (auto keyed = begin; keyed != end; ++keyed) {
      if (keyed == begin || keyed->nodes != (keyed - 1)->nodes) {
        table.faces.emplace_back();
        table.faces.back().nodes = keyed->nodes;
        table.faces.back().first = static_cast<std::uint32_t>(table.triangles.size());
      }
      table.triangles.push_back(keyed->triangle);
      Face& face = table.faces.back();
      ++(runsAlong(triangles[keyed->triangle]) ? face.along : face.against);
    }
  }
  return table;
}

std::vector<TriangleNodes> cornersOf(const FaceTable& table) {
  std::vector<TriangleNodes> corners;
  corners.reserve(table.faces.size());
  for (const Face& face : table.faces) corners.push_back(face.nodes);
  return corners;
}

}  // namespace concave_distance::detail
