#include "thesis/src/continuous/build_constraint_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "concave_distance/base/error.h"
#include "convex_parts.h"
#include "exact_solid.h"
#include "hull_constraints.h"
#include "tree_of_solid.h"

namespace concave_distance {
namespace {

void validate(const TreeBuildOptions& options, const std::string& where) {
  if (!(options.flatness_tolerance > 0.0 && options.flatness_tolerance < 0.1)) {
    throw Error(where, "flatness_tolerance is " + std::to_string(options.flatness_tolerance),
                "give a share of the body's diagonal in (0, 0.1)");
  }
  if (!(options.stagnation_share > 0.0 && options.stagnation_share < 1.0)) {
    throw Error(where, "stagnation_share is " + std::to_string(options.stagnation_share),
                "give a number in (0, 1)");
  }
  if (options.depth_limit < 1) {
    throw Error(where, "depth_limit is 0", "give at least 1");
  }
}

class Builder {
 public:
  Builder(const TreeBuildOptions& options, double diameter)
      : options_(options),
        tolerance_(options.flatness_tolerance * diameter),
        // Far above the rounding of a constraint's value, far below the tolerance.
        overlap_(1e-9 * diameter) {}

  PieceDescription build(const ExactSolid& solid) { return pieceOf(solid, solid.hull(), 1, {}); }

  TreeBuildReport report;

 private:
  /// @param ancestors constraints of the pieces above
  PieceDescription pieceOf(const ExactSolid& solid, const ExactSolid& hull, std::uint32_t depth,
                           std::vector<LinearConstraint> ancestors) {
    const SolidFacets hull_facets = hull.facets();
    PieceDescription piece;
    piece.constraints = hullConstraints(hull_facets, ancestors, {}, tolerance_, overlap_);
    if (isConvex(solid.facets(), tolerance_)) {
      return piece;
    }
    ancestors.insert(ancestors.end(), piece.constraints.begin(), piece.constraints.end());
    const double largest_volume = options_.stagnation_share * volumeOf(hull_facets);
    for (const ExactSolid& child : hull.minus(solid).components()) {
      const SolidFacets facets = child.facets();
      const double thickness = facets.facets.empty() ? 0.0 : thicknessOf(facets);
      if (thickness <= tolerance_) {
        ++report.dropped_pieces;
        report.thickest_dropped = std::max(report.thickest_dropped, thickness);
        continue;
      }
      const ExactSolid child_hull = child.hull();
      const bool stagnates = volumeOf(child_hull.facets()) >= largest_volume;
      if (stagnates || depth + 1 >= options_.depth_limit) {
        addConvexParts(child, depth + 1,
                       stagnates ? TreeFallback::Reason::Stagnation : TreeFallback::Reason::DepthLimit,
                       ancestors, piece);
      } else {
        piece.children.push_back(pieceOf(child, child_hull, depth + 1, ancestors));
      }
    }
    return piece;
  }

  void addConvexParts(const ExactSolid& solid, std::uint32_t depth, TreeFallback::Reason reason,
                      const std::vector<LinearConstraint>& ancestors, PieceDescription& parent) {
    const ConvexParts divided = convexParts(solid, tolerance_, options_.cut_limit);
    for (const SolidFacets& part : divided.parts) {
      parent.children.push_back({hullConstraints(part, ancestors, divided.cuts, tolerance_, overlap_), {}});
    }
    if (divided.parts.size() > 1) {
      const int level = static_cast<int>(depth);
      report.fallbacks.push_back({reason, level % 2 == 1 ? level : -level,
                                  static_cast<std::uint32_t>(divided.parts.size()),
                                  divided.used_vertical_walls});
    }
  }

  const TreeBuildOptions& options_;
  double tolerance_;
  double overlap_;
};

}  // namespace

std::string TreeBuildReport::summary() const {
  std::ostringstream text;
  const char* separator = "";
  if (dropped_pieces > 0) {
    text << dropped_pieces << " pieces of at most " << thickest_dropped << " m left out";
    separator = "; ";
  }
  for (const TreeFallback& fallback : fallbacks) {
    text << separator << fallback.parts << " convex pieces at level " << fallback.level
         << (fallback.reason == TreeFallback::Reason::Stagnation ? ": hull minus piece would never end"
                                                                 : ": the depth limit is reached")
         << (fallback.used_vertical_walls ? " (divided by vertical walls)" : "");
    separator = "; ";
  }
  return text.str();
}

BuiltTree buildTreeOf(const ExactSolid& solid, const Eigen::AlignedBox3d& bounding_box,
                      const TreeBuildOptions& options, const std::string& where) {
  validate(options, where);
  const double diameter = bounding_box.diagonal().norm();
  Builder builder(options, diameter);
  const PieceDescription root = builder.build(solid);
  constexpr double kRounding = 1e-12;
  return {ConstraintTree(root, bounding_box, kRounding * diameter, where), builder.report};
}

BuiltTree buildConstraintTree(const SurfaceMesh& mesh, const TreeBuildOptions& options,
                              const std::string& where) {
  return buildTreeOf(ExactSolid::fromMesh(mesh, where), mesh.boundingBox(), options, where);
}

}  // namespace concave_distance
