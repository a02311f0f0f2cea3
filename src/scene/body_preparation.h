#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <unordered_map>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// Makes what every mesh needs for niches: facets, neighbours and how far it lies below its hull.
void makeCommonParts(const BodyMesh& body);
/// Returns whether two bodies have niches that normal cones and the search look for: two round solids have
/// none, nor two convex ones but for those that are hidden or through material. Both have their common parts.
bool needsSearch(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters);

/// Makes in one call what cycles need of the bodies of pairs, each mesh once: the common parts, then normal
/// cones, then the grids of the search.
class BodyPreparation {
 public:
  /// @param end after which no further piece is begun @param stop likewise, once set; nullptr: never
  BodyPreparation(const PreparationSettings& settings, WorkLimit::Clock::time_point end,
                  const std::atomic<bool>* stop);

  /// Adds a pair whose niches are wanted.
  void add(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters);
  /// Adds the bodies that rules of a scene watch, each against whichever will be near.
  void addAhead(const Scene& scene);
  /// @return true when nothing is left
  bool run();
  /// Fills in what run() has looked at, and left.
  void count(PreparationCounts& counts) const;

 private:
  struct Body {
    const BodyMesh* mesh;
    bool needs_cones = false;  ///< of NormalSides::Outside
    bool needs_both_sides = false;
    bool needs_grid = false;
    bool is_left = false;
  };
  struct Pair {
    std::size_t a;
    std::size_t b;
    TrackerParameters parameters;
  };
  std::size_t placeOf(const BodyMesh& mesh);
  bool mayBegin() const;
  void decide();
  void decide(const Pair& pair);
  template <typename Make>
  void makeEach(const Make& make);
  void makeGrids();
  void report(std::size_t pieces);

  const PreparationSettings& settings_;
  WorkLimit::Clock::time_point end_;
  const std::atomic<bool>* stop_;
  std::vector<Body> bodies_;
  std::unordered_map<const BodyMesh*, std::size_t> place_of_;
  std::vector<Pair> pairs_;
  std::vector<Pair> ahead_;  ///< each with itself
  std::size_t done_ = 0;     ///< pieces, three for each body
};

}  // namespace concave_distance
