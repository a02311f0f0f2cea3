#pragma once

#include <Eigen/Core>

namespace concave_distance::detail {

/// Eigen aligns its types by the processor that a program is compiled for (-mavx, -march=native: 32 bytes).
/// A program aligned otherwise than the library does not link: compile both with the same option, the library
/// with CONCAVE_DISTANCE_NATIVE, or the program with -DEIGEN_MAX_ALIGN_BYTES=16.
template <int bytes>
struct EigenAlignmentOfTheLibrary {
  static const char is;  // NOLINT(readability-identifier-naming)
};
extern template struct EigenAlignmentOfTheLibrary<EIGEN_MAX_ALIGN_BYTES>;

[[gnu::used]] static const char* const eigen_alignment =  // NOLINT(readability-identifier-naming)
    &EigenAlignmentOfTheLibrary<EIGEN_MAX_ALIGN_BYTES>::is;

}  // namespace concave_distance::detail
