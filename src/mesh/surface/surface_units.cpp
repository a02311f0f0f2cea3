#include "surface_units.h"

#include <algorithm>

#include "base/union_find.h"
#include "compressed_rows.h"

namespace concave_distance::detail {
namespace {

constexpr std::uint32_t kUndecided = kSheet - 1;
/// Solids in a chain of shared edges may need a round each; those left after this many rounds form one unit.
constexpr int kMostRounds = 32;

class Splitter {
 public:
  Splitter(std::size_t face_count, const EdgeTable& edges)
      : edges_(edges), left_(face_count), uses_(edges.edgeCount()) {
    units_.unit_of_face.assign(face_count, kUndecided);
    for (std::uint32_t f = 0; f < face_count; ++f) left_[f] = f;
    for (std::size_t e = 0; e < uses_.size(); ++e) uses_[e] = edges.first[e + 1] - edges.first[e];
  }

  SurfaceUnits split() {
    for (int round = 0; round < kMostRounds && !left_.empty(); ++round) {
      findPatches();
      peelSheets();
      findPatches();
      if (!takeClosedPatches()) break;
    }
    takeRest();
    return std::move(units_);
  }

 private:
  template <typename Visit>
  void forEachLeftAt(std::size_t edge, Visit visit) const {
    for (std::uint32_t i = edges_.first[edge]; i < edges_.first[edge + 1]; ++i) {
      const std::uint32_t face = edges_.half_edges[i] / 3;
      if (units_.unit_of_face[face] == kUndecided) visit(face);
    }
  }

  std::uint32_t edgeOf(std::uint32_t face, std::uint32_t k) const {
    return edges_.edge_of_half_edge[3 * face + k];
  }

  void take(std::uint32_t face, std::uint32_t unit) {
    units_.unit_of_face[face] = unit;
    for (std::uint32_t k = 0; k < 3; ++k) --uses_[edgeOf(face, k)];
  }

  void dropTaken() {
    const auto taken = [&](std::uint32_t face) { return units_.unit_of_face[face] != kUndecided; };
    left_.erase(std::remove_if(left_.begin(), left_.end(), taken), left_.end());
  }

  void findPatches() {
    UnionFind patches(units_.unit_of_face.size());
    for (const std::uint32_t face : left_) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (uses_[edgeOf(face, k)] != 2) continue;
        forEachLeftAt(edgeOf(face, k), [&](std::uint32_t other) { patches.unite(face, other); });
      }
    }
    patch_.assign(units_.unit_of_face.size(), 0);
    for (const std::uint32_t face : left_) patch_[face] = patches.find(face);
    by_patch_ = compressedRows<std::uint32_t>(patch_.size(), [&](const auto& visit) {
                  for (const std::uint32_t face : left_) visit(patch_[face], face);
                }).values;
  }

  void peelSheets() {
    std::vector<std::uint32_t> waiting;
    for (const std::uint32_t face : left_) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        if (uses_[edgeOf(face, k)] == 1) waiting.push_back(patch_[face]);
      }
    }
    while (!waiting.empty()) {
      const std::uint32_t patch = waiting.back();
      waiting.pop_back();
      auto at = std::lower_bound(by_patch_.begin(), by_patch_.end(), patch,
                                 [&](std::uint32_t face, std::uint32_t p) { return patch_[face] < p; });
      if (at == by_patch_.end() || units_.unit_of_face[*at] != kUndecided) continue;
      const auto first = at;
      for (; at != by_patch_.end() && patch_[*at] == patch; ++at) take(*at, kSheet);
      for (auto face = first; face != at; ++face) {
        for (std::uint32_t k = 0; k < 3; ++k) {
          if (uses_[edgeOf(*face, k)] != 1) continue;
          forEachLeftAt(edgeOf(*face, k), [&](std::uint32_t other) { waiting.push_back(patch_[other]); });
        }
      }
    }
    dropTaken();
  }

  bool takeClosedPatches() {
    std::vector<bool> joined(units_.unit_of_face.size(), false);  // by patch: at an edge with an odd number
    std::vector<std::uint32_t> around;
    for (std::size_t e = 0; e < uses_.size(); ++e) {
      if (uses_[e] < 3) continue;
      around.clear();
      forEachLeftAt(e, [&](std::uint32_t face) { around.push_back(patch_[face]); });
      std::sort(around.begin(), around.end());
      for (std::size_t i = 0; i < around.size();) {
        const std::size_t first = i;
        while (i < around.size() && around[i] == around[first]) ++i;
        if ((i - first) % 2 == 1) joined[around[first]] = true;
      }
    }
    std::uint32_t patch = kSheet;
    const std::uint32_t count = units_.count;
    for (const std::uint32_t face : by_patch_) {
      if (units_.unit_of_face[face] != kUndecided || joined[patch_[face]]) continue;
      if (patch_[face] != patch) ++units_.count;
      patch = patch_[face];
      take(face, units_.count - 1);
    }
    dropTaken();
    return units_.count != count && !left_.empty();
  }

  void takeRest() {
    UnionFind sets(units_.unit_of_face.size());
    for (std::size_t e = 0; e < uses_.size() && !left_.empty(); ++e) {
      std::uint32_t first = kSheet;
      forEachLeftAt(e, [&](std::uint32_t face) {
        if (first != kSheet) sets.unite(first, face);
        first = face;
      });
    }
    std::vector<std::uint32_t> unit_of_set(units_.unit_of_face.size(), kSheet);
    for (const std::uint32_t face : left_) {
      std::uint32_t& unit = unit_of_set[sets.find(face)];
      if (unit == kSheet) unit = units_.count++;
      units_.unit_of_face[face] = unit;
    }
  }

  const EdgeTable& edges_;
  SurfaceUnits units_;
  std::vector<std::uint32_t> left_;  ///< undecided faces, ascending
  std::vector<std::uint32_t> uses_;  ///< per edge, by undecided faces
  std::vector<std::uint32_t> patch_;
  std::vector<std::uint32_t> by_patch_;
};

}  // namespace

SurfaceUnits splitIntoUnits(const std::vector<TriangleNodes>& faces, const EdgeTable& edges) {
  return Splitter(faces.size(), edges).split();
}

}  // namespace concave_distance::detail
