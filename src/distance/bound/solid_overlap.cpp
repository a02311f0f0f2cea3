#include "solid_overlap.h"

#include <algorithm>

#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

constexpr std::size_t kUnlimitedShells = 64;

std::optional<bool> holdsShellOf(const BodyMesh& holder, const BodyMesh& held,
                                 const Eigen::Isometry3d& holder_from_held, WorkLimit& limit) {
  const MeshTopology& topology = holder.topology();
  const std::vector<bool>& closed = topology.shell_is_closed;
  if (std::none_of(closed.begin(), closed.end(), [](bool c) { return c; })) return false;
  std::size_t asked = 0;
  for (const TriangleIndex triangle : held.topology().triangle_of_shell) {
    if (triangle == kNoTriangle) continue;
    if (asked++ >= kUnlimitedShells && limit.isOverNow()) return std::nullopt;
    if (containsPoint(holder.tree(), holder.surface(), closed, topology.shell_of_triangle,
                      holder_from_held * held.surface().corner(triangle, 0))) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<bool> isContained(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                WorkLimit& limit) {
  const std::optional<bool> a_holds = holdsShellOf(a, b, a_from_b, limit);
  if (a_holds.value_or(false)) return true;
  const std::optional<bool> b_holds = holdsShellOf(b, a, a_from_b.inverse(Eigen::Isometry), limit);
  if (b_holds.value_or(false)) return true;
  if (!a_holds || !b_holds) return std::nullopt;
  return false;
}

}  // namespace concave_distance
