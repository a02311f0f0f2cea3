#include "dented_groups.h"

namespace concave_distance {
namespace {

using Item = NormalConeTree::Item;
using Kind = NormalConeTree::Kind;

class Marker {
 public:
  Marker(const NormalConeTree& cones, const SurfaceMesh& mesh, const MeshTopology& topology,
         const HullGap& gap)
      : cones_(cones), mesh_(mesh), topology_(topology), gap_(gap), marks_(cones.groups().size()) {}

  std::vector<bool> marks() {
    mark(NormalConeTree::kRoot);
    return std::move(marks_);
  }

 private:
  bool mark(NormalConeTree::Slot slot) {
    const std::uint32_t child = cones_.child(slot);
    bool is_dented = false;
    if (child == NormalConeTree::kNoChild) return false;
    if ((child & NormalConeTree::kItemFlag) != 0) {
      is_dented = isDented(cones_.items()[child & ~NormalConeTree::kItemFlag]);
    } else {
      for (std::uint32_t k = 0; k < NormalConeTree::kWidth; ++k) is_dented = mark(child + k) || is_dented;
    }
    marks_[slot] = is_dented;
    return is_dented;
  }

  bool isDented(const Item& item) const {
    if (item.kind == Kind::Face) return gap_.behind[item.triangle.value];
    if (item.kind == Kind::Edge) {
      return isDented(item, item.triangle) ||
             isDented(item, topology_.triangle_across_edge[item.triangle.value][item.element]);
    }
    for (const TriangleIndex t :
         topology_.triangles_of_vertex.row(mesh_.triangle(item.triangle)[item.element].value)) {
      if (isDented(item, t)) return true;
    }
    return false;
  }

  /// The feature's directions are sums of the normals around it. With these within 60 degrees of an axis no
  /// sum of unit length has factors of more than 2 together.
  bool isDented(const Item& item, TriangleIndex t) const {
    return t == kNoTriangle || gap_.behind[t.value] ||
           !(item.cap.axis.dot(topology_.triangle_normals[t.value]) > 0.5 + 1e-6);
  }

  const NormalConeTree& cones_;
  const SurfaceMesh& mesh_;
  const MeshTopology& topology_;
  const HullGap& gap_;
  std::vector<bool> marks_;
};

}  // namespace

std::vector<bool> markDentedGroups(const NormalConeTree& cones, const SurfaceMesh& mesh,
                                   const MeshTopology& topology, const HullGap& gap) {
  if (gap.behind.empty() || cones.empty()) return {};
  return Marker(cones, mesh, topology, gap).marks();
}

}  // namespace concave_distance
