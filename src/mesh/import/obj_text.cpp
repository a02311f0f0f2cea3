#include "obj_text.h"

#include <array>

#include "base/number_characters.h"

namespace concave_distance::detail {
namespace {

constexpr int kDigits = 17;

void append(std::string& text, double value) {
  std::array<char, 32> number{};
  text.append(number.data(), writeGeneral(number.data(), number.data() + number.size(), value, kDigits));
}

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
    for (int axis = 0; axis < 3; ++axis) append(text += ' ', vertex[axis]);
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
