#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/mesh/surface/surface_mesh.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"

/// Unions of boxes, cavities and sheets as triangles of one file, with the truth in closed form: which points
/// are material, whether two of them overlap and how far they are apart. Shares no code with the library.
namespace concave_distance::test {

using Box = Eigen::AlignedBox3d;

/// Boxes are painted one over the other: material, or void where a cavity is cut out.
struct PaintedBoxes {
  struct Layer {
    Box box;
    bool is_material;
  };
  std::vector<Layer> layers;
  std::vector<Box> sheets;  ///< flat in one axis
  TriangleSoup soup;
};

inline void addTriangle(TriangleSoup& soup, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
  const auto first = static_cast<std::uint32_t>(soup.vertices.size());
  for (const Eigen::Vector3d* v : {&a, &b, &c}) soup.vertices.push_back(*v);
  soup.triangles.push_back({first, first + 1, first + 2});
}

/// A rectangle with its front towards a x b, cut along one diagonal or the other.
inline void addRectangle(TriangleSoup& soup, const Eigen::Vector3d& corner, const Eigen::Vector3d& a,
                         const Eigen::Vector3d& b, bool other_diagonal) {
  const Eigen::Vector3d pa = corner + a;
  const Eigen::Vector3d pb = corner + b;
  const Eigen::Vector3d pab = pa + b;
  if (other_diagonal) {
    addTriangle(soup, corner, pa, pb);
    addTriangle(soup, pa, pab, pb);
  } else {
    addTriangle(soup, corner, pa, pab);
    addTriangle(soup, corner, pab, pb);
  }
}

/// The corner of a box by bits of the axes, exactly as its ends are.
inline Eigen::Vector3d cornerOfBox(const Box& box, std::uint32_t bits) {
  return {(bits & 1U) != 0 ? box.max().x() : box.min().x(), (bits & 2U) != 0 ? box.max().y() : box.min().y(),
          (bits & 4U) != 0 ? box.max().z() : box.min().z()};
}

/// Twelve triangles, three corners of their own each; `diagonals` has a bit for each of the six faces. A face
/// that two boxes share has the same diagonal in both where their bits of it are the same.
inline void addBox(TriangleSoup& soup, const Box& box, std::uint32_t diagonals, bool turned) {
  for (std::uint32_t face = 0; face < 6; ++face) {
    const std::uint32_t axis = face / 2;
    const std::uint32_t u = 1U << ((axis + 1) % 3);
    const std::uint32_t v = 1U << ((axis + 2) % 3);
    const std::uint32_t at = face % 2 != 0 ? 1U << axis : 0U;
    const std::array<Eigen::Vector3d, 4> p = {cornerOfBox(box, at), cornerOfBox(box, at | u),
                                              cornerOfBox(box, at | u | v), cornerOfBox(box, at | v)};
    const std::size_t k = (diagonals >> face & 1U) != 0 ? 1 : 0;
    const bool front_up = (face % 2 != 0) != turned;
    for (const std::size_t second : {1U, 2U}) {
      const Eigen::Vector3d& q = p[(k + second) % 4];
      const Eigen::Vector3d& r = p[(k + second + 1) % 4];
      front_up ? addTriangle(soup, p[k], q, r) : addTriangle(soup, p[k], r, q);
    }
  }
}

inline bool isMaterial(const PaintedBoxes& painted, const Eigen::Vector3d& point) {
  bool material = false;
  for (const PaintedBoxes::Layer& layer : painted.layers) {
    if (layer.box.contains(point)) material = layer.is_material;
  }
  return material;
}

/// The material as boxes that do not overlap.
inline std::vector<Box> materialOf(const PaintedBoxes& painted) {
  std::array<std::vector<double>, 3> planes;
  for (const PaintedBoxes::Layer& layer : painted.layers) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      planes[k].push_back(layer.box.min()[axis]);
      planes[k].push_back(layer.box.max()[axis]);
    }
  }
  for (std::vector<double>& axis : planes) {
    std::sort(axis.begin(), axis.end());
    axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
  }
  std::vector<Box> cells;
  for (std::size_t x = 1; x < planes[0].size(); ++x) {
    for (std::size_t y = 1; y < planes[1].size(); ++y) {
      for (std::size_t z = 1; z < planes[2].size(); ++z) {
        const Box cell(Eigen::Vector3d(planes[0][x - 1], planes[1][y - 1], planes[2][z - 1]),
                       Eigen::Vector3d(planes[0][x], planes[1][y], planes[2][z]));
        if (isMaterial(painted, cell.center())) cells.push_back(cell);
      }
    }
  }
  return cells;
}

/// The least gap over all pairs of boxes, 0 where two overlap or touch.
inline double gapOf(const std::vector<Box>& a, const std::vector<Box>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Box& l : a) {
    for (const Box& r : b) least = std::min(least, l.squaredExteriorDistance(r));
  }
  return std::sqrt(least);
}

/// Whether all of the boxes lies in the other ones.
inline bool isWithin(const std::vector<Box>& inner, const std::vector<Box>& outer) {
  return std::all_of(inner.begin(), inner.end(), [&](const Box& box) {
    double covered = 0.0;
    for (const Box& other : outer) {
      const Box common = box.intersection(other);
      if (!common.isEmpty()) covered += common.volume();
    }
    return covered > (1.0 - 1e-9) * box.volume();
  });
}

struct PaintedTruth {
  bool overlap = false;    ///< material with material, or a sheet with material or a sheet
  bool swallowed = false;  ///< all of one lies in the other
  double distance = std::numeric_limits<double>::infinity();
};

/// Where no faces are flush: what is not apart overlaps.
inline PaintedTruth truthOf(const PaintedBoxes& a, const PaintedBoxes& b) {
  std::vector<Box> all_a = materialOf(a);
  std::vector<Box> all_b = materialOf(b);
  PaintedTruth truth;
  truth.swallowed = isWithin(all_a, all_b) || isWithin(all_b, all_a);
  all_a.insert(all_a.end(), a.sheets.begin(), a.sheets.end());
  all_b.insert(all_b.end(), b.sheets.begin(), b.sheets.end());
  truth.distance = gapOf(all_a, all_b);
  truth.overlap = truth.distance == 0.0;
  return truth;
}

/// The least difference of two planes of a and b along one axis: how far from flush they are.
inline double leastPlaneDifference(const PaintedBoxes& a, const PaintedBoxes& b) {
  const auto boxes_of = [](const PaintedBoxes& painted) {
    std::vector<Box> boxes = painted.sheets;
    for (const PaintedBoxes::Layer& layer : painted.layers) boxes.push_back(layer.box);
    return boxes;
  };
  double least = std::numeric_limits<double>::infinity();
  for (const Box& l : boxes_of(a)) {
    for (const Box& r : boxes_of(b)) {
      for (const Eigen::Vector3d& p : {l.min(), l.max()}) {
        for (const Eigen::Vector3d& q : {r.min(), r.max()})
          least = std::min(least, (p - q).cwiseAbs().minCoeff());
      }
    }
  }
  return least;
}

inline Box randomBoxIn(const Box& around, RandomEngine& engine, double least, double most) {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  for (int k = 0; k < 3; ++k) {
    const double size = uniformIn(engine, least, most) * around.sizes()[k];
    low[k] = around.min()[k] + uniformIn(engine, 0.02, 0.98) * (around.sizes()[k] - size);
    high[k] = low[k] + size;
  }
  return Box(low, high);
}

/// The box's edge from one corner along an axis, and a sheet on it that reaches out along another.
inline void addFin(PaintedBoxes& painted, const Box& box, RandomEngine& engine) {
  const auto along = static_cast<Eigen::Index>(uniformIndex(engine, 3));
  const Eigen::Index out = (along + 1 + static_cast<Eigen::Index>(uniformIndex(engine, 2))) % 3;
  const Eigen::Vector3d corner = cornerOfBox(box, uniformIndex(engine, 8) & ~(1U << along));
  Eigen::Vector3d end = corner;
  end[along] = box.max()[along];
  // As long as the box's own face, or of any length.
  const bool is_face = uniformIndex(engine, 3) == 0;
  const double reach = is_face ? (corner[out] == box.min()[out] ? box.max()[out] : box.min()[out])
                               : corner[out] + uniformIn(engine, -1.0, 1.0);
  const bool turned = uniformIndex(engine, 2) != 0;
  std::array<Eigen::Vector3d, 4> p = {corner, end, end, corner};
  p[2][out] = p[3][out] = reach;
  if (turned) std::swap(p[1], p[3]);
  addTriangle(painted.soup, p[0], p[1], p[2]);
  addTriangle(painted.soup, p[0], p[2], p[3]);
  Box sheet(corner);
  for (const Eigen::Vector3d& q : p) sheet.extend(q);
  painted.sheets.push_back(sheet);
}

/// What the files of strangers hold: stacks of boxes that share faces, edges and corners, with the same
/// diagonals or others, each wound as it comes; enclosed hollows; boxes within boxes, wound either way; boxes
/// that overlap; sheets that hang on them; everything twice.
inline PaintedBoxes randomUnion(RandomEngine& engine) {
  PaintedBoxes painted;
  const bool same_diagonals = uniformIndex(engine, 3) != 0;
  const bool twice = uniformIndex(engine, 8) == 0;
  const bool inside_out = uniformIndex(engine, 4) == 0;
  const bool mixed = uniformIndex(engine, 5) == 0;
  std::array<std::vector<double>, 3> planes;
  for (std::vector<double>& axis : planes) {
    const std::uint32_t count = 2 + uniformIndex(engine, 3);
    double at = uniformIn(engine, -1.0, 0.0);
    for (std::uint32_t i = 0; i < count; ++i, at += uniformIn(engine, 0.2, 1.0)) axis.push_back(at);
  }
  const double share = uniformIn(engine, 0.3, 1.0);
  const bool hollow_middle = uniformIndex(engine, 3) == 0;
  std::vector<Box> cells;
  for (std::size_t x = 1; x < planes[0].size(); ++x) {
    for (std::size_t y = 1; y < planes[1].size(); ++y) {
      for (std::size_t z = 1; z < planes[2].size(); ++z) {
        const bool is_middle = x == 2 && y == 2 && z == 2;
        const bool left_out = is_middle ? hollow_middle : uniformUnit(engine) > share;
        if (left_out && !cells.empty()) continue;
        cells.emplace_back(Eigen::Vector3d(planes[0][x - 1], planes[1][y - 1], planes[2][z - 1]),
                           Eigen::Vector3d(planes[0][x], planes[1][y], planes[2][z]));
      }
    }
  }
  const std::uint32_t common = uniformIndex(engine, 2) != 0 ? 0x3fU : 0x00U;
  const auto add = [&](const Box& box, bool is_material, bool turned) {
    const std::uint32_t diagonals = same_diagonals ? common : uniformIndex(engine, 64);
    for (int copy = 0; copy < (twice ? 2 : 1); ++copy) addBox(painted.soup, box, diagonals, turned);
    painted.layers.push_back({box, is_material});
  };
  for (const Box& cell : cells) add(cell, true, mixed ? uniformIndex(engine, 2) != 0 : inside_out);
  const Box& cell = cells[uniformIndex(engine, static_cast<std::uint32_t>(cells.size()))];
  const std::uint32_t within = mixed ? 0 : uniformIndex(engine, 4);
  if (within == 1) add(randomBoxIn(cell, engine, 0.3, 0.9), true, inside_out);
  if (within >= 2) {
    const Box cavity = randomBoxIn(cell, engine, 0.5, 0.9);
    add(cavity, false, !inside_out);
    if (within == 3) add(randomBoxIn(cavity, engine, 0.3, 0.8), true, inside_out);
  }
  Box whole;
  for (const Box& box : cells) whole.extend(box);
  const Box wider(whole.min() - 0.3 * whole.sizes(), whole.max() + 0.3 * whole.sizes());
  if (!mixed && uniformIndex(engine, 3) == 0) add(randomBoxIn(wider, engine, 0.2, 0.6), true, inside_out);
  if (uniformIndex(engine, 3) == 0) addFin(painted, cell, engine);
  return painted;
}

/// Turned, moved and scaled; triangles in any order, each from any of its corners.
inline TriangleSoup rewritten(const TriangleSoup& soup, const Eigen::Isometry3d& pose, double scale,
                              RandomEngine& engine) {
  TriangleSoup changed = soup;
  for (Eigen::Vector3d& vertex : changed.vertices) vertex = pose * Eigen::Vector3d(scale * vertex);
  shuffle(changed.triangles, engine);
  for (auto& triangle : changed.triangles) {
    std::rotate(triangle.begin(), triangle.begin() + uniformIndex(engine, 3), triangle.end());
  }
  return changed;
}

}  // namespace concave_distance::test
