#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Says which bodies a new one is paired with. A name may be that of a group, or a pattern: of these, bodies
/// that do not move relative to the new one's frame are left out.
struct PairPartners {
  std::vector<std::string> names;        ///< empty: every body that can move relative to its frame
  bool none = false;                     ///< no body at all
  std::vector<std::string> may_touch{};  ///< bodies left out; not together with `names`
  /// Returns whether two frames do not move relative to each other, besides those that Scene::rigid joins.
  std::function<bool(const std::string& frame_a, const std::string& frame_b)> is_rigid{};
  bool may_be_gone = false;  ///< `names` without a body are left out
};

struct AddedPairs {
  std::vector<std::string> names;             ///< of the new pairs, 1000 at most of those by rule
  std::vector<std::string> rigid_neighbours;  ///< bodies of other frames left out as rigidly connected
  std::vector<std::string> unknown;           ///< names of partners, or in may_touch, without a body
  std::vector<std::string> rigid_frames;      ///< as Partners::rigid_frames
};

/// The partners of a new body.
struct Partners {
  std::vector<std::size_t> named;         ///< by themselves
  BodySet by_rule;                        ///< all others, also those that do not move
  std::vector<std::string> rigid_frames;  ///< of PairPartners::is_rigid, unknown to the scene so far
};

/// Finds them. Fills what `added` says of bodies left out.
/// @throws Error when a partner is unknown or the body itself, and for wishes that exclude each other
Partners partnersOf(const Scene& scene, const SceneBody& body, const PairPartners& partners,
                    AddedPairs& added);

}  // namespace concave_distance
