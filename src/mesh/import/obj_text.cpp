#include "obj_text.h"

#include "base/number_text.h"

namespace concave_distance::detail {
namespace {

constexpr int kDigits = 17;

std::uint64_t numberOf(std::uint32_t corner) {
  return std::uint64_t{corner} + 1;
}
std::uint64_t numberOf(NodeIndex corner) {
  return std::uint64_t{corner.value} + 1;
}

template <typename Triangles>
std::string textOf(const std::vector<Eigen::Vector3d>& vertices, const Triangles& triangles) {
  std::string text;
  for (const Eigen::Vector3d& vertex : vertices) {
    text += 'v';
    for (int axis = 0; axis < 3; ++axis) (text += ' ') += numberText(vertex[axis], kDigits);
    text += '\n';
  }
  for (const auto& triangle : triangles) {
    text += 'f';
    for (const auto corner : triangle) (text += ' ') += std::to_string(numberOf(corner));
    text += '\n';
  }
  return text;
}

}  // namespace

std::string objText(const TriangleSoup& soup) {
  return textOf(soup.vertices, soup.triangles);
}

std::string objText(const SurfaceMesh& mesh) {
  return textOf(mesh.vertices(), mesh.triangles());
}

}  // namespace concave_distance::detail
