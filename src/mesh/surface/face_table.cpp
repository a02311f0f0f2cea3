#include "face_table.h"

#include <algorithm>

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
  std::vector<Keyed> keyed;
  keyed.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Keyed entry{triangles[t], t};
    std::sort(entry.nodes.begin(), entry.nodes.end());
    if (entry.nodes[0] != entry.nodes[1] && entry.nodes[1] != entry.nodes[2]) keyed.push_back(entry);
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& l, const Keyed& r) {
    return l.nodes != r.nodes ? l.nodes < r.nodes : l.triangle < r.triangle;
  });
  FaceTable table;
  table.triangles.reserve(keyed.size());
  for (std::uint32_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].nodes != keyed[i - 1].nodes) {
      table.faces.emplace_back();
      table.faces.back().nodes = keyed[i].nodes;
      table.faces.back().first = i;
    }
    table.triangles.push_back(keyed[i].triangle);
    Face& face = table.faces.back();
    ++(runsAlong(triangles[keyed[i].triangle]) ? face.along : face.against);
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
