#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>

namespace concave_distance {

/// Runs `work` on the caller's thread and on up to `helpers` more, and returns when it has ended on all.
/// Where the system gives fewer threads, those that there are run it.
/// @param work takes its share of what there is to do; must not throw
void runWithHelpers(std::size_t helpers, const std::function<void()>& work);

/// Runs independent stages in parallel and comes back when all have ended. What a stage throws stops no other
/// (TBB would cancel what they have nested, and leave half-built parts); of several exceptions the first
/// stage's is thrown. For preparation, not for hot paths.
void runTogether(std::initializer_list<std::function<void()>> stages);

/// While one lives, what its thread runs together has threads that end with it and begin with its priority:
/// workers of TBB stay, and cycles would wait for one that the background began.
class OwnThreads {
 public:
  OwnThreads();
  ~OwnThreads();
  OwnThreads(const OwnThreads&) = delete;
  OwnThreads& operator=(const OwnThreads&) = delete;
};

}  // namespace concave_distance
