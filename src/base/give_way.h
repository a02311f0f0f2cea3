#pragma once

namespace concave_distance {

/// Lowers the priority of the calling thread below that of cycles, by steps of `nice`; without the right to
/// it nothing changes.
void giveWay();

}  // namespace concave_distance
