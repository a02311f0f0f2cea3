#pragma once

namespace concave_distance {

/// Limits how much a plateau's distance may vary, relative to the bodies: far above the kernels' rounding.
inline constexpr double kPlateauTolerance = 1e-9;

}  // namespace concave_distance
