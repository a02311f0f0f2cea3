#pragma once

namespace concave_distance::demo {

/// Forwards through [0, duration] and backwards again, without end: the time on the path after `elapsed`
/// seconds, with a rest of `pause` seconds at either end.
double pingPong(double elapsed, double duration, double pause);

}  // namespace concave_distance::demo
