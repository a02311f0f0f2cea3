#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "search/search_workspace.h"

namespace concave_distance {

/// A workspace for each island: the first one is given, the others are made.
class IslandWorkspaces {
 public:
  IslandWorkspaces(const BodyMesh& a, const BodyMesh& b, std::uint32_t islands, SearchWorkspace& first)
      : all_{&first} {
    while (all_.size() < islands) all_.push_back(&made_.emplace_back(a, b));
  }
  const std::vector<SearchWorkspace*>& all() const { return all_; }
  /// Forgets the basins of all islands.
  void clearBasins() {
    for (SearchWorkspace* workspace : all_) workspace->basins.clear();
  }

 private:
  std::deque<SearchWorkspace> made_;
  std::vector<SearchWorkspace*> all_;
};

}  // namespace concave_distance
