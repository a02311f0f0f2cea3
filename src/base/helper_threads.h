#pragma once

#include <cstddef>
#include <functional>

namespace concave_distance {

/// Runs `work` on the caller's thread and on up to `helpers` more, and returns when it has ended on all.
/// Where the system gives fewer threads, those that there are run it.
/// @param work takes its share of what there is to do; must not throw
void runWithHelpers(std::size_t helpers, const std::function<void()>& work);

}  // namespace concave_distance
