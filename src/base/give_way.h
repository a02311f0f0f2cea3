#pragma once

namespace concave_distance {

/// Lowers the priority of the calling thread below that of cycles: out of real-time priority, which threads
/// inherit, and by steps of `nice`.
void giveWay();

}  // namespace concave_distance
