#include "concave_distance/distance/solid_overlap.h"

#include <algorithm>

namespace concave_distance {
namespace {

bool holdsShellOf(const BodyMesh& holder, const BodyMesh& held, const Eigen::Isometry3d& holder_from_held) {
  const MeshTopology& topology = holder.topology();
  const std::vector<bool>& closed = topology.shell_is_closed;
  if (std::none_of(closed.begin(), closed.end(), [](bool c) { return c; })) return false;
  return std::any_of(held.topology().triangle_of_shell.begin(), held.topology().triangle_of_shell.end(),
                     [&](TriangleIndex triangle) {
                       return triangle != kNoTriangle &&
                              containsPoint(holder.tree(), holder.surface(), closed,
                                            topology.shell_of_triangle,
                                            holder_from_held * held.surface().corner(triangle, 0));
                     });
}

}  // namespace

bool holdsAnother(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  return holdsShellOf(a, b, a_from_b) || holdsShellOf(b, a, a_from_b.inverse(Eigen::Isometry));
}

}  // namespace concave_distance
