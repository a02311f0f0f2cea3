#pragma once

#include <functional>
#include <initializer_list>

namespace concave_distance {

/// Runs independent stages in parallel and comes back when all have ended. What a stage throws stops no other
/// (TBB would cancel what they have nested, and leave half-built parts); of several exceptions the first
/// stage's is thrown. For preparation, not for hot paths.
void runTogether(std::initializer_list<std::function<void()>> stages);

}  // namespace concave_distance
